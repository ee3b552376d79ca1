// peeling/arrivals.h - fragments put down pixel by pixel as they come, and taken up again as sorted blocks: the scalar twins of
// columns_simd.cpp.
//
// Rule     The k-th visible fragment of a pixel is a word of rank k: its key above, below it its place among all fragments of these
//          pixels in submission order, where its colour stands. So one comparison orders words by (key, arrival).
// Layout   All words of rank 0, then all of rank 1: one walk over the triangles suffices, and neighbours of a rank are neighbours.
// Source   Sorting: Batcher's merge exchange; Knuth, The Art of Computer Programming 3, 5.2.2, Algorithm M.
// Tests    tests/peeling/columns_test.cpp
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "peeling/columns.h"
#include "peeling/programs.h"

namespace strata::peeling {

// The memory is the caller's; `count`, `hidden` and `at_surface` start at 0.
struct Arrivals {
    std::size_t stride = 0;    // words a rank: the pixels, rounded up to whole blocks, and some more
    std::uint32_t ranks = 0;   // that there is room for
    std::uint32_t places = 0, most_places = 0;  // colours in use, and room for; a vector may end fifteen behind them
    std::uint64_t* word = nullptr;
    std::array<float*, 4> color{};
    std::uint32_t *count = nullptr, *hidden = nullptr, *at_surface = nullptr;  // by pixel, as in ColumnBlock
    const std::uint32_t* opaque = nullptr;  // by pixel: the surface's key, shader_z or code
    bool same_opaque = false;               // all of them are opaque[0]
    bool by_shader_z = false;
};

inline namespace strict {
namespace scalar {

template <bool by_shader_z>
[[nodiscard]] bool append(Arrivals& to, const pipeline::FragmentBatch& in, const std::uint32_t* alive) noexcept {
    for (std::size_t i = 0; i < lanes(in); ++i) {
        if (alive[i] == 0) continue;
        const std::uint32_t pixel = in.pixel[i], surface = to.opaque[to.same_opaque ? 0 : pixel];
        const std::uint32_t key = by_shader_z ? ordered_code(in.shader_z[i]) : in.code[i];
        const bool is_visible = by_shader_z ? in.shader_z[i] < std::bit_cast<float>(surface) : key < surface;
        if (!is_visible) {
            ++to.hidden[pixel];
            to.at_surface[pixel] += !by_shader_z && key == surface ? 1 : 0;
            continue;
        }
        const std::uint32_t rank = to.count[pixel]++;
        if (rank >= to.ranks) return false;
        to.word[rank * to.stride + pixel] = std::uint64_t{key} << 32 | (to.places + i);
    }
    for (std::size_t c = 0; c < 4; ++c) std::copy_n(in.color[c].begin(), lanes(in), to.color[c] + to.places);
    to.places += static_cast<std::uint32_t>(lanes(in));
    return true;
}

inline void find_arrived_before(const ColumnBlock& block, std::uint32_t* before) noexcept {
    for (std::uint32_t k = 0; k < block.depth; ++k)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            std::uint32_t rows = k < block.visible[lane] ? k : 0;
            while (rows > 0 && block.place(lane, rows - 1) > block.place(lane, k)) --rows;
            before[k * block_lanes + lane] = rows;
        }
}

}  // namespace scalar

// always_inline: compiled again, for another instruction set, wherever columns_simd.cpp takes it in.
[[gnu::always_inline]] inline void exchange_rows(std::uint64_t* __restrict a, std::uint64_t* __restrict b) noexcept {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        const std::uint64_t x = a[lane], y = b[lane];
        a[lane] = x < y ? x : y;
        b[lane] = x < y ? y : x;
    }
}

// Merge exchange compares the same rows whatever they hold, so sixteen columns go through it side by side.
[[gnu::always_inline]] inline void merge_exchange(std::uint64_t* rows, std::size_t depth) noexcept {
    if (depth < 2) return;
    std::size_t top = 1;
    while (top * 2 < depth) top *= 2;
    for (std::size_t p = top; p > 0; p /= 2) {
        std::size_t r = 0, d = p;
        for (std::size_t q = top;; q /= 2) {
            for (std::size_t i = 0; i + d < depth; ++i)
                if ((i & p) == r) exchange_rows(rows + i * block_lanes, rows + (i + d) * block_lanes);
            if (q == p) break;
            d = q - p;
            r = p;
        }
    }
}

