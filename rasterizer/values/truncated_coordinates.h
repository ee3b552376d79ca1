// rasterizer/values/truncated_coordinates.h - texture coordinates as NV2A (GeForce3 class) interpolates them.
//
// Rule     Weights b as in truncated_weights.h; the vertex that takes the remainder of colours has 1 - (the two others)
//          here too. u = u1 + b0 (u0 - u1) + b2 (u2 - u1): the three terms are truncated toward zero to multiples of
//          2^(k - 23) and added, and the sum is truncated to binary32. k is the largest exponent of the terms; the
//          exponent of a product is the sum of its factors' exponents. If the three corner values have the same bits,
//          the result is that value. If w differs: the exact plane, or with PerspectiveCoordinates::cut_products the
//          same sum with the weights of perspective_weights.h.
// Source   Fitted to hardware captures by this project: the sign of 314 coordinates that are 0 except for rounding
//          (ClipPlane), 40,960 coordinates that are integers (checkerboards of CombinerOps and SpecialInputs), 52
//          shadow comparisons: 0 wrong.
// Numbers  Differences, products and 1 - b are computed in binary64: exact if exponents are less than 29 apart, else
//          rounded, which is assumed.
// Tests    tests/rasterizer/values/truncated_coordinates_test.cpp
#pragma once
#include <array>

#include "rasterizer/rules/rules.h"
#include "rasterizer/values/plane.h"

namespace strata::rasterizer {

// True if the chip's rule applies to a triangle; inverse_w holds the values of the three corners.
[[nodiscard]] constexpr bool truncates_coordinates(const RasterRules& rules, const auto& inverse_w) noexcept {
    const bool is_affine = inverse_w[0] == inverse_w[1] && inverse_w[0] == inverse_w[2];
    return rules.interpolation.texture_coordinates == CoordinateRule::cut_weights &&
           (is_affine || rules.interpolation.perspective_coordinates == PerspectiveCoordinates::cut_products);
}

// The corners' w for truncated_coordinates: 1 if the three 1 / w are equal in binary32.
[[nodiscard]] constexpr std::array<float, 3> coordinate_w(const auto& inverse_w,
                                                          const std::array<float, 3>& w) noexcept {
    return inverse_w[0] == inverse_w[1] && inverse_w[0] == inverse_w[2] ? std::array{1.0f, 1.0f, 1.0f} : w;
}

// Writes the coordinate of the lanes' fragments; `u` and `w` (from coordinate_w) are the values at the corners.
void truncated_coordinates(const std::array<float, 3>& u, const std::array<float, 3>& w, const TriangleLanes& lanes,
                           const DepthHypothesis& hypothesis, float* out) noexcept;

}  // namespace strata::rasterizer
