// pipeline/effects.h - which effects a pass simulates: decided from its state and its materials before the first fragment.
//
// Rule     Needed is what the program declares, and what a stage that is switched on looks at. `all` simulates everything; the
//          bits are the same.
// Source   design.md, idea 3.
// Tests    tests/peeling/execution_test.cpp
#pragma once
#include "pipeline/frame.h"
#include "pipeline/pass.h"

namespace strata::pipeline {

// The arrays of a fragment that a geometry pass over `list` must have computed.
[[nodiscard]] inline rasterizer::FragmentNeeds pass_needs(const PassState& state, const PreparedDraw& list, Effects effects) {
    rasterizer::FragmentNeeds needs = state.needs;
    if (effects == Effects::all) return {true, true, needs.exact_code, true, true, true};
    needs.code |= state.depth.enabled || state.depth_unit_count > 0;
    needs.facing |= state.stencil.enabled && state.stencil.two_sided;
    needs.color |= list.needs_color;
    needs.texcoord |= list.needs_texcoord && needs.color;
    return needs;
}

}  // namespace strata::pipeline
