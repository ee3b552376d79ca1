// rasterizer/set_up/depth_bound.h - an upper bound on the depth of the fragments of some triangles, before any fragment
// is generated.
//
// Rule     No fragment has a greater shader_z, and none has a code of DepthPath::float32 or exact greater than the
//          bound's code. With DepthOrder::greater the bound is infinite.
// Numbers  A covered centre is a convex combination of the snapped corners, so a plane over snapped positions does not
//          exceed its greatest corner. Planes over unsnapped positions are evaluated at most half a subpixel (one
//          subpixel if positions are truncated) outside the triangle: the bound adds |dz/dx| + |dz/dy| times that.
//          2^-20 of the magnitude covers all roundings to binary32.
// Tests    tests/rasterizer/set_up/depth_bound_test.cpp
#pragma once
#include <span>

#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {

// The bound in the units of shader_z; -infinity for no triangles.
[[nodiscard]] double depth_bound(const Geometry& geometry, std::span<const std::uint32_t> triangles);

}  // namespace strata::rasterizer
