// peeling/programs/fixed_passes/log_exp.h - logarithm and exponential of binary32 numbers without the C library, so
// that the bits are the same on every computer. Used by the algorithm moments.
//
// Rule     Both are series in binary64, each operation rounded, truncated where the remainder is below 2^-62; the sum
//          is rounded once to binary32. The result is within 0.5 + 2^-20 units in the last place of the real value.
// Numbers  log: x = m 2^e with m in (sqrt(1/2), sqrt(2)], and log m = 2 atanh(s) with s = (m - 1) / (m + 1), |s| <
//          0.1716, up to s^27. exp: exp(-x) = 2^-k exp(r) with r = k log 2 - x, |r| < 0.35, Taylor series up to r^14; 0
//          if x > 105.
// Tests    tests/peeling/algorithms/moments_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::peeling {
inline namespace strict {

inline constexpr double log_of_2 = 0x1.62e42fefa39efp-1;

// -log(x). Precondition: x is a normal number in (0, 1].
[[nodiscard]] constexpr float minus_log(float x) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    int exponent = static_cast<int>(bits >> 23) - 127;
    double m = static_cast<double>(std::bit_cast<float>((bits & 0x007fffffu) | 0x3f800000u));
    if (m > 0x1.6a09e667f3bcdp+0) {
        m = m * 0.5;
        ++exponent;
    }
    const double s = (m - 1.0) / (m + 1.0), squared = s * s;
    double series = 0;
    for (int n = 27; n >= 1; n -= 2) series = series * squared + 1.0 / n;
    return static_cast<float>(-(exponent * log_of_2 + 2.0 * (s * series)));
}

// exp(-x). Precondition: x >= 0.
[[nodiscard]] constexpr float exp_of_minus(float x) noexcept {
    if (!(x <= 105.0f)) return 0.0f;
    const auto halvings = static_cast<int>(static_cast<double>(x) / log_of_2 + 0.5);
    const double r = halvings * log_of_2 - static_cast<double>(x);
    double series = 1.0;
    for (int n = 14; n >= 1; --n) series = 1.0 + series * r / n;
    const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - halvings) << 52);
    return static_cast<float>(series * scale);
}

}  // namespace strict
}  // namespace strata::peeling
