// rasterizer/coverage/edge.h - which pixel centres are inside a triangle.
//
// Rule     A centre is inside if all three edge functions are positive. A centre exactly on an edge belongs to the
//          triangle if the tie rule names that edge: by default a top edge (horizontal, interior below) or a left edge.
// Source   rasterizer/reference/coverage.md 5.3: D3D 11.3 3.4.2.1; measured on NV2A (chip-geometry.md 1.5). OpenGL 2.1
//          3.5.1 only requires that exactly one of two triangles sharing the edge covers the centre.
// Numbers  |coordinate| <= 2^27 subpixels (2^15 pixels at n = 12): differences <= 2^28, products <= 2^56, E <= 2^57.
// Tests    tests/rasterizer/coverage/edge_test.cpp
#pragma once
#include <cstdint>

#include "rasterizer/rules/rules.h"

namespace strata::rasterizer {

// Window position in units of 1/2^n pixel, y down; n is the profile's `subpixel_bits`.
struct SubpixelPoint {
    std::int32_t x = 0;
    std::int32_t y = 0;
    friend constexpr bool operator==(SubpixelPoint, SubpixelPoint) = default;
};

// One directed side of a triangle whose vertices run clockwise on the y-down surface.
class Edge {
  public:
    constexpr Edge(SubpixelPoint from, SubpixelPoint to) noexcept : Edge{from, to, 1} {}
    // With turn -1, the same side in the opposite direction.
    constexpr Edge(SubpixelPoint from, SubpixelPoint to, std::int64_t turn) noexcept
        : from_{from}, dx_{turn * (to.x - from.x)}, dy_{turn * (to.y - from.y)} {}

    // E(p): twice the area of (from, to, p) in square subpixels; positive on the interior side; exact.
    [[nodiscard]] constexpr std::int64_t at(SubpixelPoint p) const noexcept {
        return dx_ * (std::int64_t{p.y} - from_.y) - dy_ * (std::int64_t{p.x} - from_.x);
    }
    // Change of E for one subpixel to the right, and for one down.
    [[nodiscard]] constexpr std::int64_t step_x() const noexcept { return -dy_; }
    [[nodiscard]] constexpr std::int64_t step_y() const noexcept { return dx_; }

    // True if centres exactly on a side of direction (dx, dy) belong to its triangle. Precondition: (dx, dy) is not (0,
    // 0). Clockwise and y down: a side that runs right has the interior below it (top), one that runs up has it on its
    // right (left).
    [[nodiscard]] static constexpr bool owns_ties(std::int64_t dx, std::int64_t dy, TieRule rule) noexcept {
        const bool left = rule == TieRule::top_left || rule == TieRule::bottom_left;
        const bool top = rule == TieRule::top_left || rule == TieRule::top_right;
        return (dy != 0 ? (left ? -dy : dy) : (top ? dx : -dx)) > 0;
    }
    [[nodiscard]] constexpr bool owns_ties(TieRule rule) const noexcept { return owns_ties(dx_, dy_, rule); }
    [[nodiscard]] constexpr bool owns(SubpixelPoint p, TieRule rule) const noexcept {
        const std::int64_t e = at(p);
        return e > 0 || (e == 0 && owns_ties(rule));
    }

  private:
    SubpixelPoint from_;
    std::int64_t dx_, dy_;
};

}  // namespace strata::rasterizer
