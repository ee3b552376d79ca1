// peeling/columns.h - the visible fragments of a band of pixels, every pixel's in a column of its own, sorted near to far.
//
// Rule     A fragment is visible if its key lies before the opaque surface's. Columns are sorted by (key, arrival): of equal keys
//          the first in submission order stands first.
// Layout   Sixteen neighbouring columns are a block; row k of a block holds the k-th fragment of each of its pixels, so that
//          sorting and blending run over sixteen columns at once. Two walks over the triangles, one that counts and one that
//          places: memory is known before it is taken.
// Tests    tests/peeling/columns_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "pipeline/region.h"

namespace strata::peeling {

inline constexpr std::size_t block_lanes = 16;

struct ColumnBlock {
    std::size_t first = 0;    // slot of row 0, lane 0
    std::uint32_t depth = 0;  // rows in use
    bool has_ties = false;    // some column holds a depth twice
};

// Slot first + k * block_lanes + lane of a block: the k-th arrival of its pixel in `color`, its k-th nearest fragment in `key` and
// `order`.
struct Columns {
    rasterizer::Rect band;
    std::span<ColumnBlock> blocks;
    std::span<std::uint32_t> visible;     // by pixel of the band, padded to whole blocks
    std::span<std::uint32_t> alive;       // the same, with those behind the opaque surface
    std::span<std::uint32_t> at_surface;  // the same, of the latter those exactly at it
    std::span<std::uint32_t> key;         // a slot; ~0 below a column's end
    std::span<std::uint16_t> order;       // a slot: which arrival stands there
    std::array<std::span<float>, 4> color;

    [[nodiscard]] std::size_t pixels() const noexcept { return band.area(); }
    [[nodiscard]] std::size_t slot(std::size_t pixel, std::size_t k) const noexcept {
        return blocks[pixel / block_lanes].first + k * block_lanes + pixel % block_lanes;
    }
    // Where the k-th nearest fragment of a pixel has its colour.
    [[nodiscard]] std::size_t sorted(std::size_t pixel, std::size_t k) const noexcept {
        return slot(pixel, order[slot(pixel, k)]);
    }
};

struct RegionFragments {
    std::uint64_t rasterized = 0, masked = 0;
};

// Splits the region into bands whose fragments fit into a cache and calls body(columns) with each, from top to bottom. Empty,
// and nothing called, if they would not fit into the frame's fragment memory.
[[nodiscard]] std::optional<RegionFragments> for_each_band(pipeline::Region& region,
                                                           const std::function<void(const Columns&)>& body);

// Sorts the first `depth` rows of sixteen columns, each on its own, ascending (Batcher's merge exchange: Knuth 5.2.2 M).
void sort_columns(std::uint64_t* rows, std::size_t depth);

}  // namespace strata::peeling
