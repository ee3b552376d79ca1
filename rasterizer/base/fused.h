// rasterizer/base/fused.h - a multiply-add with a single rounding, exact also on processors without a fused
// instruction.
//
// Rule     The product of two binary32 numbers is exact in binary64. The sum is rounded to odd in binary64, so the
//          conversion to binary32 is the only rounding that affects the result.
// Source   rasterizer/reference/numbers.md 3.4.
// Tests    tests/rasterizer/set_up/window_test.cpp; tests/rasterizer/values/float_planes_test.cpp compares with
//          std::fma.
#pragma once
#include <bit>
#include <cstdint>

#include "rasterizer/base/exact_sum.h"

namespace strata::rasterizer {
inline namespace strict {

// a * b + c rounded once to binary32.
[[nodiscard]] constexpr float fused_multiply_add(float a, float b, float c) noexcept {
    const TwoTerms sum = two_sum(double{a} * b, double{c});
    auto bits = std::bit_cast<std::uint64_t>(sum.high);
    // If the sum is infinite, its low part is NaN: both comparisons are false and the sum is returned unchanged.
    if ((sum.low < 0.0 || sum.low > 0.0) && (bits & 1) == 0)
        bits += (sum.low > 0.0) == (sum.high > 0.0) ? 1 : ~std::uint64_t{0};  // round to odd
    return static_cast<float>(std::bit_cast<double>(bits));
}

}  // namespace strict
}  // namespace strata::rasterizer
