// pipeline/frame/effects.h - which effects a pass simulates: decided from its state and materials before the first
// fragment.
//
// Rule     `needed` simulates what the program declares and what enabled stages read. The needs of materials are
//          decided by the tile's own triangles. `all` simulates everything: values that no stage reads, and each
//          disabled stage with a state that changes nothing (alpha GEQUAL 0, stencil ALWAYS and KEEP, depth ALWAYS
//          without a write, blending ONE and ZERO); bits and counters equal those of `needed`. In a tile without opaque
//          triangles the test against the opaque depth is skipped, and no depth is interpolated for it, if every
//          triangle's bound (rasterizer/set_up/depth_bound.h) is less than the cleared 1.
// Source   pipeline/reference/execution.md 6.
// Tests    tests/peeling/execution/execution_test.cpp, tests/pipeline/frame/effects_test.cpp
#pragma once
#include <cstdint>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/frame/instruments.h"
#include "pipeline/frame/pass.h"
#include "pipeline/vertices/prepare.h"

namespace strata::pipeline {

// Adds what the colours of these materials are computed from.
inline void add_needs_of_color(rasterizer::FragmentNeeds& needs, const MaterialNeeds& materials) noexcept {
    if (!needs.color) return;
    needs.texcoord |= materials.texcoord;
    needs.units |= materials.shadow;
    needs.fog |= materials.fog;
    needs.secondary |= materials.secondary;
}

// The fragment arrays that a geometry pass over triangles of these materials must compute.
[[nodiscard]] inline rasterizer::FragmentNeeds pass_needs(const PassState& state, const MaterialNeeds& materials,
                                                          Effects effects, DepthOutcome depth = DepthOutcome::open) {
    rasterizer::FragmentNeeds needs = state.needs;
    if (effects == Effects::all) {
        needs.shader_z = needs.code = needs.color = needs.texcoord = needs.facing = true;
        add_needs_of_color(needs, materials);
        return needs;
    }
    needs.code |= needs.reference || (state.depth.enabled && depth == DepthOutcome::open) || state.depth_unit_count > 0;
    needs.facing |= state.stencil.enabled && state.stencil.two_sided;
    needs.color |= materials.color;
    add_needs_of_color(needs, materials);
    return needs;
}

// `needs` plus the fragment value that `effect` names; unchanged if the effect is a stage.
[[nodiscard]] inline rasterizer::FragmentNeeds with_value(rasterizer::FragmentNeeds needs, Effect effect) {
    needs.color |= effect == Effect::color;
    needs.texcoord |= effect == Effect::texcoord;
    needs.shader_z |= effect == Effect::shader_z;
    needs.code |= effect == Effect::code;
    needs.facing |= effect == Effect::facing;
    return needs;
}

// Counts the tiles of a frame by the fragments of their pixels before any test, and the fragments by material.
struct TileCensus {
    std::uint64_t tiles = 0;
    std::uint64_t empty = 0;        // no fragment at all
    std::uint64_t opaque_only = 0;  // no transparent fragments: nothing to peel
    std::uint64_t single = 0;       // transparent fragments, at most one per pixel: nothing to order
    std::uint64_t layered = 0;      // all others: need peeling
    std::uint64_t with_opaque = 0;  // need opaque priming
    std::vector<std::uint64_t> transparent_fragments, opaque_fragments;  // by material
    friend bool operator==(const TileCensus&, const TileCensus&) = default;
};
// Rasterizes every tile with these values and discards the fragments: for timing.
void walk(const PreparedDraw& list, const rasterizer::DepthRequest& depth, const rasterizer::FragmentNeeds& needs,
          int threads);
// The number of fragments of the deepest pixel, before any test.
[[nodiscard]] std::uint32_t deepest_pixel(const PreparedDraw& list);
// The number of fragments of all pixels, before any test.
[[nodiscard]] std::uint64_t fragment_count(const PreparedDraw& list);
[[nodiscard]] TileCensus count_tiles(const PreparedDraw& transparent, const PreparedDraw& opaque);

}  // namespace strata::pipeline
