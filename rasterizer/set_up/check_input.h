// rasterizer/set_up/check_input.h - checks the state and the triangle soup that a caller passes to `set_up`.
//
// Rule     InputError names the field ("triangle soup: indices[7]: expected less than 24, found 31"). Vertices may have
//          any bits: those that are not finite are dropped and counted (setup.h).
// Numbers  A viewport is within [0, 32768]: pixel coordinates have 16 bits, edge functions are exact within +-2^15
//          pixels.
// Tests    tests/rasterizer/set_up/check_input_test.cpp
#pragma once
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

inline constexpr int greatest_coordinate_px = 32768;
// Of line widths and point sizes: more than every viewport has.
inline constexpr float greatest_size_px = 65536.0f;

// Checks ranges, enums and finiteness of every field that set-up reads.
void check(const RasterState& state);
// Checks the indices and the order in one pass.
void check(const TriangleSoup& soup);
// The rules and the state of lines and points, if the soup has any.
void check(const TriangleSoup& soup, const RasterState& state, const RasterRules& rules);

}  // namespace strata::rasterizer
