// peeling/closed/arrivals.h - fragments put down pixel by pixel as they come, and taken up again as sorted blocks: the scalar twins of
// columns_simd.cpp.
//
// Rule     The k-th visible fragment of a pixel is a word of rank k: its key above, below it its place among all fragments of these
//          pixels in submission order, where its colour stands. So one comparison orders words by (key, arrival).
// Layout   All words of rank 0, then all of rank 1: one walk over the triangles suffices, and neighbours of a rank are neighbours.
// Source   Sorting: Batcher's merge exchange; Knuth, The Art of Computer Programming 3, 5.2.2, Algorithm M.
// Tests    tests/peeling/closed/columns_test.cpp
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "peeling/closed/columns.h"
#include "peeling/programs/programs.h"

namespace strata::peeling {

// The memory is the caller's; `count`, `hidden` and `at_surface` start at 0.
struct Arrivals {
    std::size_t stride = 0;                     // words a rank: the pixels, rounded up to whole blocks, and some more
    std::uint32_t ranks = 0;                    // that there is room for
    std::uint32_t places = 0, most_places = 0;  // colours in use, and room for; a vector may end fifteen behind them
    std::uint64_t* word = nullptr;
    std::array<float*, 4> color{};
    std::uint32_t *count = nullptr, *hidden = nullptr, *at_surface = nullptr;  // by pixel, as in ColumnBlock
    const std::uint32_t* opaque = nullptr;  // by pixel: the surface's key, shader_z or code
    bool same_opaque = false;               // all of them are opaque[0]
    bool by_shader_z = false;
    bool has_denormals = false;  // of the visible shader_z that have come
};

inline namespace strict {
namespace scalar {

// Below 2^-126 in magnitude, and not 0: devices that flush denormals would not keep such a depth under MAX.
[[nodiscard]] inline bool is_denormal(float z) noexcept { return z != 0.0f && z > -0x1p-126f && z < 0x1p-126f; }

// The definition of the function below. A NaN passes no comparison, so no visible key is one.
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
        if (by_shader_z) to.has_denormals |= is_denormal(in.shader_z[i]);
        const std::uint32_t rank = to.count[pixel]++;
        if (rank >= to.ranks) return false;
        to.word[rank * to.stride + pixel] = std::uint64_t{key} << 32 | (to.places + i);
    }
    for (std::size_t c = 0; c < 4; ++c) std::copy_n(in.color[c].begin(), lanes(in), to.color[c] + to.places);
    to.places += static_cast<std::uint32_t>(lanes(in));
    return true;
}

// Places rise in the order of arrival, so an earlier arrival is a smaller place.
inline void find_arrived_before(const ColumnBlock& block, std::uint32_t* before) noexcept {
    for (std::uint32_t k = 0; k < block.height; ++k)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            std::uint32_t levels = k < block.visible[lane] ? k : 0;
            while (levels > 0 && block.place(lane, levels - 1) > block.place(lane, k)) --levels;
            before[k * block_lanes + lane] = levels;
        }
}

}  // namespace scalar

// A level is sixteen words. What is done with levels stands in `Levels`: the loops here, vectors in columns_simd.cpp.
namespace scalar {

struct Levels {
    // The lesser of each pair to `a`, the greater to `b`.
    static void exchange(std::uint64_t* a, std::uint64_t* b) noexcept {
        for (std::size_t lane = 0; lane < block_lanes; ++lane)
            if (b[lane] < a[lane]) std::swap(a[lane], b[lane]);
    }
    // a <= b in every column.
    [[nodiscard]] static bool in_order(const std::uint64_t* a, const std::uint64_t* b) noexcept {
        return std::equal(a, a + block_lanes, b, [](std::uint64_t x, std::uint64_t y) { return x <= y; });
    }
    // The columns' heights and what is hidden; false if there is neither.
    [[nodiscard]] static bool find_heights(const Arrivals& from, std::size_t pixel, ColumnBlock& block) noexcept {
        std::copy_n(from.count + pixel, block_lanes, block.visible.begin());
        std::copy_n(from.hidden + pixel, block_lanes, block.hidden.begin());
        std::copy_n(from.at_surface + pixel, block_lanes, block.at_surface.begin());
        block.height = *std::ranges::max_element(block.visible);
        return block.height > 0 || *std::ranges::max_element(block.hidden) > 0;
    }
    [[nodiscard]] static std::uint32_t nearest(const std::uint64_t* level) noexcept {
        return static_cast<std::uint32_t>(*std::min_element(level, level + block_lanes) >> 32);
    }
    // Level k: words where a column is that high, ~0 elsewhere.
    static void load(const std::uint64_t* words, const LaneWords& visible, std::uint32_t k,
                     std::uint64_t* level) noexcept {
        for (std::size_t lane = 0; lane < block_lanes; ++lane)
            level[lane] = k < visible[lane] ? words[lane] : ~std::uint64_t{0};
    }
    // Loads all levels, each column from its end.
    static void load_from_end(const Arrivals& from, std::size_t pixel, const LaneWords& visible, std::size_t height,
                              std::uint64_t* levels) noexcept {
        for (std::size_t k = 0; k < height; ++k)
            for (std::size_t lane = 0; lane < block_lanes; ++lane)
                levels[k * block_lanes + lane] = k < visible[lane]
                                                     ? from.word[(visible[lane] - 1 - k) * from.stride + pixel + lane]
                                                     : ~std::uint64_t{0};
    }
    static void find_ties(const std::uint64_t* levels, std::size_t height, LaneWords& has_ties) noexcept {
        has_ties = {};
        for (std::size_t i = block_lanes; i < height * block_lanes; ++i) {
            const std::uint64_t before = levels[i - block_lanes];
            if ((levels[i] ^ before) >> 32 == 0 && levels[i] != ~std::uint64_t{0}) has_ties[i % block_lanes] = ~0u;
        }
    }
};

}  // namespace scalar

