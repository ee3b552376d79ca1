// rasterizer/values/cut_coordinates.h - texture coordinates as NV2A (GeForce3 class) sums them.
//
// Rule     Weights b as in cut_weight.h, 1 - (the two others) at the vertex that takes the remainder of colours, too. u
//          = u1 + b0 (u0 - u1) + b2 (u2 - u1): the three terms cut toward zero to multiples of 2^(k - 23), added, the
//          sum cut to binary32; k the largest of their exponents, a product's being the sum of its factors'. Equal bits
//          at all corners are that constant. Where w differs: the exact plane, or by
//          PerspectiveCoordinates::cut_products the same sum by the weights of perspective_weights.h.
// Source   [M] our own fit of captures: the sign of 314 coordinates that are 0 but for rounding (ClipPlane), 40,960
//          that are whole numbers (checkerboards of CombinerOps and SpecialInputs), 52 shadow comparisons: 0 wrong.
// Numbers  Differences, products and 1 - b in binary64: exact where exponents are less than 29 apart, else rounded [A].
// Tests    tests/rasterizer/values/cut_coordinates_test.cpp
#pragma once
#include <array>

#include "rasterizer/rules/rules.h"
#include "rasterizer/values/plane.h"

namespace strata::rasterizer {

// Whether the chip's rule applies to a triangle; inverse_w are the three corners' values.
[[nodiscard]] constexpr bool cuts_coordinates(const RasterRules& rules, const auto& inverse_w) noexcept {
    const bool is_affine = inverse_w[0] == inverse_w[1] && inverse_w[0] == inverse_w[2];
    return rules.interpolation.texture_coordinates == CoordinateRule::cut_weights &&
           (is_affine || rules.interpolation.perspective_coordinates == PerspectiveCoordinates::cut_products);
}

// The corners' w, for cut_coordinates: 1 where 1 / w is equal in binary32.
[[nodiscard]] constexpr std::array<float, 3> cut_w(const auto& inverse_w, const std::array<float, 3>& w) noexcept {
    return inverse_w[0] == inverse_w[1] && inverse_w[0] == inverse_w[2] ? std::array{1.0f, 1.0f, 1.0f} : w;
}

// Of the lanes' fragments; `u` and cut_w at the corners.
void cut_coordinates(const std::array<float, 3>& u, const std::array<float, 3>& w, const TriangleLanes& lanes,
                     const DepthHypothesis& hypothesis, float* out) noexcept;

}  // namespace strata::rasterizer
