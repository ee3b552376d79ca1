// rasterizer/values/depth_quotient.h - the arithmetic of R = r/q, used by shadow comparisons and by depth replace.
//
// Rule     Comparison (4): R = ((r/w) / (1/w)) / ((q/w) / (1/w)). Each of the three planes is rounded to the
//          interpolants' bits, each of the three divisions is a rounded operation by DivideRule. Depth replace and
//          shadow comparison both use these functions, so the two paths agree in every bit.
// Source   Everitt 2001, (4); rasterizer/reference/depth.md 4.5, 4.6 and 6.
// Numbers  Truncation of 1/d: the product of two binary32 is exact in binary64, so it shows on which side of 1/d the
//          rounded reciprocal is.
// Tests    tests/rasterizer/values/depth_paths_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"
#include "rasterizer/rules/depth_hypothesis.h"

namespace strata::rasterizer {
inline namespace strict {

// v rounded to `bits` significant bits (16 to 24), to nearest, ties to even; infinities and NaN are returned unchanged.
[[nodiscard]] constexpr float round_mantissa(float v, int bits) noexcept {
    auto u = std::bit_cast<std::uint32_t>(v);
    if (bits >= 24 || (u & 0x7f800000u) == 0x7f800000u) return v;
    const unsigned dropped = 24u - static_cast<unsigned>(bits);
    u += ((1u << (dropped - 1)) - 1) + (u >> dropped & 1u);
    return std::bit_cast<float>(u >> dropped << dropped);
}

// The next binary32 toward zero; 0, infinities and NaN are returned unchanged.
[[nodiscard]] constexpr float toward_zero(float v) noexcept {
    const auto u = std::bit_cast<std::uint32_t>(v);
    const bool stays = (u & 0x7fffffffu) == 0 || (u & 0x7f800000u) == 0x7f800000u;
    return stays ? v : std::bit_cast<float>(u - 1);
}

// 1 / d, truncated toward zero.
[[nodiscard]] constexpr float truncated_reciprocal(float d) noexcept {
    const float r = 1.0f / d;
    return double{r} * double{d} > 1.0 ? toward_zero(r) : r;
}

// n / d by the rule of the hypothesis (depth.md 8.2); a zero divisor gives the IEEE 754 result.
[[nodiscard]] constexpr float divide(float n, float d, DivideRule rule) noexcept {
    switch (rule) {
        case DivideRule::exact: return n / d;
        case DivideRule::cut_reciprocal: return n * truncated_reciprocal(d);
        case DivideRule::low_reciprocal: break;
    }
    return n * toward_zero(1.0f / d);
}

// Depth replace: true if d may be stored; false for NaN (depth.md 4.6).
[[nodiscard]] constexpr bool is_in_depth_range(double d, double least, double greatest) noexcept {
    return d >= least && d <= greatest;
}

}  // namespace strict
}  // namespace strata::rasterizer