// Merge exchange compares the same levels whatever they hold, so sixteen columns go through it side by side.
template <class Levels>
[[gnu::always_inline]] inline void merge_exchange(std::uint64_t* levels, std::size_t height) noexcept {
    if (height < 2) return;
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

// Ascending. What was drawn in depth order, either way, but for a few fragments at a column's end, needs only those inserted. Far to
// near it is loaded from the end, where columns of different heights begin together.
template <class Levels>
[[gnu::always_inline]] inline void sort_words(const Arrivals& from, std::size_t pixel, const LaneWords& visible,
                                              std::size_t height, std::uint64_t* levels) noexcept {
    constexpr std::size_t few = 8;
    const auto level = [levels](std::size_t k) { return levels + k * block_lanes; };
    const auto rises = [level](std::size_t k) { return Levels::in_order(level(k), level(k + 1)); };
    std::size_t rising = 0;
    for (std::size_t k = 0; k < height && k - rising <= few; ++k) {
        Levels::load(from.word + k * from.stride + pixel, visible, static_cast<std::uint32_t>(k), level(k));
        rising = k == rising && (k == 0 || rises(k - 1)) ? k + 1 : rising;
    }
    if (height - rising <= few) {
        for (std::size_t k = rising; k < height; ++k)
            for (std::size_t at = k; at > 0 && !rises(at - 1); --at) Levels::exchange(level(at - 1), level(at));
        return;
    }
    Levels::load_from_end(from, pixel, visible, height, levels);
    std::size_t first = height - 1;
    while (first > 0 && rises(first - 1)) --first;
    if (first > few) return merge_exchange<Levels>(levels, height);
    for (std::size_t k = first; k-- > 0;)
        for (std::size_t at = k; at + 1 < height && !rises(at); ++at) Levels::exchange(level(at), level(at + 1));
}

template <class Levels>
[[gnu::always_inline]] inline bool take_levels(const Arrivals& from, std::size_t pixel, ColumnBlock& block,
                                               std::uint64_t* levels) noexcept {
    if (!Levels::find_heights(from, pixel, block)) return false;
    sort_words<Levels>(from, pixel, block.visible, block.height, levels);
    Levels::find_ties(levels, block.height, block.has_ties);
    block.nearest = block.height > 0 ? Levels::nearest(levels) : ~0u;
    block.levels = levels;
    return true;
}

}  // namespace strict

// Puts the living fragments of a batch down; false if there was no room for one of them: then `to` is of no more use.
[[nodiscard]] bool append(Arrivals& to, const pipeline::FragmentBatch& in, const std::uint32_t* alive) noexcept;
// The sixteen columns from `pixel` on, sorted into `levels`, of which there is room for as many as the highest has; all
// of `block` but where it lies and where its colours are. False if no fragment is there.
[[nodiscard]] bool take_block(const Arrivals& from, std::size_t pixel, ColumnBlock& block,
                              std::uint64_t* levels) noexcept;
// For every fragment of the block, at [level * block_lanes + lane]: the number of levels up to the last one nearer than
// it whose fragment arrived earlier; 0 if none did.
void find_arrived_before(const ColumnBlock& block, std::uint32_t* before) noexcept;

}  // namespace strata::peeling
