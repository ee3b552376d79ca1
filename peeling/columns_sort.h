// peeling/columns_sort.h - sorting sixteen columns at once, each on its own: the scalar twin of columns_simd.cpp.
//
// Rule     Ascending. Merge exchange compares the same rows whatever they hold, so sixteen columns go through it side by side.
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

}  // namespace strata::peeling
