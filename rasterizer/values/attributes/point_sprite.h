// rasterizer/values/attributes/point_sprite.h - texture coordinates of a point's own square.
//
// Rule     With RasterState::point_sprites s and t of a point grow from 0 to 1 over its square, t downwards: u = 1/2 +
//          (c - p) / size in both axes. square: quotient and sum in binary64, then to the nearest binary32. reciprocal:
//          as the point's coverage, the sum cut toward zero to 24 bits; a point of size 0 has 1/2 [assumed].
// Source   rasterizer/reference/lines-and-points.md 5.1
// Tests    tests/rasterizer/values/point_sprite_test.cpp
#pragma once
#include "rasterizer/values/triangle_fragments.h"

namespace strata::rasterizer {

// Writes the batch's texture coordinates; the shape must be a point.
void fill_sprite_coordinates(const TriangleFragments& fragments) noexcept;

}  // namespace strata::rasterizer