// How many rows from the first on fall (or rise) in every column.
template <bool falling>
[[gnu::always_inline]] inline std::size_t ordered_rows(const std::uint64_t* rows, std::size_t depth) noexcept {
    std::size_t count = 1;
    for (; count < depth; ++count) {
        const std::uint64_t* const last = rows + (count - 1) * block_lanes;
        const std::uint64_t* const next = last + block_lanes;
        std::uint32_t wrong = 0;
        for (std::size_t lane = 0; lane < block_lanes; ++lane)
            wrong |= (falling ? last[lane] > next[lane] : last[lane] < next[lane]) ? 0u : 1u;
        if (wrong != 0) break;
    }
    return count;
}

[[gnu::always_inline]] inline void reverse_rows(std::uint64_t* rows, std::size_t depth) noexcept {
    for (std::size_t i = 0, j = depth - 1; i < j; ++i, --j)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            const std::uint64_t x = rows[i * block_lanes + lane];
            rows[i * block_lanes + lane] = rows[j * block_lanes + lane];
            rows[j * block_lanes + lane] = x;
        }
}

// Ascending. What was drawn in depth order, but for a few rows at its end, needs only those inserted.
[[gnu::always_inline]] inline void sort_rows(std::uint64_t* rows, std::size_t depth) noexcept {
    constexpr std::size_t few = 8;
    if (depth < 2) return;
    const std::size_t rising = ordered_rows<false>(rows, depth);
    const std::size_t falling = rising > 1 ? 0 : ordered_rows<true>(rows, depth);
    const std::size_t ordered = rising > 1 ? rising : falling;
    if (depth - ordered > few) return merge_exchange(rows, depth);
    if (falling > 1) reverse_rows(rows, falling);
    for (std::size_t row = ordered; row < depth; ++row)
        for (std::size_t i = row; i > 0; --i) exchange_rows(rows + (i - 1) * block_lanes, rows + i * block_lanes);
}

[[gnu::always_inline]] inline void load_rows(const Arrivals& from, std::size_t pixel, const ColumnBlock& block,
                                             std::uint64_t* __restrict rows) noexcept {
    for (std::size_t k = 0; k < block.depth; ++k) {
        const std::uint64_t* const words = from.word + k * from.stride + pixel;
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            const std::uint64_t beyond = k < block.visible[lane] ? 0 : ~std::uint64_t{0};
            rows[k * block_lanes + lane] = words[lane] | beyond;
        }
    }
}

[[gnu::always_inline]] inline void find_ties(ColumnBlock& block, const std::uint64_t* rows) noexcept {
    std::array<std::uint64_t, block_lanes> tied{};
    for (std::size_t k = 1; k < block.depth; ++k)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            const std::uint64_t a = rows[(k - 1) * block_lanes + lane], b = rows[k * block_lanes + lane];
            tied[lane] |= (a ^ b) >> 32 == 0 && b != ~std::uint64_t{0} ? 1 : 0;
        }
    for (std::size_t lane = 0; lane < block_lanes; ++lane) block.has_ties[lane] = static_cast<std::uint32_t>(tied[lane]);
}

[[nodiscard, gnu::always_inline]] inline std::uint32_t nearest_key(const ColumnBlock& block, const std::uint64_t* rows) noexcept {
    std::uint64_t least = ~std::uint64_t{0};
    for (std::size_t lane = 0; lane < block_lanes && block.depth > 0; ++lane) least = std::min(least, rows[lane]);
    return static_cast<std::uint32_t>(least >> 32);
}

[[gnu::always_inline]] inline void sort_words(const Arrivals& from, std::size_t pixel, ColumnBlock& block,
                                              std::uint64_t* rows) noexcept {
    load_rows(from, pixel, block, rows);
    sort_rows(rows, block.depth);
    find_ties(block, rows);
    block.nearest = nearest_key(block, rows);
}

}  // namespace strict

// Puts the living fragments of a batch down; false if there was no room for one of them: then `to` is of no more use.
[[nodiscard]] bool append(Arrivals& to, const pipeline::FragmentBatch& in, const std::uint32_t* alive) noexcept;
// The sixteen columns from `pixel` on into `rows`, of which there are block.depth, sorted; fills has_ties
// and nearest.
void sort_block(const Arrivals& from, std::size_t pixel, ColumnBlock& block, std::uint64_t* rows) noexcept;
// before[row * block_lanes + lane] = how many rows there are up to the last one below `row` whose fragment came earlier; 0 if none did.
void find_arrived_before(const ColumnBlock& block, std::uint32_t* before) noexcept;
// Sorts the first `depth` rows of sixteen columns, each on its own, ascending.
void sort_columns(std::uint64_t* rows, std::size_t depth) noexcept;

}  // namespace strata::peeling
