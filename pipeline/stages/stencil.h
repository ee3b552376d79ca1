// pipeline/stages/stencil.h - the stencil test and the operations of an 8-bit stencil buffer.
//
// Rule     (ref & func_mask) FUNC (stored & func_mask), the reference on the left. Fails: `fail`, and the fragment
//          is dropped. Passes: the depth result chooses `depth_fail` (dropped) or `pass`; a depth test that is off
//          counts as passed. INCR and DECR saturate; REPLACE writes the whole reference; write_mask touches nothing
//          but the update.
// Source   fragment-stages.md 5 (GL 2.1 4.1.5; EXT_stencil_two_side; EXT_stencil_wrap); measured, chip-fragment.md 4.
// Tests    tests/pipeline/stages/stencil_test.cpp, tests/pipeline/stages/simd_stages_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/device/state.h"

namespace strata::pipeline {

// The value that `op` asks for, before the write mask. s and ref are in 0..255.
template <StencilOp op>
[[nodiscard]] constexpr std::uint32_t apply(std::uint32_t s, std::uint32_t ref) noexcept {
    if constexpr (op == StencilOp::zero) return 0;
    if constexpr (op == StencilOp::replace) return ref;
    if constexpr (op == StencilOp::incr) return s == 255 ? 255 : s + 1;
    if constexpr (op == StencilOp::decr) return s == 0 ? 0 : s - 1;
    if constexpr (op == StencilOp::invert) return ~s & 0xffu;
    if constexpr (op == StencilOp::incr_wrap) return (s + 1) & 0xffu;
    if constexpr (op == StencilOp::decr_wrap) return (s - 1) & 0xffu;
    return s;  // keep
}

// Lanes of a batch; masks are 0 or ~0. `front_facing` is read by a two-sided test alone and may be null otherwise.
struct StencilLanes {
    const std::uint8_t* front_facing = nullptr;
    // Masks from the depth test, ~0 or 0 a lane.
    const std::uint32_t* depth_pass = nullptr;
    // In: who arrives. Out: who passed stencil and depth.
    std::uint32_t* alive = nullptr;
    // The buffer's values, updated; lanes that arrive dead keep theirs.
    std::uint32_t* stored = nullptr;
    // Out, if given: ~0 where INCR or DECR met its limit, else 0.
    std::uint32_t* saturated = nullptr;
    int count = 0;
};

// Stencil and depth results together, because the order of their failures decides the operation. With the test off the
// depth result alone remains. Answers how many fragments the stencil comparison dropped.
int stencil_test(const StencilTest& state, const StencilLanes& lanes) noexcept;

}  // namespace strata::pipeline
