// pipeline/stages/blend_unorm8.h - blending on 8-bit normalized targets: integer arithmetic with one rounding.
//
// Rule     The source is converted to 8 bits first. With s, d and the factors F, G as codes (1 - x is 255 - x): t =
//          clamp(s F + d G, 0, 65025), then t / 255 rounded half up, or truncated, depending on the profile.
//          BlendRounding::each_product: s F and d G are rounded separately, each as (t + (t >> 8) + 128) >> 8, and
//          their sum is clamped. Signed equations: clamp(d +- s', 0, 255), where s' is the source code as two's
//          complement. BlendRounding::unrounded_source does not use codes: FloatArithmetic blends the clamped source
//          with the values of codes (blend_lanes.h).
// Source   pipeline/reference/fragment-stages.md 8; measured on NV2A: 1,673 of 1,673 captures (chip-fragment.md 1).
// Numbers  Products <= 65025, sums within +-130050. The kernels store these integers as binary32 values, which
//          represent all of them and every operation on them exactly: vector units multiply four floats at once, but
//          not four 32-bit integers.
// Tests    tests/pipeline/stages/blend_unorm8_test.cpp; tests/tools/lab/hardware_check/suites_test.cpp: 43 hardware
//          captures
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {
inline namespace strict {

// t / 255 for t in [0, 65025]; checked for every t. There are no ties, because 255 is odd.
template <BlendRounding rounding>
[[nodiscard]] constexpr std::int32_t over_255(std::int32_t t) noexcept {
    const std::int32_t biased = t + (rounding == BlendRounding::truncate ? 1 : 128);
    return (biased + (biased >> 8)) >> 8;
}

// Codes 0..255 as integers in binary32. `one` is 255, so products are in units of 1/255^2.
template <BlendRounding rounding>
struct Unorm8Arithmetic {
    static constexpr float zero = 0.0f, one = 255.0f;

    [[nodiscard]] static constexpr float one_minus(float x) noexcept { return 255.0f - x; }
    // Codes are not negative, so their float bits have the same order.
    [[nodiscard]] static constexpr float lesser(float a, float b) noexcept {
        return std::bit_cast<float>(std::min(std::bit_cast<std::int32_t>(a), std::bit_cast<std::int32_t>(b)));
    }
    [[nodiscard]] static constexpr float greater(float a, float b) noexcept {
        return std::bit_cast<float>(std::max(std::bit_cast<std::int32_t>(a), std::bit_cast<std::int32_t>(b)));
    }

    // The code as two's complement: 128..255 mean -128..-1.
    [[nodiscard]] static constexpr float signed_value(float code) noexcept {
        return code < 128.0f ? code : code - 256.0f;
    }
    [[nodiscard]] static constexpr float clamped(float v) noexcept { return v < 0.0f ? 0.0f : v > 255.0f ? 255.0f : v; }

    // a b / 255 by shifts: 24 of the 65,536 products are not the nearest code.
    [[nodiscard]] static constexpr float product(float a, float b) noexcept {
        const auto ab = static_cast<std::int32_t>(a * b);
        return static_cast<float>((ab + (ab >> 8) + 128) >> 8);
    }

    // keeps_s and keeps_d exist only for the interface: s * 255 is computed like any other product.
    template <BlendEquation equation, bool keeps_s = false, bool keeps_d = false>
    [[nodiscard]] static constexpr float combine(float s, float F, float d, float G) noexcept {
        if constexpr (equation == BlendEquation::min) return lesser(s, d);
        if constexpr (equation == BlendEquation::max) return greater(s, d);
        if constexpr (equation == BlendEquation::signed_add) return clamped(d + signed_value(s));
        if constexpr (equation == BlendEquation::signed_reverse_subtract) return clamped(d - signed_value(s));
        if constexpr (rounding == BlendRounding::each_product) {
            const float source = product(s, F), destination = product(d, G);
            if constexpr (equation == BlendEquation::add) return clamped(source + destination);
            if constexpr (equation == BlendEquation::subtract) return clamped(source - destination);
            if constexpr (equation == BlendEquation::reverse_subtract) return clamped(destination - source);
        }
        // In units of 1/255^2; within +-130050, so exact.
        float sum = 0;
        if constexpr (equation == BlendEquation::add) sum = s * F + d * G;
        if constexpr (equation == BlendEquation::subtract) sum = s * F - d * G;
        if constexpr (equation == BlendEquation::reverse_subtract) sum = d * G - s * F;
        return static_cast<float>(over_255<rounding>(std::min(std::max(static_cast<std::int32_t>(sum), 0), 65025)));
    }
};

// The arithmetic of codes of k / 65535, in which Mesa's llvmpipe blends rgb10_a2: as BlendRounding::each_product.
struct Unorm16Arithmetic {
    static constexpr float zero = 0.0f, one = 65535.0f;

    [[nodiscard]] static constexpr float one_minus(float x) noexcept { return one - x; }
    [[nodiscard]] static constexpr float lesser(float a, float b) noexcept { return a < b ? a : b; }
    // (a b + a b / 65536 + 1/2) / 65536: below 2^32.
    [[nodiscard]] static constexpr float product(float a, float b) noexcept {
        const std::uint32_t ab = static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b);
        return static_cast<float>((ab + (ab >> 16) + 32768u) >> 16);
    }

    template <BlendEquation equation, bool keeps_s = false, bool keeps_d = false>
    [[nodiscard]] static constexpr float combine(float s, float F, float d, float G) noexcept {
        if constexpr (equation == BlendEquation::min) return lesser(s, d);
        if constexpr (equation == BlendEquation::max) return s > d ? s : d;
        if constexpr (equation == BlendEquation::signed_add || equation == BlendEquation::signed_reverse_subtract)
            return d;
        const float source = product(s, F), destination = product(d, G);
        const float sum = equation == BlendEquation::add        ? source + destination
                          : equation == BlendEquation::subtract ? source - destination
                                                                : destination - source;
        return sum < 0.0f ? 0.0f : sum > one ? one : sum;
    }
};

}  // namespace strict
}  // namespace strata::pipeline
