// pipeline/lighting/fog_unit.h - the fog of NV2A: what a vertex contributes, and a pixel's factor.
//
// Rule     Linear functions interpolate the coordinate x, rounded to 22 bits; exponential ones v = bias + multiplier x
//          in the lighting unit's 22-bit floats. A pixel's factor is 8 bits: linear functions cut (bias + multiplier x
//          - 1) to 12 bits; exponential ones interpolate a table of 33 bytes at |v - 3/2|, of which 1/2 is eight
//          octaves. 255 is no fog. The factor is the alpha of the combiners' fog register.
// Source   pipeline/reference/fog-and-lighting.md 2, from captures.
// Tests    tests/pipeline/vertices/fog_unit_test.cpp; tests/tools/lab/hardware_check/suites_test.cpp: captures
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/lighting/float22.h"
#include "rasterizer/base/vector.h"

namespace strata::pipeline {

// The `_abs` functions take the absolute value of what is interpolated; exp2 differs from exp2_abs only in name.
enum class FogFunction : std::uint8_t { linear, linear_abs, exp, exp_abs, exp2, exp2_abs };

struct FogRegisters {
    FogFunction function = FogFunction::linear;
    float bias = 1.0f, multiplier = 0.0f;
    Rgba color{};  // its alpha is not used
    friend bool operator==(const FogRegisters&, const FogRegisters&) = default;
};

[[nodiscard]] constexpr bool is_linear(FogFunction f) noexcept {
    return f == FogFunction::linear || f == FogFunction::linear_abs;
}

// The value of a vertex that is interpolated, from its fog coordinate.
[[nodiscard]] constexpr float vertex_fog(const FogRegisters& fog, float coordinate) noexcept {
    const float x = float22::rounded(coordinate);
    if (is_linear(fog.function)) return x;
    // The third term is that of the square of x, whose factor is 0.
    return float22::dot({float22::rounded(fog.bias), float22::rounded(fog.multiplier), 0.0f}, {1.0f, x, 0.0f});
}

namespace fog_table {
// round(255 2^(-k/4)), and round(255 2^(-8 (k/32)^2)).
inline constexpr std::array<std::int32_t, 33> exp{255, 214, 180, 152, 128, 107, 90, 76, 64, 54, 45,
                                                  38,  32,  27,  23,  19,  16,  13, 11, 9,  8,  7,
                                                  6,   5,   4,   3,   3,   2,   2,  2,  1,  1,  1};
inline constexpr std::array<std::int32_t, 33> exp2{255, 254, 250, 243, 234, 223, 210, 196, 180, 164, 148,
                                                   132, 117, 102, 88,  75,  64,  53,  44,  36,  29,  23,
                                                   19,  15,  11,  9,   7,   5,   4,   3,   2,   1,   1};
}  // namespace fog_table

[[nodiscard]] constexpr std::int32_t linear_fog(const FogRegisters& fog, float x) noexcept {
    if (!float22::is_finite(x)) return 255;
    const float size = fog.function == FogFunction::linear_abs && x < 0.0f ? -x : x;
    // In binary64: the product is exact, and a sum may be rounded (fog-and-lighting.md 2.3).
    const double f = (double{fog.bias} + double{fog.multiplier} * double{size} - 1.0) * 4096.0;
    if (!(f >= 0.0)) return 0;
    const auto code = f >= 4096.0 ? 4096 : static_cast<std::int32_t>(f);
    return (code - (code >> 8)) >> 4;
}

[[nodiscard]] constexpr std::int32_t exponential_fog(FogFunction function, float v) noexcept {
    const bool is_exp = function == FogFunction::exp;
    if (float22::is_nan(v) || v == float22::infinity) return is_exp ? 255 : 0;
    // 2^8 steps an octave, from 3/2 on. floor() of the product, negated.
    const double steps = (double{v} - 1.5) * 4096.0;
    if (steps <= -2048.0) return 0;
    if (steps >= 2048.0) return is_exp ? 255 : 0;
    const auto towards_zero = static_cast<std::int32_t>(steps);
    std::int32_t p = -(towards_zero - (static_cast<double>(towards_zero) > steps ? 1 : 0));
    if (is_exp && p <= 0) return 255;
    p = p < 0 ? -p : p;
    if (p >= 2048) return 0;
    const bool is_square = function == FogFunction::exp2 || function == FogFunction::exp2_abs;
    const auto& table = is_square ? fog_table::exp2 : fog_table::exp;
    const auto k = static_cast<std::size_t>(p >> 6);
    const std::int32_t r = p & 63;
    return (table[k] * (64 - r) + table[k + 1] * r + 32) >> 6;
}

// A pixel's factor, 0 to 255: the weight of its colour.
[[nodiscard]] constexpr std::int32_t fog_factor(const FogRegisters& fog, float value) noexcept {
    return is_linear(fog.function) ? linear_fog(fog, value) : exponential_fog(fog.function, value);
}

}  // namespace strata::pipeline
