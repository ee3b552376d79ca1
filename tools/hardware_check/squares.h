// tools/hardware_check/squares.h - the two rows of four squares that three tests draw: sides that are shared, and
// squares that a vertex program and the fixed pipeline draw side by side.
//
// Source   chip-geometry.md 1.2, 1.3 and 5.6.
// Tests    tests/tools/hardware_check/suites_test.cpp
#pragma once
#include "tools/hardware_check/shapes.h"

namespace strata::hardware_check {

// Squares of 100 pixels from (120, 140) on, `shift` pixels further right and down.
[[nodiscard]] TriangleSoup eight_squares(float shift, Argb color);

// The host un-projects the squares' corners, of world z 10 above and 0 below, and the chip projects them again: squares
// 1, 3, 4 and 6 by the fixed pipeline, which moves them by `fixed_offset` more, the others by a vertex program that has
// the view and the rest in two matrices.
struct MixedSquares {
    float shift = 0, fixed_offset = 0;
    Argb by_program = 0, by_fixed = 0;
};

// A light square under all of them, then the program's, then the fixed pipeline's.
void draw_mixed_squares(pipeline::Surface& surface, const MixedSquares& squares);

}  // namespace strata::hardware_check
