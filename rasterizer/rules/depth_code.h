// rasterizer/rules/depth_code.h - window depth to its stored code. Depth is compared on stored codes only.
//
// Rule     D16, D24: clamp to [0,1], scale by 2^n - 1, round by the profile's rule (a half goes up); NaN is 0.
//          D32F: the float itself, clamped to [0,1] and -0 made +0; so the codes of one format order like unsigned
//          integers. D16F: depth 1 is its greatest value, 511.9375; the float cut to 12 bits of mantissa, an exponent
//          field of 0 flushed to 0, whatever the rule.
// Source   depth.md 2 (D3D 11.3 17.10-17.11, GL 2.1 2.11.1, ARB_depth_buffer_float); floor is GeForce3's. D16F:
//          chip-float-depth.md 3.2: 4,187,584 words of captures, 99.72 % equal and the rest one unit off.
// Numbers  Scaling in binary64: 24 by 24 bits are exact, while binary32 has no half left above z = 0.5.
// Tests    tests/rasterizer/rules/depth_code_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "rasterizer/base/numerics.h"

namespace strata::rasterizer {

// d16f: 4 bits of exponent, 12 of mantissa, no sign; values below its smallest normal one are 0.
enum class DepthFormat : std::uint8_t { d16, d24, d32f, d16f };
enum class DepthRounding : std::uint8_t { floor, nearest };

inline namespace strict {

// The code of depth 1.0: 2^n - 1, or the bits of 1.0f.
[[nodiscard]] constexpr std::uint32_t max_code(DepthFormat format) noexcept {
    switch (format) {
        case DepthFormat::d16: return 0xffffu;
        case DepthFormat::d24: return 0xffffffu;
        case DepthFormat::d32f: return std::bit_cast<std::uint32_t>(1.0f);
        case DepthFormat::d16f: return 0xffffu;
    }
    return 0;  // unreachable: the enum is closed
}

inline constexpr float max_d16f = 511.9375f;

// D16F's own values, [0, 511.9375]: code = bits >> 11, less the code of 2^-7.
[[nodiscard]] constexpr std::uint32_t to_d16f_code(float value) noexcept {
    if (!(value > 0.0f)) return 0;  // negative, -0 and NaN
    if (value >= max_d16f) return 0xffffu;
    constexpr std::uint32_t least = 0x3c000000u, least_normal = 0x1000;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t code = bits < least ? 0 : (bits - least) >> 11;
    return code < least_normal ? 0 : code;
}
[[nodiscard]] constexpr float d16f_value(std::uint32_t code) noexcept {
    return code == 0 ? 0.0f : std::bit_cast<float>((code << 11) + 0x3c000000u);
}

[[nodiscard]] constexpr std::uint32_t to_depth_code(float z, DepthFormat format, DepthRounding rounding) noexcept {
    if (!(z > 0.0f)) return 0;  // negative, -0 and NaN
    if (z >= 1.0f) return max_code(format);
    if (format == DepthFormat::d32f) return std::bit_cast<std::uint32_t>(z);
    if (format == DepthFormat::d16f) return to_d16f_code(z * max_d16f);
    const double scaled = double{z} * max_code(format);
    return static_cast<std::uint32_t>(scaled +
                                      (rounding == DepthRounding::nearest ? 0.5 : 0.0));  // >= 0: the cast floors
}

// k / (2^n - 1) rounded once to binary64, for pictures and reports; comparisons use codes.
[[nodiscard]] constexpr double depth_value(std::uint32_t code, DepthFormat format) noexcept {
    if (format == DepthFormat::d32f) return double{std::bit_cast<float>(code)};
    if (format == DepthFormat::d16f) return double{d16f_value(code)} / max_d16f;
    return static_cast<double>(code) / max_code(format);
}

}  // namespace strict
}  // namespace strata::rasterizer
