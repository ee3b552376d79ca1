// pipeline/stages/stencil_lanes.h - the loops of stencil.h, compiled once per instruction set. Included only by
// stages_simd.cpp.
#pragma once
#include <algorithm>
#include <type_traits>

#include "pipeline/device/compare.h"
#include "pipeline/stages/stencil.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {
inline namespace strict {
namespace scalar {

using Mask = rasterizer::Lanes<std::uint32_t>;

// Calls body with the operation as a constant; not called for `keep`, which changes nothing.
template <class Body>
void with_op(StencilOp op, Body&& body) {
    using enum StencilOp;
    switch (op) {
        case keep: return;  // changes nothing
        case zero: return body(std::integral_constant<StencilOp, zero>{});
        case replace: return body(std::integral_constant<StencilOp, replace>{});
        case incr: return body(std::integral_constant<StencilOp, incr>{});
        case decr: return body(std::integral_constant<StencilOp, decr>{});
        case invert: return body(std::integral_constant<StencilOp, invert>{});
        case incr_wrap: return body(std::integral_constant<StencilOp, incr_wrap>{});
        case decr_wrap: return body(std::integral_constant<StencilOp, decr_wrap>{});
    }
}

// Applies `op` to the lanes in `chosen`; a lane is chosen for at most one of the three outcomes.
inline void update(const StencilFace& face, StencilOp op, const Mask& chosen, const StencilLanes& lanes) noexcept {
    const std::uint32_t ref = face.ref, write_mask = face.write_mask;
    const auto count = static_cast<std::size_t>(lanes.count);
    std::uint32_t* const stored = lanes.stored;
    with_op(op, [&](auto chosen_op) {
        for (std::size_t i = 0; i < count; ++i)
            stored[i] = select(write_mask & chosen[i], apply<chosen_op()>(stored[i], ref), stored[i]);
    });
}

// Reads the stored values before `update` changes them: 255 before INCR, 0 before DECR.
inline void mark_saturated(StencilOp op, const Mask& chosen, const StencilLanes& lanes) noexcept {
    if (lanes.saturated == nullptr || (op != StencilOp::incr && op != StencilOp::decr)) return;
    const std::uint32_t limit = op == StencilOp::incr ? 255 : 0;
    const auto count = static_cast<std::size_t>(lanes.count);
    for (std::size_t i = 0; i < count; ++i) lanes.saturated[i] |= chosen[i] & mask(lanes.stored[i] == limit);
}

inline void finish(const StencilFace& face, StencilOp op, const Mask& chosen, const StencilLanes& lanes) noexcept {
    mark_saturated(op, chosen, lanes);
    update(face, op, chosen, lanes);
}

// Tests one face for the lanes in `subject`; adds the lanes that pass stencil and depth to `survivors`. Returns the
// number that fails.
inline int test_face(const StencilFace& face, const Mask& subject, const StencilLanes& lanes,
                     Mask& survivors) noexcept {
    const auto count = static_cast<std::size_t>(lanes.count);
    const std::uint32_t* const depth_pass = lanes.depth_pass;
    Mask passed, fail, depth_fail, pass;
    const std::uint32_t ref = face.ref & face.func_mask, func_mask = face.func_mask;
    with_compare(face.func, [&](auto func) {
        for (std::size_t i = 0; i < count; ++i) passed[i] = mask(passes<func()>(ref, lanes.stored[i] & func_mask));
    });
    std::uint32_t failed = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t stencil_passed = subject[i] & passed[i];
        fail[i] = subject[i] & ~passed[i];
        depth_fail[i] = stencil_passed & ~depth_pass[i];
        pass[i] = stencil_passed & depth_pass[i];
        survivors[i] |= pass[i];
        failed += fail[i] & 1u;
    }
    finish(face, face.fail, fail, lanes);
    finish(face, face.depth_fail, depth_fail, lanes);
    finish(face, face.pass, pass, lanes);
    return static_cast<int>(failed);
}

// With the test off the stencil buffer is unchanged. The two faces have disjoint lanes, so their order does not matter.
inline int stencil_test(const StencilTest& state, const StencilLanes& lanes) noexcept {
    const auto count = static_cast<std::size_t>(lanes.count);
    if (lanes.saturated != nullptr) std::fill_n(lanes.saturated, count, 0u);
    if (!state.enabled) {
        for (std::size_t i = 0; i < count; ++i) lanes.alive[i] &= lanes.depth_pass[i];
        return 0;
    }
    Mask front{}, back{}, survivors{};
    int failed = 0;
    if (state.two_sided) {
        for (std::size_t i = 0; i < count; ++i) front[i] = lanes.alive[i] & mask(lanes.front_facing[i] != 0);
        for (std::size_t i = 0; i < count; ++i) back[i] = lanes.alive[i] & ~front[i];
        failed = test_face(state.front, front, lanes, survivors);
        failed += test_face(state.back, back, lanes, survivors);
    } else {
        std::copy_n(lanes.alive, count, front.begin());
        failed = test_face(state.front, front, lanes, survivors);
    }
    std::copy_n(survivors.begin(), count, lanes.alive);
    return failed;
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::pipeline
