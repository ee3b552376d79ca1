// rasterizer/values/depth/stepped_z.h - shader_z by planes that are stepped in binary32 (float_planes.h,
// ordered_planes.h), with the polygon offset that belongs to them.
//
// Source   pipeline/reference/mesa-rasterizers.md 2.4 and 3.3
// Tests    tests/rasterizer/values/float_planes_test.cpp, ordered_planes_test.cpp
#pragma once
#include "rasterizer/values/depth/path_depth.h"

namespace strata::rasterizer {

// Writes shader_z of the fragments, for rules whose plane is not PlaneRule::exact.
void fill_stepped_z(const DepthConstants& constants, const TriangleFragments& fragments) noexcept;

}  // namespace strata::rasterizer
