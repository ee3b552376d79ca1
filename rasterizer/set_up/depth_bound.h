// rasterizer/set_up/depth_bound.h - how far away the fragments of some triangles can be at most, before any of them is
// made.
//
// Rule     No shader_z of a fragment is greater, and no code of DepthPath::float32 or exact is greater than the
//          bound's. Of keys (DepthOrder::greater) nothing is said: the bound is infinite.
// Numbers  A covered centre is a convex combination of the snapped corners, so over snapped positions the plane stays
//          below its greatest corner. Planes over unsnapped positions are asked at most half a subpixel (1, if
//          positions are cut) beyond: the bound adds |dz/dx| + |dz/dy| times that. 2^-20 of the magnitude covers all
//          roundings to binary32.
// Tests    tests/rasterizer/set_up/depth_bound_test.cpp
#pragma once
#include <span>

#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

// In the units of shader_z; -infinity for no triangles.
[[nodiscard]] double depth_bound(const Geometry& geometry, std::span<const std::uint32_t> triangles);

}  // namespace strata::rasterizer
