// rasterizer/coverage/sample_rectangle.h - the lines of a frame of several samples.
//
// Rule     A sample is covered if it lies in the rectangle of the line's width around the segment. The width is rounded
//          to 1/256 pixel, halves up, and at most 32767 pixels. A side, or an end, owns the points on it if the
//          rectangle lies to its right, or exactly below it. The ends are those of the snapped segment, moved so that
//          the sample is at the pixel's centre (window.h). Points are squares by their own rule.
// Source   OpenGL 4.6 14.4.3 and 14.5.4; rasterizer/reference/lines-and-points.md 4.2.
// Numbers  The distance from the segment, times its length, is at most floor(sqrt(N) / 512) with N = (w 2^n)^2 |d|^2 <
//          2^127, w in 1/256 pixel and n subpixel bits: all in integers.
// Tests    tests/rasterizer/coverage/sample_rectangle_test.cpp
#pragma once
#include "rasterizer/coverage/line_coverage.h"

namespace strata::rasterizer {

// True if the rules say which samples the primitive covers.
[[nodiscard]] constexpr bool covers_samples(const RasterRules& rules, Primitive primitive) noexcept {
    switch (shape_of(primitive)) {
        case Shape::line: return rules.lines == LineRule::diamond_exit;
        case Shape::point: return rules.points == PointRule::square;
        default: return true;
    }
}

[[nodiscard]] ShapeCoverage sample_rectangle(SubpixelPoint a, SubpixelPoint b, float width_px,
                                             int subpixel_bits) noexcept;

}  // namespace strata::rasterizer
