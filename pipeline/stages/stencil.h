// pipeline/stages/stencil.h - the stencil test and the operations on an 8-bit stencil buffer.
//
// Rule     (ref & func_mask) FUNC (stored & func_mask), the reference on the left. If it fails, `fail` is applied and
//          the fragment is dropped. If it passes, the depth result selects `depth_fail` (dropped) or `pass`; a disabled
//          depth test counts as passed. INCR and DECR saturate; REPLACE writes the whole reference; write_mask affects
//          only the update.
// Source   pipeline/reference/fragment-stages.md 5 (GL 2.1 4.1.5; EXT_stencil_two_side; EXT_stencil_wrap); measured,
//          chip-fragment.md 4.
// Tests    tests/pipeline/stages/stencil_test.cpp, tests/pipeline/stages/simd_stages_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/device/state.h"

namespace strata::pipeline {

// The new value by `op`, before the write mask is applied. s and ref are in 0..255.
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

// Lanes of a batch; masks are 0 or ~0. Only a two-sided test reads `front_facing`; otherwise it may be null.
struct StencilLanes {
    const std::uint8_t* front_facing = nullptr;
    // The masks of the depth test, ~0 or 0 per lane.
    const std::uint32_t* depth_pass = nullptr;
    // Input: the lanes to test. Output: those that passed stencil and depth.
    std::uint32_t* alive = nullptr;
    // The stored values, updated; dead input lanes keep theirs.
    std::uint32_t* stored = nullptr;
    // Output unless null: ~0 where INCR or DECR reached its limit, else 0.
    std::uint32_t* saturated = nullptr;
    int count = 0;
};

// Applies stencil and depth results together, because the first failure decides the operation. With the test off, only
// the depth result is applied. Returns the number of fragments that the stencil comparison dropped.
int stencil_test(const StencilTest& state, const StencilLanes& lanes) noexcept;

}  // namespace strata::pipeline
