// rasterizer/values/depth_quotient.h - the arithmetic of R = r/q, which a shadow comparison compares and depth replace
// stores.
//
// Rule     Comparison (4): R = ((r/w) / (1/w)) / ((q/w) / (1/w)). Each of the three planes is rounded to the
//          interpolants' bits, each of the three divides is a rounded operation by DivideRule. Depth replace stores,
//          and a comparison compares, what these functions give: so the two paths agree in every bit.
// Source   Everitt 2001, (4); depth.md 4.5, 4.6 and 6.
// Numbers  1/d cut: the product of two binary32 is exact in binary64, so it tells on which side of 1/d rounding led.
// Tests    tests/rasterizer/values/depth_paths_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"
#include "rasterizer/rules/depth_hypothesis.h"

namespace strata::rasterizer {
inline namespace strict {

// v to `bits` significant bits (16 to 24), to nearest, ties to even; infinities and NaN stay.
[[nodiscard]] constexpr float round_mantissa(float v, int bits) noexcept {
    auto u = std::bit_cast<std::uint32_t>(v);
    if (bits >= 24 || (u & 0x7f800000u) == 0x7f800000u) return v;
    const unsigned dropped = 24u - static_cast<unsigned>(bits);
    u += ((1u << (dropped - 1)) - 1) + (u >> dropped & 1u);
    return std::bit_cast<float>(u >> dropped << dropped);
}

// The neighbour of v on the side of zero; 0, infinities and NaN stay.
[[nodiscard]] constexpr float toward_zero(float v) noexcept {
    const auto u = std::bit_cast<std::uint32_t>(v);
    const bool stays = (u & 0x7fffffffu) == 0 || (u & 0x7f800000u) == 0x7f800000u;
    return stays ? v : std::bit_cast<float>(u - 1);
}

// 1 / d, cut toward zero.
[[nodiscard]] constexpr float cut_reciprocal(float d) noexcept {
    const float r = 1.0f / d;
    return double{r} * double{d} > 1.0 ? toward_zero(r) : r;
}

// n / d by the rule of the hypothesis (depth.md 8.2); a zero divisor gives what IEEE 754 gives.
[[nodiscard]] constexpr float divide(float n, float d, DivideRule rule) noexcept {
    switch (rule) {
        case DivideRule::exact: return n / d;
        case DivideRule::cut_reciprocal: return n * cut_reciprocal(d);
        case DivideRule::low_reciprocal: return n * toward_zero(1.0f / d);
    }
    return 0.0f;  // unreachable: the enum is closed
}

// Depth replace: whether d may be stored; NaN may not. depth.md 4.6.
[[nodiscard]] constexpr bool is_in_depth_range(double d, double least, double greatest) noexcept {
    return d >= least && d <= greatest;
}

}  // namespace strict
}  // namespace strata::rasterizer
