// pipeline/lighting/float22.h - the 22-bit floats of NV2A's lighting unit, which computes vertex lighting, fog and
// point sizes of the fixed pipeline; and the reciprocal root of its 32-bit unit.
//
// Rule     A number is a binary32 whose 10 lowest bits are 0: 14 significant bits. Products and sums are cut toward
//          zero. Before a sum every term is cut to `extra` bits below the last bit of the largest. Denormals are 0; 0
//          times anything but NaN is 0; infinity times anything else is +infinity, and so is a sum with an infinity;
//          NaN wins; what is too large becomes the largest finite number.
// Source   pipeline/reference/fog-and-lighting.md 3, from captures; the structure is that of envytools' model of NV10.
// Numbers  A product has 28 bits and a term of a sum at most 19, so that binary64 and int64 are exact.
// Tests    tests/pipeline/vertices/float22_test.cpp, against rationals
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "rasterizer/chip/truncated_weights.h"

namespace strata::pipeline::float22 {
inline namespace strict {

inline constexpr int bits = 14;  // of a mantissa
inline constexpr int extra = 5;  // bits kept below the last bit of the largest term of a sum
inline constexpr float largest = 0x1.fff8p127f, infinity = std::numeric_limits<float>::infinity(),
                       not_a_number = std::numeric_limits<float>::quiet_NaN();

[[nodiscard]] constexpr bool is_nan(float v) noexcept { return v != v; }
[[nodiscard]] constexpr bool is_finite(float v) noexcept { return v - v == 0.0f; }

// A binary32 as a 22-bit float: to nearest, a half away from zero; but not up where the eight lowest kept bits are
// ones.
[[nodiscard]] constexpr float rounded(float v) noexcept {
    const auto word = std::bit_cast<std::uint32_t>(v);
    if (is_nan(v)) return not_a_number;
    if (!is_finite(v)) return v;
    if ((word & 0x7f800000u) == 0) return 0.0f;
    const std::uint32_t half = (word & 0x3ffffu) < 0x3fe00u ? 0x200u : 0u;
    return std::bit_cast<float>((word + half) & ~0x3ffu);
}

// The exact result of an operation, cut to a 22-bit float.
[[nodiscard]] constexpr float cut(double v) noexcept {
    const double size = v < 0.0 ? -v : v;
    if (size < 0x1p-126) return 0.0f;
    if (size > largest) return v < 0.0 ? -largest : largest;
    return static_cast<float>(rasterizer::truncate_bits(v, bits));
}

[[nodiscard]] constexpr float mul(float a, float b) noexcept {
    if (is_nan(a) || is_nan(b)) return not_a_number;
    if (a == 0.0f || b == 0.0f) return 0.0f;
    if (!is_finite(a) || !is_finite(b)) return infinity;
    return cut(double{a} * double{b});
}

// The sum of terms, each cut to `below` bits below the last of the largest one's 14.
template <std::size_t n>
[[nodiscard]] constexpr float cut_sum(const std::array<double, n>& terms, int below) noexcept {
    for (const double each : terms)
        if (each != each) return not_a_number;
    for (const double each : terms)
        if (!(each - each == 0.0)) return infinity;
    int largest_exponent = -1023;
    for (const double each : terms) largest_exponent = std::max(largest_exponent, rasterizer::exponent_of(each));
    if (largest_exponent == -1023) return 0.0f;
    const int last = largest_exponent - (bits - 1) - below;
    std::int64_t total = 0;
    for (const double each : terms) total += static_cast<std::int64_t>(each * rasterizer::power_of_two(-last));
    return cut(static_cast<double>(total) * rasterizer::power_of_two(last));
}

template <std::size_t n>
[[nodiscard]] constexpr float sum(const std::array<float, n>& terms, int below = extra) noexcept {
    std::array<double, n> exact{};
    for (std::size_t i = 0; i < n; ++i) exact[i] = double{terms[i]};
    return cut_sum(exact, below);
}
[[nodiscard]] constexpr float add(float a, float b) noexcept { return sum<2>({a, b}); }
// The adder of scalars, which keeps no bits below.
[[nodiscard]] constexpr float sadd(float a, float b) noexcept { return sum<2>({a, b}, 0); }

// Products are cut before they are added.
[[nodiscard]] constexpr float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) noexcept {
    return sum<3>({mul(a[0], b[0]), mul(a[1], b[1]), mul(a[2], b[2])});
}

// The greatest s with s s d <= n.
[[nodiscard]] constexpr std::uint64_t floor_root(std::uint64_t n, std::uint64_t d) noexcept {
    std::uint64_t s = 0;
    while ((s + 1) * (s + 1) * d <= n) ++s;
    return s;
}

// The six leading fraction bits of x, and its exponent.
struct TableEntry {
    std::uint64_t index;
    int exponent;
    [[nodiscard]] constexpr bool is_odd() const noexcept { return (exponent & 1) != 0; }
    [[nodiscard]] constexpr int half() const noexcept { return exponent >> 1; }  // rounded down
};
[[nodiscard]] constexpr TableEntry entry_of(float x) noexcept {
    const auto word = std::bit_cast<std::uint32_t>(x);
    return {word >> 17 & 63, static_cast<int>(word >> 23 & 255) - 127};
}

// floor(128 / sqrt(M)), for an odd exponent floor(128 / sqrt(2 M)), with M = 1 + (index + 1/2) / 64.
[[nodiscard]] constexpr std::uint64_t root_seed(const TableEntry& x) noexcept {
    return floor_root(std::uint64_t{1} << (x.is_odd() ? 20 : 21), 129 + 2 * x.index);
}

// 1 / sqrt(x), from the table alone.
[[nodiscard]] constexpr float rsq(float x) noexcept {
    if (is_nan(x)) return not_a_number;
    if (!(x > 0.0f)) return infinity;
    if (!is_finite(x)) return 0.0f;
    const TableEntry at = entry_of(x);
    return static_cast<float>(static_cast<double>(root_seed(at)) * rasterizer::power_of_two(-at.half() - 7));
}

// 1 / x: floor(128 / M), and one step of Newton's method.
[[nodiscard]] constexpr float rcp(float x) noexcept {
    if (is_nan(x)) return not_a_number;
    if (x == 0.0f) return infinity;
    if (!is_finite(x)) return 0.0f;
    const auto [index, exponent] = entry_of(x);
    const std::uint64_t seed = 16384 / (129 + 2 * index);
    const std::uint64_t n = ((std::bit_cast<std::uint32_t>(x) & 0x7fffffu) | 0x800000u) >> 10;
    const std::uint64_t s = (((std::uint64_t{1} << 21) - seed * n) * seed) >> 14;
    const double size = static_cast<double>(s) * rasterizer::power_of_two(-exponent - 13);
    return cut(x < 0.0f ? -size : size);
}

// 1 / sqrt(x) of the 32-bit unit, for distances and directions: the same table, and two steps of Newton's method.
[[nodiscard]] constexpr float wide_rsq(float x) noexcept {
    if (is_nan(x)) return not_a_number;
    if (!(x > 0.0f)) return infinity;
    if (!is_finite(x)) return 0.0f;
    const TableEntry at = entry_of(x);
    const std::uint64_t f = ((std::bit_cast<std::uint32_t>(x) & 0x7fffffu) | 0x800000u) << (at.is_odd() ? 1 : 0);
    const std::uint64_t s0 = root_seed(at);
    const std::uint64_t s1 = (((std::uint64_t{3} << 37) - s0 * s0 * f) * s0) >> 32;
    const std::uint64_t s2 = (((std::uint64_t{3} << 49) - s1 * s1 * f) * s1) >> 39;
    return static_cast<float>(static_cast<double>(s2) * rasterizer::power_of_two(-at.half() - 24));
}

// A colour as a byte.
[[nodiscard]] constexpr std::uint8_t to_byte(float v) noexcept {
    if (!(v > 0.0f)) return 0;
    return v >= 1.0f ? 255 : static_cast<std::uint8_t>(double{v} * 255.0 + 0.5);
}

}  // namespace strict
}  // namespace strata::pipeline::float22
