// rasterizer/cut_coordinates.h - texture coordinates by the weights of NV2A's depth interpolator.
//
// Rule     u (1/w) rounded to binary32 at the vertex; summed as window_z.h sums depths, before its floor, then cut to
//          binary32. Where w is not equal everywhere 1/w is summed alike, and the first times the reciprocal of the
//          second, both cut to binary32. Equal bits at all corners are that constant.
// Source   [A]: nv2a-depth.md 1 applied to coordinates; fits the captures of Texture_perspective but for one texel.
// Tests    tests/rasterizer/cut_coordinates_test.cpp
#pragma once
#include <array>

#include "rasterizer/depth_hypothesis.h"
#include "rasterizer/plane.h"

namespace strata::rasterizer {

void cut_coordinates(const std::array<float, 3>& u, const std::array<float, 3>& inverse_w, const TriangleLanes& lanes,
                     const DepthHypothesis& hypothesis, float* out) noexcept;

}  // namespace strata::rasterizer
