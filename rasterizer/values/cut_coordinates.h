// rasterizer/values/cut_coordinates.h - texture coordinates as NV2A (GeForce3 class) sums them, where w is equal at all corners.
//
// Rule     Weights b as in cut_weight.h, 1 - (the two others) at the vertex that takes the remainder of colours, too. u = u1 +
//          b0 (u0 - u1) + b2 (u2 - u1): the three terms cut toward zero to multiples of 2^(k - 23), added, the sum cut to
//          binary32; k the largest of their exponents, a product's being the sum of its factors'. Equal bits at all corners
//          are that constant. Where w differs, nothing is measured: the exact plane.
// Source   [M] our own fit of captures: the sign of 314 coordinates that are 0 but for rounding (ClipPlane), 40,960 that are
//          whole numbers (checkerboards of CombinerOps and SpecialInputs), 52 shadow comparisons: 0 wrong.
// Numbers  Differences, products and 1 - b in binary64: exact where exponents are less than 29 apart, else rounded [A].
// Tests    tests/rasterizer/values/cut_coordinates_test.cpp
#pragma once
#include <array>

#include "rasterizer/rules/rules.h"
#include "rasterizer/values/plane.h"

namespace strata::rasterizer {

// Whether the chip's rule applies to a triangle; inverse_w are the three corners' values.
[[nodiscard]] constexpr bool cuts_coordinates(const RasterRules& rules, const auto& inverse_w) noexcept {
    return rules.interpolation.texture_coordinates == CoordinateRule::cut_weights && inverse_w[0] == inverse_w[1] &&
           inverse_w[0] == inverse_w[2];
}

// Of the lanes' fragments; `u` at the corners.
void cut_coordinates(const std::array<float, 3>& u, const TriangleLanes& lanes, float* out) noexcept;

}  // namespace strata::rasterizer
