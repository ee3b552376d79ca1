// peeling/columns_sort.h - sorting sixteen columns at once, each on its own: the scalar twin of columns_simd.cpp.
//
// Rule     Ascending. Merge exchange compares the same rows whatever they hold, so sixteen columns go through it side by side. What
//          was drawn in depth order, but for a few rows at its end, needs only those inserted.
// Source   Batcher 1968; Knuth, The Art of Computer Programming 3, 5.2.2, Algorithm M.
// Tests    tests/peeling/columns_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>

#include "peeling/columns.h"

namespace strata::peeling {

// always_inline: compiled again, for another instruction set, wherever columns_simd.cpp takes it in.
[[gnu::always_inline]] inline void exchange_rows(std::uint64_t* __restrict a, std::uint64_t* __restrict b) noexcept {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        const std::uint64_t x = a[lane], y = b[lane];
        a[lane] = x < y ? x : y;
        b[lane] = x < y ? y : x;
    }
}

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

}  // namespace strata::peeling
