// rasterizer/values/depth/program_depth.h - depths that a fragment program computes and writes: the logarithm of w, and
// z after a way through the four bytes of RGBA8.
//
// Rule     logarithmic: f32(log2(v) C), v the perspective attribute f32(1 + w), C = f32(1 / log2(1 + w of the far
//          plane)) (RasterState::log_scale). packed_rgba8: the value that unpack_depth reads from the bytes of
//          pack_depth. log2_of gives log2 by the operations below, each rounded to binary64: v = m 2^e with m from
//          sqrt(1/2) to sqrt(2), t = (m - 1) / (m + 1), log2 v = e + 2 log2(e) (t + t^3/3 + ... + t^23/23).
// Source   rasterizer/reference/depth.md 4.9 and 4.10 (Outerra, three.js).
// Tests    tests/rasterizer/values/program_depth_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

namespace strata::rasterizer {
inline namespace strict {

// 0 if v is not above 0. Within 2^-50 of the real logarithm or of its part after the integer, whichever is larger.
[[nodiscard]] constexpr double log2_of(double v) noexcept {
    if (!(v > 0.0)) return 0.0;
    constexpr double root_of_2 = 0x1.6a09e667f3bcdp0, twice_log2_e = 0x1.71547652b82fep1;
    constexpr std::uint64_t mantissa = (std::uint64_t{1} << 52) - 1, exponent_0 = std::uint64_t{1023} << 52;
    const auto bits = std::bit_cast<std::uint64_t>(v);
    int exponent = static_cast<int>(bits >> 52) - 1023;
    double m = std::bit_cast<double>((bits & mantissa) | exponent_0);
    if (m > root_of_2) {
        m *= 0.5;
        ++exponent;
    }
    const double t = (m - 1.0) / (m + 1.0), square = t * t;
    double sum = 0.0;
    for (int k = 23; k > 0; k -= 2) {
        const double scaled = sum * square;
        sum = scaled + 1.0 / k;
    }
    const double product = t * sum;
    const double fraction = product * twice_log2_e;
    return exponent + fraction;
}

// C; 0 if there is no such far plane.
[[nodiscard]] constexpr float log_scale_of(double far_w) noexcept {
    const bool is_finite = 1.0 + far_w > 1.0 && far_w < 0x1p127;
    return is_finite ? static_cast<float>(1.0 / log2_of(1.0 + far_w)) : 0.0f;
}

[[nodiscard]] constexpr float logarithmic_depth(float v, float scale) noexcept {
    const auto logarithm = static_cast<float>(log2_of(double{v}));
    return logarithm * scale;
}

// The bytes that RGBA8 stores for packDepthToRGBA(z): three digits of z in base 256, then the rest of 2^24 z in units
// of 1 / 255, rounded. All are 0 for z not above 0, and 255 from 1.
[[nodiscard]] constexpr std::array<std::uint8_t, 4> pack_depth(float z) noexcept {
    if (!(z > 0.0f)) return {0, 0, 0, 0};
    if (z >= 1.0f) return {255, 255, 255, 255};
    const float scaled = z * 0x1p24f;
    const auto whole = static_cast<std::uint32_t>(scaled);
    const double rest = double{scaled} - static_cast<double>(whole);
    const auto digit = [](std::uint32_t v) { return static_cast<std::uint8_t>(v & 255); };
    return {digit(whole >> 16), digit(whole >> 8), digit(whole), static_cast<std::uint8_t>(rest * 255.0 + 0.5)};
}

// unpackRGBAToDepth: byte / 255 times 255/256, 255/256^2, 255/256^3 and 1/256^3, summed from the first to the last,
// each operation rounded to binary32.
[[nodiscard]] constexpr float unpack_depth(const std::array<std::uint8_t, 4>& bytes) noexcept {
    constexpr float digit = 255.0f / 256.0f;
    constexpr std::array<float, 4> factors{digit, digit * 0x1p-8f, digit * 0x1p-16f, 0x1p-24f};
    float sum = 0.0f;
    for (std::size_t i = 0; i < 4; ++i) {
        const float texel = static_cast<float>(bytes[i]) / 255.0f;
        const float product = texel * factors[i];
        sum = sum + product;
    }
    return sum;
}

}  // namespace strict
}  // namespace strata::rasterizer
