// rasterizer/base/nv20_arithmetic.h - binary32 arithmetic of the vertex engine of NV20 (GeForce3).
//
// Rule     Denormal inputs and results are +0. Products are truncated; 0 times anything is +0. Sums of two to four
//          values: addends are truncated to multiples of 2^(e - 28), where e is the largest exponent, and summed
//          exactly; the sum is truncated to binary32. The sum can carry into two bits above e; it then keeps 7 bits
//          below its last bit. Reciprocal: seed s = round(8192 / (64.5 + i)), where i is the 6 leading fraction bits,
//          then two Newton-Raphson steps in integer arithmetic, each truncated. Powers of two are exact. Truncation is
//          toward zero throughout.
// Source   rasterizer/reference/numbers.md 4: NV_vertex_program 2.14.1.11, and the model of envytools, which was
//          checked against hardware. Assumed: results beyond the largest finite number become that number.
// Numbers  m is the 24-bit mantissa, s the seed, s' the result of the first Newton step. s m < 2^31 and (2^37 - s' m)
//          s' < 2^51, so 64 bits suffice. The relative error of the reciprocal is at most 2^-22.
// Tests    tests/rasterizer/base/nv20_arithmetic_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "rasterizer/base/numerics.h"

namespace strata::rasterizer {
inline namespace strict {

// Rounds v toward zero to binary32; overflow gives the largest finite value of the same sign.
[[nodiscard]] constexpr float truncate_to_binary32(double v) noexcept {
    const auto f = static_cast<float>(v);
    const double size = v < 0.0 ? -v : v, rounded = f < 0.0f ? -double{f} : double{f};
    return rounded > size ? std::bit_cast<float>(std::bit_cast<std::uint32_t>(f) - 1) : f;
}

namespace nv20 {

[[nodiscard]] constexpr bool is_finite(float v) noexcept {
    return (std::bit_cast<std::uint32_t>(v) & 0x7f800000u) != 0x7f800000u;
}

// v, or +0 if v is a zero or a denormal of either sign (exponent field 0).
[[nodiscard]] constexpr float flushed(float v) noexcept {
    return (std::bit_cast<std::uint32_t>(v) & 0x7f800000u) == 0 ? 0.0f : v;
}

[[nodiscard]] constexpr bool is_nan(float v) noexcept {
    return (std::bit_cast<std::uint32_t>(v) & 0x7fffffffu) > 0x7f800000u;
}

// a b; +0 if a factor is zero or denormal, even if the other is infinite or NaN; the NaN of sign + if one is NaN, of
// either sign (numbers.md 4.2).
[[nodiscard]] constexpr float multiply(float a, float b) noexcept {
    if (flushed(a) == 0.0f || flushed(b) == 0.0f) return 0.0f;
    if (is_nan(a) || is_nan(b)) return std::numeric_limits<float>::quiet_NaN();
    return is_finite(a) && is_finite(b) ? flushed(truncate_to_binary32(double{a} * double{b})) : a * b;
}

// Sums two to four values with one alignment and one truncation, as the dot product does (numbers.md 4.3). If any value
// is not finite, returns the IEEE sum in left-to-right order.
template <std::size_t n>
[[nodiscard]] constexpr float sum(const std::array<float, n>& addends) noexcept {
    static_assert(n >= 2 && n <= 4);
    int largest = 0;
    for (const float v : addends) {
        if (!is_finite(v)) {
            float plain = 0.0f;
            for (const float each : addends) plain += each;
            return plain;
        }
        largest = std::max(largest, static_cast<int>(std::bit_cast<std::uint32_t>(v) >> 23 & 0xff));
    }
    // The truncated addends in units of 2^(largest - 127 - 28). Each is below 2^29, so the sum of four is below 2^31.
    std::int64_t total = 0;
    for (const float v : addends) {
        const auto bits = std::bit_cast<std::uint32_t>(v);
        const auto exponent = static_cast<int>(bits >> 23 & 0xff);
        if (exponent == 0) continue;
        const std::int64_t mantissa = std::int64_t{(bits & 0x7fffffu) | 0x800000u} << 5;
        const std::int64_t aligned = mantissa >> std::min(largest - exponent, 63);
        total += bits >> 31 != 0 ? -aligned : aligned;
    }
    // The total fits in 31 bits and the unit is at least 2^-154, so the conversion and the product are exact in
    // binary64.
    const double unit = std::bit_cast<double>(static_cast<std::uint64_t>(largest - 127 - 28 + 1023) << 52);
    return flushed(truncate_to_binary32(static_cast<double>(total) * unit));
}

// 1 / d (numbers.md 4.4). A zero or denormal d gives an infinity of its sign, an infinity gives +0, NaN is returned
// unchanged, and a denormal result becomes +0.
[[nodiscard]] constexpr float reciprocal(float d) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(d);
    const std::uint32_t fraction = bits & 0x7fffffu, field = bits >> 23 & 0xff, sign = bits & 0x80000000u;
    if (field == 0) return std::bit_cast<float>(sign | 0x7f800000u);
    if (!is_finite(d)) return fraction != 0 ? d : 0.0f;
    std::uint64_t mantissa = 0;
    // 1 / 2^k = 2^-k: the biased exponent becomes 254 - field. For any other mantissa 1 / m is in (0.5, 1), so the
    // exponent is one less.
    auto exponent = static_cast<int>(254 - field);
    if (fraction != 0) {
        const std::uint64_t m = fraction | 0x800000u, odd = 129 + 2 * (fraction >> 17);
        const std::uint64_t seed = (32768 + odd) / (2 * odd);
        const std::uint64_t first = ((std::uint64_t{1} << 31) - seed * m) * seed >> 24;
        const std::uint64_t second = ((std::uint64_t{1} << 37) - first * m) * first >> 25;
        mantissa = second & 0x7fffffu;
        --exponent;
    }
    if (exponent <= 0) return 0.0f;
    return std::bit_cast<float>(sign | static_cast<std::uint32_t>(exponent) << 23 |
                                static_cast<std::uint32_t>(mantissa));
}

}  // namespace nv20
}  // namespace strict
}  // namespace strata::rasterizer
