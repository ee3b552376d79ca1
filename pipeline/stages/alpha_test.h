// pipeline/stages/alpha_test.h - the alpha test.
//
// Rule     eight_bit: round(255 alpha) FUNC round(255 ref), integers, both clamped. Otherwise alpha FUNC ref in
//          binary32 without clamping: a NaN alpha passes only `notequal` and `always`. With several targets the alpha
//          of colour 0 is tested.
// Source   pipeline/reference/fragment-stages.md 3 (GL 2.1 4.1.4; 8-bit integer compare measured on NV2A,
//          chip-fragment.md 2; binary32 for float targets: ARB_color_buffer_float).
// Tests    tests/pipeline/stages/alpha_test_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/device/compare.h"
#include "pipeline/device/profile.h"
#include "pipeline/formats/format.h"
#include "pipeline/formats/unorm8.h"

namespace strata::pipeline {

// True if the alpha test of this device compares 8-bit integers when colour target 0 has channels of `type`.
[[nodiscard]] constexpr bool is_eight_bit_alpha(AlphaTestPrecision precision, ChannelType type) noexcept {
    return precision == AlphaTestPrecision::unorm8 || type == ChannelType::unorm8;
}

// Clears alive[i] for lanes [0, count) where the test fails; a disabled test, or `always`, changes nothing.
void alpha_test(const AlphaTest& state, bool eight_bit, const float* alpha, std::uint32_t* alive, int count) noexcept;

// The definition; alpha_test is the same loop compiled for the selected instruction set (stages_simd.cpp).
inline namespace strict {
namespace scalar {
inline void alpha_test(const AlphaTest& state, bool eight_bit, const float* __restrict alpha,
                       std::uint32_t* __restrict alive, int count) noexcept {
    if (!state.enabled || state.func == CompareFunc::always) return;
    const int ref_code = to_unorm8(state.ref);
    const float ref = state.ref;
    with_compare(state.func, [&](auto func) {
        if (eight_bit) {
            for (int i = 0; i < count; ++i) alive[i] &= mask(passes<func()>(int{to_unorm8(alpha[i])}, ref_code));
        } else {
            for (int i = 0; i < count; ++i) alive[i] &= mask(passes<func()>(alpha[i], ref));
        }
    });
}
}  // namespace scalar
}  // namespace strict

}  // namespace strata::pipeline
