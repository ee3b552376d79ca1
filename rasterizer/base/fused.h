// rasterizer/base/fused.h - a multiply-add that rounds once, exact on machines that have none.
//
// Rule     The product of two binary32 is exact in binary64; the sum is rounded to odd there, so that the second
//          rounding is the only one.
// Source   numbers.md 3.4. Tests tests/rasterizer/set_up/window_test.cpp;
//          tests/rasterizer/values/float_planes_test.cpp: std::fma
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
    // An infinite sum leaves NaN below it, which is neither: the sum stands.
    if ((sum.low < 0.0 || sum.low > 0.0) && (bits & 1) == 0)
        bits += (sum.low > 0.0) == (sum.high > 0.0) ? 1 : ~std::uint64_t{0};  // to odd
    return static_cast<float>(std::bit_cast<double>(bits));
}

}  // namespace strict
}  // namespace strata::rasterizer
