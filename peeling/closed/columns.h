// peeling/closed/columns.h - the visible fragments of a region, every pixel's in a column of its own, sorted near to far.
//
// Rule     A fragment is visible if its key lies before the opaque surface's. Columns are sorted by (key, arrival): of equal keys
//          the first in submission order stands first.
// Layout   Sixteen neighbouring columns are a block, so that sorting and blending run over sixteen columns at once. A block lives
//          while it is visited; what it is made from stands in arrivals.h.
// Tests    tests/peeling/closed/columns_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>

namespace strata::pipeline {
class Region;
}

namespace strata::peeling {

inline constexpr std::size_t block_lanes = 16;

using LaneWords = std::array<std::uint32_t, block_lanes>;

struct ColumnBlock {
    std::size_t first = 0;        // its first pixel in the region
    int count = 0;                // its pixels; the columns behind the region's last pixel are empty
    std::uint32_t height = 0;     // levels: of the tallest column
    std::uint32_t nearest = ~0u;  // the least key
    LaneWords visible{};          // heights
    LaneWords hidden{};           // fragments at the opaque surface or behind it
    LaneWords at_surface{};       // of these, the ones exactly at it
    LaneWords has_ties{};         // not 0: a depth stands twice in the column
    // A level is sixteen words, one a column: above, the key; below, the place of the colour. ~0 above a column's end.
    const std::uint64_t* levels = nullptr;
    std::array<const float*, 4> color{};

    [[nodiscard]] std::uint32_t key(std::size_t lane, std::size_t k) const noexcept {
        return static_cast<std::uint32_t>(levels[k * block_lanes + lane] >> 32);
    }
    [[nodiscard]] std::uint32_t place(std::size_t lane, std::size_t k) const noexcept {
        return static_cast<std::uint32_t>(levels[k * block_lanes + lane]);
    }
    // Level k and those beside it that hold its depth end here, at most, and begin here, at least.
    [[nodiscard]] std::uint32_t end_of_depth(std::size_t lane, std::uint32_t k, std::uint32_t most) const noexcept {
        std::uint32_t end = k + 1;
        while (end < most && key(lane, end) == key(lane, k)) ++end;
        return end;
    }
    [[nodiscard]] std::uint32_t begin_of_depth(std::size_t lane, std::uint32_t least, std::uint32_t k) const noexcept {
        std::uint32_t begin = k;
        while (begin > least && key(lane, begin - 1) == key(lane, k)) --begin;
        return begin;
    }
    [[nodiscard]] bool has_any_tie() const noexcept {
        std::uint32_t any = 0;
        for (const std::uint32_t tied : has_ties) any |= tied;
        return any != 0;
    }
};

struct RegionFragments {
    std::uint64_t rasterized = 0, masked = 0;
    std::uint32_t nearest = ~0u;  // the least visible key
    bool has_denormals = false;   // some visible shader_z is one
};

// Calls visit(block) for every block with a fragment in it, from the region's first pixels to its last. Empty, and
// nothing visited, if the fragments would not fit into the frame's fragment memory.
[[nodiscard]] std::optional<RegionFragments> for_each_block(pipeline::Region& region,
                                                            const std::function<void(const ColumnBlock&)>& visit);

}  // namespace strata::peeling
