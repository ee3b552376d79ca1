// pipeline/stages/blend_float.h - blending on fp16 and binary32 targets: binary32 arithmetic without clamps.
//
// Rule     Stored halves are widened exactly. Each product is rounded to nearest even, then their sum or difference; 1
//          - x is one more rounding. A factor of 0 or 1 is multiplied like any other: NaN, infinity times 0 and signed
//          zeros propagate, and every NaN result is 0x7fffffff. DenormalRule::flush: operands and results below 2^-126
//          become zero of their sign. MIN and MAX: one NaN gives the other operand (or NaN, depending on the profile),
//          two give 0x7fffffff; max(-0,+0) = +0, min = -0; MinMaxNan::destination: d unless s is less, or greater.
//          SRC_ALPHA_SATURATE is the MIN of As and 1 - Ad.
// Source   pipeline/reference/fragment-stages.md 9.1 and 9.3 (D3D 11.3 17.5, 22.10.10; envytools fp32_minmax); the
//          order of roundings is assumed.
// Tests    tests/pipeline/stages/blend_float_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "pipeline/formats/lane_mask.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {
inline namespace strict {

// The NaN of G80's arithmetic (rasterizer/reference/numbers.md 5.1): quiet, with positive sign and all other bits set.
inline constexpr std::uint32_t canonical_nan = 0x7fffffff;

[[nodiscard]] constexpr bool is_nan_bits(std::uint32_t bits) noexcept { return (bits & 0x7fffffffu) > 0x7f800000u; }

// x, or the zero of its sign if its exponent field is 0.
template <DenormalRule rule>
[[nodiscard]] constexpr float flushed(float x) noexcept {
    if constexpr (rule == DenormalRule::keep) return x;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(bits & (0x80000000u | mask((bits & 0x7f800000u) != 0)));
}

// x, or canonical_nan for any NaN: the payload of an operation's NaN differs between processors.
[[nodiscard]] constexpr float canonical(float x) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(select(mask(is_nan_bits(bits)), canonical_nan, bits));
}

// MIN or MAX of flushed operands. A comparison with NaN is false.
template <BlendEquation equation, MinMaxNan rule>
[[nodiscard]] constexpr float extreme(float a, float b) noexcept {
    const auto a_bits = std::bit_cast<std::uint32_t>(a), b_bits = std::bit_cast<std::uint32_t>(b);
    const std::uint32_t takes_a = mask(equation == BlendEquation::min ? a < b : a > b), are_equal = mask(a == b);
    if (rule == MinMaxNan::destination) return canonical(std::bit_cast<float>(select(takes_a, a_bits, b_bits)));
    const std::uint32_t drops_b = rule == MinMaxNan::other_operand ? mask(is_nan_bits(b_bits)) : 0;
    std::uint32_t result = select(takes_a | drops_b, a_bits, b_bits);
    // Equal operands can differ only in the sign of a zero: MAX is negative if both are, MIN if one is.
    result = equation == BlendEquation::min ? result | (a_bits & are_equal) : result & (a_bits | ~are_equal);
    if (rule == MinMaxNan::propagate) result |= mask(is_nan_bits(a_bits)) & canonical_nan;
    // The result is a NaN if both operands are, or if one propagates.
    return canonical(std::bit_cast<float>(result));
}

// The binary32 arithmetic for blend_kernels.h: zero and one, 1 - x, the lesser of two, and one blend equation. Operands
// must already be flushed.
template <DenormalRule denormals, MinMaxNan nan_rule>
struct FloatArithmetic {
    static constexpr float zero = 0.0f, one = 1.0f;

    [[nodiscard]] static constexpr float one_minus(float x) noexcept { return flushed<denormals>(1.0f - x); }
    [[nodiscard]] static constexpr float lesser(float a, float b) noexcept {
        return extreme<BlendEquation::min, nan_rule>(a, b);
    }

    // Operands are already flushed, so a product with 1 leaves them unchanged. keeps_s: F is 1; keeps_d: G is 1.
    template <BlendEquation equation, bool keeps_s = false, bool keeps_d = false>
    [[nodiscard]] static constexpr float combine(float s, float F, float d, float G) noexcept {
        if constexpr (equation == BlendEquation::min || equation == BlendEquation::max)
            return extreme<equation, nan_rule>(s, d);
        if constexpr (equation == BlendEquation::signed_add || equation == BlendEquation::signed_reverse_subtract)
            // Signed equations exist only for 8-bit targets (fragment-stages.md 8.3).
            return d;
        const float source = keeps_s ? s : flushed<denormals>(s * F);
        const float destination = keeps_d ? d : flushed<denormals>(d * G);
        float sum = 0;
        if constexpr (equation == BlendEquation::add) sum = source + destination;
        if constexpr (equation == BlendEquation::subtract) sum = source - destination;
        if constexpr (equation == BlendEquation::reverse_subtract) sum = destination - source;
        return canonical(flushed<denormals>(sum));
    }
};

}  // namespace strict
}  // namespace strata::pipeline
