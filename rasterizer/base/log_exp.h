// rasterizer/base/log_exp.h - logarithm, exponential and power of binary32 numbers without the C library, so that the
// bits are the same on every computer. Used by lights, by the algorithm moments and by formulas of weights.
//
// Rule     Both are series in binary64, each operation rounded, truncated where the remainder is below 2^-62; the sum
//          is rounded once to binary32. The result is within 0.5 + 2^-20 units in the last place of the real value.
// Numbers  log: x = m 2^e with m in (sqrt(1/2), sqrt(2)], and log m = 2 atanh(s) with s = (m - 1) / (m + 1), |s| <
//          0.1716, up to s^27. exp: exp(x) = 2^k exp(r) with r = x - k log 2, |r| < 0.35, Taylor series up to r^14; 0
//          if x < -105.
// Tests    tests/peeling/algorithms/moments_test.cpp, weight_formula_test.cpp
#pragma once
#include <bit>
#include <cstdint>
#include <limits>

#include "rasterizer/base/numerics.h"

namespace strata {
inline namespace strict {

inline constexpr double log_of_2 = 0x1.62e42fefa39efp-1;

// log(x) before it is rounded to binary32. Precondition: x is positive and finite.
[[nodiscard]] constexpr double natural_log(float x) noexcept {
    const bool is_normal = x >= 0x1p-126f;
    const auto bits = std::bit_cast<std::uint32_t>(is_normal ? x : x * 0x1p24f);
    int exponent = static_cast<int>(bits >> 23) - (is_normal ? 127 : 151);
    double m = static_cast<double>(std::bit_cast<float>((bits & 0x007fffffu) | 0x3f800000u));
    if (m > 0x1.6a09e667f3bcdp+0) {
        m = m * 0.5;
        ++exponent;
    }
    const double s = (m - 1.0) / (m + 1.0), squared = s * s;
    double series = 0;
    for (int n = 27; n >= 1; n -= 2) series = series * squared + 1.0 / n;
    return exponent * log_of_2 + 2.0 * (s * series);
}

// exp(x): 0 below -105, infinity above the logarithm of the greatest binary32 number; NaN stays.
[[nodiscard]] constexpr float exponential(double x) noexcept {
    if (x < -105.0) return 0.0f;
    if (x > 0x1.62e42fefa39efp+6) return std::numeric_limits<float>::infinity();
    if (!(x >= -105.0)) return std::numeric_limits<float>::quiet_NaN();
    const auto doublings = static_cast<int>(x / log_of_2 + (x < 0 ? -0.5 : 0.5));
    const double r = x - doublings * log_of_2;
    double series = 1.0;
    for (int n = 14; n >= 1; --n) series = 1.0 + series * r / n;
    const double value = series * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + doublings) << 52);
    constexpr double first_beyond = 0x1.ffffffp+127;  // rounds to 2^128
    return value < first_beyond ? static_cast<float>(value) : std::numeric_limits<float>::infinity();
}

// -log(x). Precondition: x is a normal number in (0, 1].
[[nodiscard]] constexpr float minus_log(float x) noexcept { return static_cast<float>(-natural_log(x)); }

// x^y, and 0 for x = 0 with y above 0, 1 for y = 0. Precondition: x is finite and at least 0, y finite and at least 0.
[[nodiscard]] constexpr float power(float x, float y) noexcept {
    if (y == 0.0f) return 1.0f;
    return x > 0.0f ? exponential(static_cast<double>(y) * natural_log(x)) : 0.0f;
}

// exp(-x). Precondition: x >= 0.
[[nodiscard]] constexpr float exp_of_minus(float x) noexcept {
    return x <= 105.0f ? exponential(-static_cast<double>(x)) : 0.0f;
}

}  // namespace strict
}  // namespace strata
