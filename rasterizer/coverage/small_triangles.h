// rasterizer/coverage/small_triangles.h - triangles of few pixels: 32-bit edge functions, set up a group of triangles
// at a time, and the coverage of a triangle as bit masks.
//
// Rule     Coverage is that of coverage.h. A batch takes a small triangle completely or not at all.
// Numbers  Corners are at most 2^14 subpixels apart in each direction and boxes are within them: |E| <= 2^14 2^14 2 =
//          2^29. Arithmetic is modulo 2^32, because values at pixels outside the box and of triangles that are not
//          small may wrap; these values are not used.
// Tests    tests/rasterizer/walk/tile_rasterizer_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/coverage/pixel_claims.h"
#include "rasterizer/coverage/window_corner.h"

namespace strata::rasterizer {
inline namespace strict {

inline constexpr int usable_capacity = batch_capacity - 16;  // loops over lanes may write up to 15 lanes past the count

// A group of triangles. Edge values, minus the tie, at the centre of the box's first pixel, and their change for one
// pixel right and one down: a centre is covered if all three are >= 0.
struct alignas(64) TriangleGroup {
    static constexpr int size = 16, max_width = 16, max_height = 15, max_extent = 1 << 14;
    static_assert(max_width * max_height <= usable_capacity);
    using PerTriangle = std::array<std::uint32_t, size>;

    std::array<PerTriangle, 3> x, y;    // snapped corners: the input
    PerTriangle x0, y0, width, height;  // pixel centres in the box and the clip; 0 by 0 if there are none
    PerTriangle small;                  // 1: the triangle is small and the following fields are valid
    PerTriangle area, turned;           // twice the absolute area; the sign of the area as a mask
    std::array<PerTriangle, 3> value, step, down, tie;
    PerTriangle reached;  // 0: no centre is covered, because the box has none or is completely outside one edge

    [[nodiscard]] Rect box(std::size_t k) const noexcept {
        const auto left = static_cast<int>(x0[k]), top = static_cast<int>(y0[k]);
        return {left, top, left + static_cast<int>(width[k]), top + static_cast<int>(height[k])};
    }
};

// Loads the corners of `count` triangles; vertices(k) returns the vertex indices of one. The last triangle fills the
// rest of the group.
template <class Vertices>
void load_corners(std::span<const WindowCorner> corners, std::size_t count, const Vertices& vertices,
                  TriangleGroup& group) noexcept {
    for (std::size_t k = 0; k < TriangleGroup::size; ++k) {
        const std::array<std::uint32_t, 3>& vertex = vertices(std::min(k, count - 1));
        for (std::size_t i = 0; i < 3; ++i) {
            const SubpixelPoint p = corners[vertex[i]].p;
            group.x[i][k] = static_cast<std::uint32_t>(p.x);
            group.y[i][k] = static_cast<std::uint32_t>(p.y);
        }
    }
}

// The rules and the rectangle that all groups of a draw share.
struct GroupRules {
    Rect clip;
    int subpixel_bits;
    TieRule tie_rule;
};

// The position of a small triangle in the region.
struct RegionOrigin {
    std::uint32_t column, row;  // of the box's first pixel in the region
    std::uint32_t width;        // of the region
    std::uint32_t primitive;
};

struct SmallKernels {
    void (*set_up)(const GroupRules& rules, TriangleGroup& group) noexcept;
    // Sets up boxes, areas and which triangles are small, but neither edges nor `reached`.
    void (*set_up_boxes)(const GroupRules& rules, TriangleGroup& group) noexcept;
    // Appends the pixels of small triangle `k`. Returns false if the batch must be flushed first because it already
    // contains one of them or has too little room.
    bool (*emit)(const TriangleGroup& group, std::size_t k, const RegionOrigin& origin, PixelClaims& claims,
                 FragmentBatch& batch) noexcept;
};

// The kernels of the selected instruction set. Look them up once per draw, not per group.
[[nodiscard]] const SmallKernels& small_kernels() noexcept;

namespace scalar {

// The steps of set_up_group, as loops that compilers vectorize.
inline void find_boxes(const GroupRules& rules, TriangleGroup& __restrict g) noexcept {
    const int bits = rules.subpixel_bits, half = 1 << (bits - 1);
    const Rect clip = rules.clip;
    for (std::size_t k = 0; k < TriangleGroup::size; ++k) {
        const auto x = [&](std::size_t i) { return static_cast<std::int32_t>(g.x[i][k]); };
        const auto y = [&](std::size_t i) { return static_cast<std::int32_t>(g.y[i][k]); };
        const std::int32_t left = std::min(std::min(x(0), x(1)), x(2)), right = std::max(std::max(x(0), x(1)), x(2));
        const std::int32_t top = std::min(std::min(y(0), y(1)), y(2)), bottom = std::max(std::max(y(0), y(1)), y(2));
        const std::int32_t x0 = std::max((left + half - 1) >> bits, clip.x0);  // as centre_box
        const std::int32_t y0 = std::max((top + half - 1) >> bits, clip.y0);
        const std::int32_t width = std::max(std::min(((right - half) >> bits) + 1, clip.x1) - x0, 0);
        const std::int32_t height = std::max(std::min(((bottom - half) >> bits) + 1, clip.y1) - y0, 0);
        g.x0[k] = static_cast<std::uint32_t>(x0);
        g.y0[k] = static_cast<std::uint32_t>(y0);
        g.width[k] = static_cast<std::uint32_t>(width);
        g.height[k] = static_cast<std::uint32_t>(height);
        // `room` is negative if the box is too wide or too high, the other difference if the corners are too far apart:
        // if either sign bit is set, the triangle is not small.
        const std::int32_t room = std::min(TriangleGroup::max_width - width, TriangleGroup::max_height - height);
        const std::int32_t extent = std::max(right - left, bottom - top);
        g.small[k] = ~static_cast<std::uint32_t>(room | (TriangleGroup::max_extent - extent)) >> 31;
    }
}

inline void find_areas(TriangleGroup& __restrict g) noexcept {
    for (std::size_t k = 0; k < TriangleGroup::size; ++k) {
        const std::uint32_t area =
            (g.x[1][k] - g.x[0][k]) * (g.y[2][k] - g.y[0][k]) - (g.y[1][k] - g.y[0][k]) * (g.x[2][k] - g.x[0][k]);
        // All ones for a negative area; (v ^ turned) - turned then negates v.
        g.turned[k] = 0 - (area >> 31);
        g.area[k] = (area ^ g.turned[k]) - g.turned[k];
    }
}

// Edge `i` as in Edge and TriangleEdges.
inline void find_edge(const GroupRules& rules, std::size_t i, TriangleGroup& __restrict g) noexcept {
    const bool left = rules.tie_rule == TieRule::top_left || rules.tie_rule == TieRule::bottom_left;
    const bool top = rules.tie_rule == TieRule::top_left || rules.tie_rule == TieRule::top_right;
    const std::uint32_t against_dy = left ? ~0u : 0u, against_dx = top ? 0u : ~0u;
    const int bits = rules.subpixel_bits;
    const std::size_t from = (i + 1) % 3, to = (i + 2) % 3;
    for (std::size_t k = 0; k < TriangleGroup::size; ++k) {
        const std::uint32_t turned = g.turned[k], half = 1u << (bits - 1);
        const std::uint32_t dx = ((g.x[to][k] - g.x[from][k]) ^ turned) - turned;
        const std::uint32_t dy = ((g.y[to][k] - g.y[from][k]) ^ turned) - turned;
        const std::uint32_t by_dy = (dy ^ against_dy) - against_dy, by_dx = (dx ^ against_dx) - against_dx;
        // The edge owns its ties if this is positive; dx and dy are not both 0.
        const std::uint32_t owner = dy != 0 ? by_dy : by_dx;
        const std::uint32_t tie = owner >> 31;
        g.tie[i][k] = tie;
        g.value[i][k] =
            dx * ((g.y0[k] << bits) + half - g.y[from][k]) - dy * ((g.x0[k] << bits) + half - g.x[from][k]) - tie;
        g.step[i][k] = (0 - dy) << bits;
        g.down[i][k] = dx << bits;
    }
}

// An edge function is largest at a corner of the box. Values that wrapped belong to triangles that are not small.
inline void find_reached(TriangleGroup& __restrict g) noexcept {
    for (std::size_t k = 0; k < TriangleGroup::size; ++k) {
        const auto if_positive = [](std::uint32_t v) { return v & ((v >> 31) - 1); };
        std::uint32_t outside = 0;
        for (std::size_t i = 0; i < 3; ++i)
            outside |= g.value[i][k] + if_positive(g.step[i][k]) * (g.width[k] - 1) +
                       if_positive(g.down[i][k]) * (g.height[k] - 1);
        const std::uint32_t has_box = (g.width[k] != 0 ? 1u : 0u) & (g.height[k] != 0 ? 1u : 0u);
        g.reached[k] = has_box & ~(outside >> 31 & g.small[k]);
    }
}

inline void set_up_boxes(const GroupRules& rules, TriangleGroup& group) noexcept {
    find_boxes(rules, group);
    find_areas(group);
}
inline void set_up_group(const GroupRules& rules, TriangleGroup& group) noexcept {
    set_up_boxes(rules, group);
    for (std::size_t i = 0; i < 3; ++i) find_edge(rules, i, group);
    find_reached(group);
}

// The meaning of SmallKernels::emit: coverage first, because the batch takes all pixels of the triangle or none.
inline bool emit_small(const TriangleGroup& g, std::size_t k, const RegionOrigin& origin, PixelClaims& claims,
                       FragmentBatch& batch) noexcept {
    std::array<std::uint32_t, TriangleGroup::max_height> covered{};
    int count = 0;
    for (std::uint32_t row = 0; row < g.height[k]; ++row) {
        for (std::uint32_t column = 0; column < g.width[k]; ++column) {
            std::uint32_t any = 0;
            for (std::size_t i = 0; i < 3; ++i) any |= g.value[i][k] + row * g.down[i][k] + column * g.step[i][k];
            covered[row] |= (~any >> 31) << column;
        }
        count += std::popcount(covered[row]);
    }
    const auto bits_of = [&](std::uint32_t row) { return covered[row]; };
    if (batch.count + count > usable_capacity ||
        !claims.claim_rows({origin.row, origin.column}, g.width[k], g.height[k], bits_of))
        return false;
    auto at = static_cast<std::size_t>(batch.count);
    for (std::uint32_t row = 0; row < g.height[k]; ++row)
        for (std::uint32_t column = 0; column < g.width[k]; ++column) {
            if ((covered[row] >> column & 1) == 0) continue;
            batch.pixel[at] = (origin.row + row) * origin.width + origin.column + column;
            batch.x[at] = static_cast<std::uint16_t>(g.x0[k] + column);
            batch.y[at] = static_cast<std::uint16_t>(g.y0[k] + row);
            batch.primitive[at++] = origin.primitive;
        }
    batch.count += count;
    return true;
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::rasterizer
