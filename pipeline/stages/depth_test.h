// pipeline/stages/depth_test.h - the depth test, on stored codes only.
//
// Rule     pass[i] = fragment code FUNC stored code. D16 and D24: unsigned integers. D32F: the codes are float bits and
//          are compared as floats, because a buffer cleared without clamping may contain negative values, values above
//          1 and NaN (which passes only `notequal` and `always`); -0 equals +0. Test off: every fragment passes and no
//          depth is written. The version that reads and writes a plane directly is test_depth of lane_words.h.
// Source   pipeline/reference/fragment-stages.md 6 (D3D 11.3 17.11; GL 2.1 4.1.6; NV_depth_buffer_float); integer
//          compare measured, chip-fragment.md 4.
// Tests    tests/pipeline/stages/depth_test_test.cpp, tests/pipeline/stages/simd_stages_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "pipeline/device/compare.h"
#include "pipeline/formats/format.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {
inline namespace strict {

// Writes ~0 or 0 to `count` lanes of pass.
inline void depth_test(const DepthTest& state, DepthFormat format, const std::uint32_t* code,
                       const std::uint32_t* stored, std::uint32_t* pass, int count) noexcept {
    with_compare(state.enabled ? state.func : CompareFunc::always, [&](auto func) {
        if (format == DepthFormat::d32f) {
            for (int i = 0; i < count; ++i)
                pass[i] = mask(passes<func()>(std::bit_cast<float>(code[i]), std::bit_cast<float>(stored[i])));
        } else {
            for (int i = 0; i < count; ++i) pass[i] = mask(passes<func()>(code[i], stored[i]));
        }
    });
}

// stored[i] = code[i] where written[i] is ~0. Call it for the lanes that passed stencil and depth test, only if the
// state writes depth.
inline void write_depth(const std::uint32_t* code, const std::uint32_t* written, std::uint32_t* stored,
                        int count) noexcept {
    for (int i = 0; i < count; ++i) stored[i] = select(written[i], code[i], stored[i]);
}

// A disabled test writes nothing, whatever `write` says (GL 2.1 4.1.6).
[[nodiscard]] constexpr bool writes_depth(const DepthTest& state) noexcept { return state.enabled && state.write; }

}  // namespace strict
}  // namespace strata::pipeline
