// pipeline/frame/effects.h - which effects a pass simulates: decided from its state and its materials before the first
// fragment.
//
// Rule     Needed is what the program declares, and what a stage that is switched on looks at. What materials call for
//          is decided by the tile's own triangles. `all` simulates everything: values that no stage reads, and where a
//          stage is off the stage with a state that changes nothing (alpha GEQUAL 0, stencil ALWAYS and KEEP, depth
//          ALWAYS without a write, blending ONE and ZERO); the bits and counters are the same. In a tile without opaque
//          triangles the test against the opaque depth is not made, and no depth interpolated for it, if every
//          triangle's bound (rasterizer/set_up/depth_bound.h) lies before the cleared 1.
// Source   execution.md 6.
// Tests    tests/peeling/execution_test.cpp, tests/pipeline/frame/effects_test.cpp
#pragma once
#include <cstdint>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/frame/instruments.h"
#include "pipeline/frame/pass.h"
#include "pipeline/vertices/prepare.h"

namespace strata::pipeline {

// The arrays of a fragment that a geometry pass over triangles of these materials must have computed.
[[nodiscard]] inline rasterizer::FragmentNeeds pass_needs(const PassState& state, const MaterialNeeds& materials,
                                                          Effects effects, DepthOutcome depth = DepthOutcome::open) {
    rasterizer::FragmentNeeds needs = state.needs;
    if (effects == Effects::all)
        return {true, true, needs.exact_code, true,
                true, true, needs.reference,  static_cast<rasterizer::UnitMask>(needs.units | materials.shadow)};
    needs.code |= needs.reference || (state.depth.enabled && depth == DepthOutcome::open) || state.depth_unit_count > 0;
    needs.facing |= state.stencil.enabled && state.stencil.two_sided;
    needs.color |= materials.color;
    needs.texcoord |= materials.texcoord && needs.color;
    if (needs.color) needs.units |= materials.shadow;
    return needs;
}

// `needs` with the value of a fragment that `effect` names added; unchanged if the effect is a stage and no value.
[[nodiscard]] inline rasterizer::FragmentNeeds with_value(rasterizer::FragmentNeeds needs, Effect effect) {
    needs.color |= effect == Effect::color;
    needs.texcoord |= effect == Effect::texcoord;
    needs.shader_z |= effect == Effect::shader_z;
    needs.code |= effect == Effect::code;
    needs.facing |= effect == Effect::facing;
    return needs;
}

// The tiles of a frame by what their pixels hold before any test, and the fragments by material.
struct TileCensus {
    std::uint64_t tiles = 0;
    std::uint64_t empty = 0;        // no fragment at all
    std::uint64_t opaque_only = 0;  // none of the transparent list: nothing to peel
    std::uint64_t single = 0;       // transparent fragments, but no pixel has two: nothing to order
    std::uint64_t layered = 0;      // the rest: these need peeling
    std::uint64_t with_opaque = 0;  // these need opaque priming
    std::vector<std::uint64_t> transparent_fragments, opaque_fragments;  // by material
    friend bool operator==(const TileCensus&, const TileCensus&) = default;
};
// Rasterizes every tile with these values and discards them: for timing.
void walk(const PreparedDraw& list, const rasterizer::DepthRequest& depth, const rasterizer::FragmentNeeds& needs,
          int threads);
// The fragments of the deepest pixel, before any test.
[[nodiscard]] std::uint32_t deepest_pixel(const PreparedDraw& list);
// The fragments of all pixels, before any test.
[[nodiscard]] std::uint64_t fragment_count(const PreparedDraw& list);
[[nodiscard]] TileCensus count_tiles(const PreparedDraw& transparent, const PreparedDraw& opaque);

}  // namespace strata::pipeline
