// rasterizer/base/nv20_arithmetic.h - binary32 as the vertex engine of NV20 (GeForce3) computes it.
//
// Rule     Denormals read and written are +0. Product: cut toward zero; 0 times anything is +0. Sum of up to four:
//          every addend is cut toward zero to a multiple of 2^(e - 28), e the largest exponent among them (two places
//          above it for carries, 7 below a result's last bit), added once, the sum cut toward zero. Reciprocal: seed
//          s = round(8192 / (64.5 + i)), i the 6 leading fraction bits, then two Newton steps on integers, each cut; a
//          power of two is exact.
// Source   numbers.md 4: NV_vertex_program 2.14.1.11 [S], envytools' model checked against hardware [M]. Results
//          beyond the largest number become that number [A].
// Numbers  The mantissa m has 24 bits: s m < 2^31, ((2^37 - s' m) s') < 2^51. The second step ends within 2^-22 of 1/d.
// Tests    tests/rasterizer/base/nv20_arithmetic_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::rasterizer {
inline namespace strict {

// v, exact in binary64, cut toward zero to binary32; beyond the largest finite number, that number.
[[nodiscard]] constexpr float cut_to_binary32(double v) noexcept {
    const auto f = static_cast<float>(v);
    const double size = v < 0.0 ? -v : v, rounded = f < 0.0f ? -double{f} : double{f};
    return rounded > size ? std::bit_cast<float>(std::bit_cast<std::uint32_t>(f) - 1) : f;
}

namespace nv20 {

[[nodiscard]] constexpr bool is_finite(float v) noexcept {
    return (std::bit_cast<std::uint32_t>(v) & 0x7f800000u) != 0x7f800000u;
}

// +0 for zeros and denormals of either sign: their exponent field is 0.
[[nodiscard]] constexpr float flushed(float v) noexcept {
    return (std::bit_cast<std::uint32_t>(v) & 0x7f800000u) == 0 ? 0.0f : v;
}

// a b; +0 if a factor is zero or denormal, even beside an infinity or a NaN (numbers.md 4.2).
[[nodiscard]] constexpr float multiply(float a, float b) noexcept {
    if (flushed(a) == 0.0f || flushed(b) == 0.0f) return 0.0f;
    return is_finite(a) && is_finite(b) ? flushed(cut_to_binary32(double{a} * double{b})) : a * b;
}

// Two to four addends in one aligned add, as a dot product has them
// (numbers.md 4.3). If one is not finite, the plain IEEE sum from the left.
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
    // The cut addends in units of 2^(largest - 127 - 28). Each is below 2^29, so four of them stay below 2^31.
    std::int64_t total = 0;
    for (const float v : addends) {
        const auto bits = std::bit_cast<std::uint32_t>(v);
        const auto exponent = static_cast<int>(bits >> 23 & 0xff);
        if (exponent == 0) continue;
        const std::int64_t mantissa = std::int64_t{(bits & 0x7fffffu) | 0x800000u} << 5;
        const std::int64_t aligned = mantissa >> std::min(largest - exponent, 63);
        total += bits >> 31 != 0 ? -aligned : aligned;
    }
    // 31 bits are exact in binary64, and so is the scaling: 2^-154 at the least.
    const double unit = std::bit_cast<double>(static_cast<std::uint64_t>(largest - 127 - 28 + 1023) << 52);
    return flushed(cut_to_binary32(static_cast<double>(total) * unit));
}

// 1 / d (numbers.md 4.4). A zero or denormal d gives an infinity of its sign, an infinity gives +0, NaN stays, and a
// result that would be denormal is +0.
[[nodiscard]] constexpr float reciprocal(float d) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(d);
    const std::uint32_t fraction = bits & 0x7fffffu, field = bits >> 23 & 0xff, sign = bits & 0x80000000u;
    if (field == 0) return std::bit_cast<float>(sign | 0x7f800000u);
    if (!is_finite(d)) return fraction != 0 ? d : 0.0f;
    std::uint64_t mantissa = 0;
    // A power of two only turns its exponent about the bias, 254 = 2 * 127; every other mantissa takes one more off.
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
