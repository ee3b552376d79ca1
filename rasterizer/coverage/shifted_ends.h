// rasterizer/coverage/shifted_ends.h - the pixels of llvmpipe's aliased lines and points.
//
// Rule     A line is a parallelogram: two sides parallel to the line, half its width away along the shorter axis, and
//          two across. Where the diamonds of the ends say otherwise than the side across, that end is moved to the
//          border of its pixel, along the line. All of it is binary32 until the four corners are rounded to subpixels.
//          A point is a square of its size in subpixels, at least a pixel. Left and lower sides own their ties.
// Source   Mesa 22.3 (lp_setup_line.c, lp_setup_point.c); rasterizer/reference/lines-and-points.md 4.1 and 5.
// Numbers  Positions are within 2^15 pixels, widths below 2^8: corners are below 2^24 subpixels.
// Tests    tests/rasterizer/coverage/shifted_ends_test.cpp
#pragma once
#include "rasterizer/coverage/line_coverage.h"

namespace strata::rasterizer {

// Window positions of the ends, not snapped, in submission order.
[[nodiscard]] ShapeCoverage shifted_ends(const std::array<float, 2>& a, const std::array<float, 2>& b, float width_px,
                                         int subpixel_bits) noexcept;
// The pixels of a point.
[[nodiscard]] Rect subpixel_square(const std::array<float, 2>& p, float size_px, int subpixel_bits) noexcept;

}  // namespace strata::rasterizer
