// tools/lab/hardware_check/drawing/squares.h - the two rows of four squares of three tests, which share edges and are
// drawn by a vertex program and by the fixed-function pipeline.
//
// Source   rasterizer/reference/chip-geometry.md 1.2, 1.3 and 5.6.
// Tests    tests/tools/lab/hardware_check/suites_test.cpp
#pragma once
#include "tools/lab/hardware_check/drawing/shapes.h"

namespace strata::hardware_check {

// Squares of 100 pixels starting at (120, 140), moved by `shift` pixels to the right and down.
[[nodiscard]] TriangleSoup eight_squares(float shift, Argb color);

// The host un-projects the squares' corners, at world z 10 in the upper row and 0 in the lower, and the chip projects
// them again: squares 1, 3, 4 and 6 with the fixed-function pipeline, which adds `fixed_offset`, the others with a
// vertex program that has the view and the projection in two matrices.
struct MixedSquares {
    float shift = 0, fixed_offset = 0;
    Argb by_program = 0, by_fixed = 0;
};

// A light square below all of them, then the program's squares, then the fixed-function pipeline's.
void draw_mixed_squares(pipeline::Surface& surface, const MixedSquares& squares);

}  // namespace strata::hardware_check
