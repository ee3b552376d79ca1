// peeling/loops/list_block.h - view of 16 adjacent pixels of SortedLists, fragments sorted near to far, for SIMD peel
// loops.
//
// Rule     A fragment is visible if its key is less than the opaque surface's; an equal key is hidden.
// Tests    tests/peeling/loops/block_passes_test.cpp, tests/peeling/execution/execution_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "pipeline/fragments/sorted_lists.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::peeling {

using pipeline::block_lanes;
using BlockLanes = std::array<std::uint32_t, block_lanes>;

struct ListBlock {
    std::size_t first = 0;     // index of the first pixel in the region
    int count = 0;             // pixels in the block, 1 to 16; lanes past the region's end have no fragments
    std::uint32_t height = 0;  // the largest visible[lane]
    BlockLanes visible{};      // visible fragments per lane (before the opaque surface)
    BlockLanes hidden{};       // fragments per lane at the opaque surface or behind it
    BlockLanes has_ties{};     // nonzero: two visible fragments have equal keys
    const std::uint64_t* levels = nullptr;                  // levels[k * block_lanes + lane]: (key << 32 | index)
    const pipeline::TileFragments::Color* color = nullptr;  // by index_of(entry); not premultiplied

    [[nodiscard]] std::uint32_t key(std::size_t lane, std::size_t k) const noexcept {
        return pipeline::key_of(levels[k * block_lanes + lane]);
    }
    [[nodiscard]] std::uint32_t index(std::size_t lane, std::size_t k) const noexcept {
        return pipeline::index_of(levels[k * block_lanes + lane]);
    }
    // One past the last entry in [k, most) with the key of entry k.
    [[nodiscard]] std::uint32_t end_of_depth(std::size_t lane, std::uint32_t k, std::uint32_t most) const noexcept {
        std::uint32_t end = k + 1;
        while (end < most && key(lane, end) == key(lane, k)) ++end;
        return end;
    }
    // The first entry with the key of entry k, not below `least`.
    [[nodiscard]] std::uint32_t begin_of_depth(std::size_t lane, std::uint32_t least, std::uint32_t k) const noexcept {
        std::uint32_t begin = k;
        while (begin > least && key(lane, begin - 1) == key(lane, k)) --begin;
        return begin;
    }
    [[nodiscard]] bool has_any_tie() const noexcept {
        return std::ranges::any_of(has_ties, [](std::uint32_t tied) { return tied != 0; });
    }
};

// `surface`: per pixel, the code of the opaque depth, or its bits (binary32) where the key is a value; indexed from the
// region's first pixel.
[[nodiscard]] inline ListBlock block_of(const pipeline::SortedLists& sorted, std::size_t number, pipeline::DepthKey key,
                                        const std::uint32_t* surface,
                                        const pipeline::TileFragments::Color* color) noexcept {
    ListBlock block;
    block.first = number * block_lanes;
    block.count = static_cast<int>(std::min(sorted.pixels() - block.first, block_lanes));
    block.levels = sorted.levels(number);
    block.color = color;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane) {
        const std::size_t pixel = block.first + lane;
        const std::uint32_t end = key == pipeline::DepthKey::shader_z
                                      ? rasterizer::ordered_code(std::bit_cast<float>(surface[pixel]))
                                      : surface[pixel];
        block.visible[lane] = sorted.list(pixel).below(end, sorted.count(pixel));
        block.hidden[lane] = sorted.count(pixel) - block.visible[lane];
        block.height = std::max(block.height, block.visible[lane]);
    }
    for (std::uint32_t k = 1; k < block.height; ++k)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            const std::uint64_t* const entry = block.levels + k * block_lanes + lane;
            const bool is_tied = (entry[0] ^ entry[-static_cast<std::ptrdiff_t>(block_lanes)]) >> 32 == 0;
            block.has_ties[lane] |= is_tied && k < block.visible[lane] ? 1u : 0u;
        }
    return block;
}

}  // namespace strata::peeling
