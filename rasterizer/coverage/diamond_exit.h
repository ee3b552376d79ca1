// rasterizer/coverage/diamond_exit.h - the pixels of OpenGL's aliased lines.
//
// Rule     A fragment for every diamond |x - xc| + |y - yc| < 1/2 that the segment meets and does not end in. Both ends
//          are moved by (-e, -e^2) first, e infinitesimal and y up, so that there are no ties. Wider lines replicate
//          each fragment across the longer direction, evenly to both sides; the width is rounded to an integer, at
//          least 1.
// Source   OpenGL 2.1 3.4.1 and 3.4.2, OpenGL 4.5 14.5.1 and 14.5.2; rasterizer/reference/lines-and-points.md 4.
// Tests    tests/rasterizer/coverage/diamond_exit_test.cpp
#pragma once
#include "rasterizer/coverage/line_coverage.h"

namespace strata::rasterizer {

[[nodiscard]] ShapeCoverage diamond_exit(SubpixelPoint a, SubpixelPoint b, float width_px, int subpixel_bits) noexcept;

}  // namespace strata::rasterizer
