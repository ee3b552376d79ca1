// peeling/algorithms/dual_independent.cpp - dual peeling with a blend equation a target: UNDER in front, OVER behind, during the peel.
// Bavoil and Myers 2008, "Blending on the Fly" (DirectX 10.1); algorithms.md 6.
//
// Needs      ARB_draw_buffers_blend (independent blending), RG32F and float MAX blending, three render targets.
// Passes     ceil(N/2) + 2: the last peel finds nothing. No layer is lost on ties.
// Invariant  before a peel, min_max = (-near, far) of what is left, front = what lies before near (alpha = transmittance),
//            back = what lies behind far, over the background. Neither is cleared between passes.
#include <utility>

#include "peeling/algorithms/runs.h"
#include "peeling/programs/min_max.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// Fragments outside the range are discarded; the others write all three targets, a neutral value where they do not
// count.
Drawn peel(Region& region, Target min_max, Target next_min_max, Target front, Target back) {
    region.clear(next_min_max, empty_min_max);
    PassState state;
    state.color = {next_min_max, front, back};
    state.blend = {blend_mode::max, blend_mode::under, blend_mode::over};
    state.blend[2].write_mask = 0x7;
    state.reads = {min_max, region.opaque_depth()};
    const DepthCompare compare = region.frame().depth_compare();
    state.needs.code = false;
    state.needs.reference = !compare.is_plain();
    if (compare.is_plain()) state.selection = {.keeps = Keeps::ends, .before = region.opaque_depth(), .range = min_max};
    return region.draw(state, List::second, [compare](const FragmentBatch& in, const Loads& own, Outputs& out) {
        PeelLanes side;
        classify(compare, in, own.color(0), own.depth(1), side);
        write_min_max(in, side.is_between, out.color[0]);
        premultiply(in.color, out.color[1], lanes(in));
        for (std::size_t c = 0; c < 4; ++c)  // (0, 0, 0, 0) is neutral in both blends
            for (std::size_t i = 0; i < lanes(in); ++i) {
                out.color[1][c][i] = select(side.is_near[i], out.color[1][c][i], 0.0f);
                out.color[2][c][i] = select(side.is_far[i], in.color[c][i], 0.0f);
            }
        out.traced = true;
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const std::uint32_t is_near = side.is_near[i], is_far = side.is_far[i];
            out.alive[i] &= is_near | is_far | side.is_between[i];
            out.side[i] = is_near != 0 ? Side::front : is_far != 0 ? Side::back : Side::none;
            out.key[i] = ordered_code(in.shader_z[i]);
        }
    });
}

}  // namespace

void dual_independent(Region& region) {
    Target min_max = region.make(Format::rg32f), next_min_max = region.make(Format::rg32f);
    const Target front = region.make_color(), back = region.make_color();
    region.call(min_max, "min_max");
    region.call(next_min_max, "min_max");
    region.call(front, "front");
    region.call(back, "back");
    DualLayers layers{region};
    region.clear(front, {.color = {0, 0, 0, 1}});
    region.copy(region.opaque_color(), back);
    initialize(region, min_max);
    while (!region.limit_reached()) {
        region.begin_iteration();
        const Drawn drawn = peel(region, min_max, next_min_max, front, back);
        layers.keep(min_max);
        std::swap(min_max, next_min_max);
        if (!region.any(drawn.passed, Idle::steady)) break;
    }
    layers.end();
    publish_over_background(region, front, back);
}

}  // namespace strata::peeling
