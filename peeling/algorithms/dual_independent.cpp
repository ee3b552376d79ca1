// peeling/algorithms/dual_independent.cpp - dual peeling with one blend equation per target: layers are blended UNDER
// in front and OVER behind during the peel. Bavoil and Myers 2008, "Blending on the Fly" (DirectX 10.1);
// peeling/reference/algorithms.md 6.
//
// Needs      ARB_draw_buffers_blend (independent blending), RG32F and float MAX blending, three render targets.
// Passes     ceil(N/2) + 2: the last peel finds nothing. No layer is lost on ties.
// Invariant  before a peel, min_max = (-near, far) of the depths that remain, front = the layers nearer than `near`
//            (alpha = transmittance), back = the layers beyond `far` over the background. Neither is cleared between
//            passes.
#include <algorithm>
#include <utility>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/min_max.h"

namespace strata::peeling::listing::dual_independent {

using namespace pipeline;

namespace {

// Sets the lanes outside `chosen` to (0, 0, 0, 0), which is neutral in both blends.
void choose(const Lanes<std::uint32_t>& chosen, ColorLanes& colors, std::size_t count) noexcept {
    for (auto& channel : colors)
        for (std::size_t i = 0; i < count; ++i) channel[i] = select(chosen[i], channel[i], 0.0f);
}

// Fragments outside the range are discarded. The others write all three targets, with a neutral value where they are
// neither nearest nor farthest.
DrawCounts peel(Region& region, Target min_max, Target next_min_max, Target front, Target back) {
    region.clear(next_min_max, empty_min_max);
    PassState state;
    state.color = {next_min_max, front, back};
    state.blend = {blend_mode::max, blend_mode::under, over_background(region.frame())};
    state.reads = {min_max, region.opaque_depth()};
    const DepthCompare compare = region.frame().depth_compare();
    state.needs.code = false;
    state.needs.reference = !compare.is_plain();
    state.selection = ends_between(compare, min_max, region.opaque_depth(), Outside::dies);
    const bool is_traced = region.frame().trace;
    return region.draw(state, region.frame().second_list(),
                       [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                           PeelLanes side;
                           classify(compare, in, loads.color(0), loads.depth(1), side);
                           write_min_max(in, side.is_between, out.color[0]);
                           premultiply(in.color, out.color[1], lanes(in));
                           choose(side.is_near, out.color[1], lanes(in));
                           out.color[2] = in.color;
                           choose(side.is_far, out.color[2], lanes(in));
                           for (std::size_t i = 0; i < lanes(in); ++i)
                               out.alive[i] &= side.is_near[i] | side.is_far[i] | side.is_between[i];
                           out.traced = is_traced;
                           for (std::size_t i = 0; is_traced && i < lanes(in); ++i) {
                               const std::uint32_t is_near = side.is_near[i], is_far = side.is_far[i];
                               out.side[i] = is_near != 0 ? Side::front : is_far != 0 ? Side::back : Side::none;
                               out.key[i] = ordered_code(in.shader_z[i]);
                           }
                       });
}

}  // namespace

void run(Region& region) {
    Target min_max = region.make(Format::rg32f), next_min_max = region.make(Format::rg32f);
    const Target front = region.make_color(), back = region.make(region.frame().behind_format());
    region.set_name(min_max, "min_max");
    region.set_name(next_min_max, "min_max");
    region.set_name(front, "front");
    region.set_name(back, "back");
    DualLayers layers{region};
    region.clear(front, {.color = {0, 0, 0, 1}});
    region.copy(region.opaque_color(), back);
    initialize(region, min_max);
    while (!region.limit_reached()) {
        region.begin_iteration();
        const DrawCounts drawn = peel(region, min_max, next_min_max, front, back);
        layers.keep(min_max);
        std::swap(min_max, next_min_max);
        if (!region.any(drawn.passed, Idle::yes)) break;
    }
    layers.end();
    publish_over_background(region, front, back);
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "dual_independent",
                      .listed = 60,
                      .paper = "Bavoil and Myers 2008",
                      .section = "Blending on the Fly (DirectX 10.1)",
                      .summary = "dual peeling with a blend equation a target; no tie is lost",
                      .pass_formula = "ceil(N/2) + 2",
                      .ties = TiePolicy::first_then_last,
                      .key = DepthKey::shader_z,
                      .exact = true,
                      .makes_layers = true,
                      .takes_both_ends = true,
                      .geometry_passes = [](int layers) { return (layers + 1) / 2 + 2; },
                      .run = run,
                      .features = {independent_blend, separate_alpha_blend, float_targets, fragment_programs},
                      .render_targets = 3}};
}

}  // namespace strata::peeling::listing::dual_independent
