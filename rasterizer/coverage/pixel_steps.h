// rasterizer/coverage/pixel_steps.h - the pixels of softpipe's lines and points: steps from the pixel of one end to
// that of the other, or the corners of two triangles.
//
// Rule     A thin line steps along its longer axis from the pixel of its start to the one before that of its end, with
//          the nearest pixel across; a half goes on in the line's direction. A line whose width is at least 1.5, and
//          every point, is drawn as the triangles 0 2 3 and 0 3 1 of four corners, by float_spans.h.
// Source   rasterizer/reference/lines-and-points.md 4.3 and 5.
// Numbers  Positions are rounded to binary32 after each operation. Pixels are below 2^20.
// Tests    tests/rasterizer/coverage/pixel_steps_test.cpp
#pragma once
#include "rasterizer/coverage/float_spans.h"
#include "rasterizer/coverage/line_coverage.h"

namespace strata::rasterizer {

// Corners 0 and 1 are at the first end, 2 and 3 at the second.
using QuadCorners = std::array<WindowPosition, 4>;

[[nodiscard]] ShapeCoverage pixel_steps(const WindowPosition& a, const WindowPosition& b, int subpixel_bits) noexcept;

[[nodiscard]] QuadCorners wide_line_corners(const WindowPosition& a, const WindowPosition& b, float width_px) noexcept;
[[nodiscard]] QuadCorners point_corners(const WindowPosition& p, float size_px) noexcept;

// True if the rules draw a line or point of this state as two triangles.
[[nodiscard]] constexpr bool is_drawn_by_triangles(Shape shape, const RasterState& state,
                                                   const RasterRules& rules) noexcept {
    if (shape == Shape::line) return rules.lines == LineRule::pixel_steps && state.line_width_px >= 1.5f;
    return shape == Shape::point && rules.points == PointRule::two_triangles;
}

}  // namespace strata::rasterizer
