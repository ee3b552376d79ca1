// rasterizer/set_up/check_input.h - what `set_up` asks of the state and the soup that a caller hands in.
//
// Rule     InputError names the field ("triangle soup: indices[7]: expected less than 24, found 31"). Vertices may hold
//          any bits: those that are not finite are dropped and counted (setup.h).
// Numbers  A viewport lies within [0, 32768]: pixels have 16 bits, edge functions are exact within +-2^15 pixels.
// Tests    tests/rasterizer/set_up/check_input_test.cpp
#pragma once
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

inline constexpr int greatest_coordinate_px = 32768;

// Ranges, enums and finite floats of every field that set-up reads.
void check(const RasterState& state);
// One pass over the indices and the order.
void check(const TriangleSoup& soup);

}  // namespace strata::rasterizer
