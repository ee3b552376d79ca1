// pipeline/fragments/sort_levels.h - sorts sixteen per-pixel lists of entries at once: the scalar reference of
// sort_levels_simd.cpp.
//
// Rule     A level is sixteen entries, one per list; levels are contiguous. An entry is a key in the upper half and an
//          index in the lower. Past a list's end entries are ~0, which sorts last. No other entries of a list are
//          equal.
// Source   Batcher's merge exchange; Knuth, The Art of Computer Programming 3, 5.2.2, Algorithm M: it compares the same
//          levels whatever their values, so sixteen lists can be sorted together.
// Tests    tests/pipeline/fragments/sort_levels_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace strata::pipeline {

inline constexpr std::size_t block_lanes = 16;

inline namespace strict {
namespace scalar {

// The operations on levels: loops here, vectors in sort_levels_simd.cpp.
struct Levels {
    // Moves the lesser of each pair to `a`, the greater to `b`.
    static void exchange(std::uint64_t* a, std::uint64_t* b) noexcept {
        for (std::size_t lane = 0; lane < block_lanes; ++lane)
            if (b[lane] < a[lane]) std::swap(a[lane], b[lane]);
    }
    // True if a <= b in every list.
    [[nodiscard]] static bool in_order(const std::uint64_t* a, const std::uint64_t* b) noexcept {
        return std::equal(a, a + block_lanes, b, [](std::uint64_t x, std::uint64_t y) { return x <= y; });
    }
};

}  // namespace scalar
}  // namespace strict

template <class Levels>
[[gnu::always_inline]] inline void merge_exchange(std::uint64_t* levels, std::size_t height) noexcept {
    std::size_t top = 1;
    while (top * 2 < height) top *= 2;
    for (std::size_t p = top; p > 0; p /= 2) {
        std::size_t r = 0, d = p;
        for (std::size_t q = top;; q /= 2) {
            for (std::size_t i = 0; i + d < height; ++i)
                if ((i & p) == r) Levels::exchange(levels + i * block_lanes, levels + (i + d) * block_lanes);
            if (q == p) break;
            d = q - p;
            r = p;
        }
    }
}

// Sorts in ascending order. If all but the last few levels are already sorted, only those few are inserted.
template <class Levels>
[[gnu::always_inline]] inline void sort_rising(std::uint64_t* levels, std::size_t height) noexcept {
    constexpr std::size_t few = 8;
    const auto level = [levels](std::size_t k) { return levels + k * block_lanes; };
    std::size_t rising = std::min<std::size_t>(height, 1);
    while (rising < height && Levels::in_order(level(rising - 1), level(rising))) ++rising;
    if (height - rising > few) return merge_exchange<Levels>(levels, height);
    for (std::size_t k = rising; k < height; ++k)
        for (std::size_t at = k; at > 0 && !Levels::in_order(level(at - 1), level(at)); --at)
            Levels::exchange(level(at - 1), level(at));
}

// Sorts each list of `height` levels.
void sort_levels(std::uint64_t* levels, std::size_t height) noexcept;

}  // namespace strata::pipeline
