// peeling/algorithms/dual.cpp - two layers per pass, the nearest and the farthest, blended during the peel with one
// shared MAX equation. Bavoil and Myers 2008; peeling/reference/algorithms.md 5, errata E7, E9 to E14.
//
// Needs      RG32F and float MAX blending, three render targets.
// Passes     1 + max(1, ceil(N/2)) with the min-max exit, floor(N/2) + 2 with the paper's exit. Fragments of one depth
//            are merged into one layer.
// Invariant  before a peel, min_max = (-near, far) of the depths that remain, front = the layers nearer than `near`
//            (alpha = 1 - transmittance), back = the layers beyond `far` over the background.
// Replay     by default these passes define the result but do not run: in replay execution, on rgba8 and float targets,
//            peeling/loops/resolve.cpp computes their result from each pixel's sorted fragments. In tests/peeling
//            execution/execution_test.cpp and sequences/sequences_test.cpp show that bits, passes, queries and trace
//            are equal. The passes run where resolve.cpp cannot be used (its head states the conditions).
#include <algorithm>
#include <utility>

#include "peeling/algorithms/entry.h"
#include "peeling/loops/resolve.h"
#include "peeling/programs/fixed_passes/tail.h"
#include "peeling/programs/min_max.h"

namespace strata::peeling::listing::dual {

using namespace pipeline;

namespace {

struct DualTargets {
    Target min_max, next_min_max;  // RT0, and the target that its program reads
    Target front, next_front;      // RT1
    Target back_dump, back;        // RT2, and the target that it is blended onto
};

// Nothing is discarded: RT1 is cleared every pass, and its content survives because every fragment writes the old value
// under MAX (E13).
DrawCounts peel(Region& region, const DualTargets& t) {
    region.clear(t.next_min_max, empty_min_max);
    region.clear(t.next_front, {.color = {0, 0, 0, 0}});
    region.clear(t.back_dump, {.color = {0, 0, 0, 0}});
    PassState state;
    state.color = {t.next_min_max, t.next_front, t.back_dump};
    state.blend = {blend_mode::max, blend_mode::max, blend_mode::max};
    state.reads = {t.min_max, t.front, region.opaque_depth()};
    const DepthCompare compare = region.frame().depth_compare();
    state.needs.code = false;
    state.needs.reference = !compare.is_plain();
    state.selection = ends_between(compare, t.min_max, region.opaque_depth(), Outside::writes_alike);
    return region.draw(state, region.frame().second_list(),
                       [compare](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                           PeelLanes side;
                           classify(compare, in, loads.color(0), loads.depth(2), side);
                           write_min_max(in, side.is_between, out.color[0]);
                           write_layers(in, loads.color(1), side, out.color[1], out.color[2]);
                       });
}

// Blends the peeled back layer OVER; counts the pixels that have layers left to peel.
DrawCounts blend_back(Region& region, const DualTargets& t) {
    PassState state;
    state.color[0] = t.back;
    state.blend[0] = over_background(region.frame());
    state.reads = {t.back_dump, t.next_min_max, t.min_max};
    return region.full_screen(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = loads.color(0);
        std::uint32_t left = 0;
        for (std::size_t i = 0; i < lanes(in); ++i) {
            out.alive[i] = loads.color(0)[3][i] != 0.0f ? ~0u : 0u;
            left += loads.color(1)[0][i] != -1.0f || loads.color(1)[1][i] != -1.0f ? 1 : 0;
        }
        out.tally += left;
    });
}

// Records the depths that this pass composited at each end, for the audit. Not a pass of the emulated device.
void trace_peel(Region& region, const DualTargets& t) {
    for (const Side side : {Side::front, Side::back})
        region.trace_pixels(t.min_max, [side](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            for (std::size_t i = 0; i < lanes(in); ++i) {
                const float near = -loads.color(0)[0][i], far = loads.color(0)[1][i];
                const bool has = side == Side::front ? near <= far : near < far;
                out.side[i] = has ? side : Side::none;
                out.key[i] = ordered_code(side == Side::front ? near : far);
            }
        });
}

// One more pass draws the fragments that are left between the two ends into the tail (fixed_passes/tail.h), over the
// layers behind them.
Target draw_tail(Region& region, const ListingInputs& inputs, const DualTargets& t) {
    TailTargets tail{region, *inputs.options.tail, inputs, t.back};
    PassState state = tail.state();
    state.reads = {t.min_max, region.opaque_depth()};
    const DepthCompare compare = region.frame().depth_compare();
    state.needs.code = false;
    state.needs.reference = !compare.is_plain();
    static_cast<void>(region.draw(state, region.frame().second_list(),
                                  [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                                      tail.write(in, out);
                                      PeelLanes side;
                                      classify(compare, in, loads.color(0), loads.depth(1), side);
                                      for (std::size_t i = 0; i < lanes(in); ++i)
                                          out.alive[i] &= side.is_near[i] | side.is_between[i] | side.is_far[i];
                                  }));
    return tail.resolve();
}

void run(Region& region, const ListingInputs& inputs) {
    const auto rg = Format::rg32f;
    DualTargets t{region.make(rg),
                  region.make(rg),
                  region.make_color(),
                  region.make_color(),
                  region.make(region.frame().behind_format()),
                  region.make(region.frame().behind_format())};
    region.set_name(t.min_max, "min_max");
    region.set_name(t.next_min_max, "min_max");
    region.set_name(t.front, "front");
    region.set_name(t.next_front, "front");
    region.set_name(t.back_dump, "back_layer");
    region.set_name(t.back, "back");
    DualLayers layers{region};
    region.clear(t.front, {.color = {0, 0, 0, 0}});
    region.copy(region.opaque_color(), t.back);
    initialize(region, t.min_max);
    const bool paper = region.frame().termination.rule == TerminationRule::paper;
    while (!region.limit_reached()) {
        region.begin_iteration();
        static_cast<void>(peel(region, t));
        const DrawCounts blended = blend_back(region, t);
        trace_peel(region, t);
        layers.keep(t.min_max);
        std::swap(t.min_max, t.next_min_max);
        std::swap(t.front, t.next_front);
        // The paper's query counts whether any back layer was blended (E14); the exact exit asks whether any depth is
        // left.
        if (!(paper ? region.any(blended.passed, Idle::no) : region.any(blended.tallied, Idle::yes))) break;
    }
    layers.end();
    const bool has_tail = inputs.options.tail.value_or(Tail::none) != Tail::none;
    publish_over(region, t.front, FrontAlpha::covers, has_tail ? draw_tail(region, inputs, t) : t.back);
}

void run_plain(Region& region) { run(region, {}); }

}  // namespace

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "dual",
                      .listed = 50,
                      .paper = "Bavoil and Myers 2008",
                      .section = "Dual Depth Peeling",
                      .summary = "nearest and farthest layer of every pass, blended on the fly under one MAX equation",
                      .pass_formula = "1 + max(1, ceil(N/2))",
                      .ties = TiePolicy::merged,
                      .key = DepthKey::shader_z,
                      .exact = true,
                      .makes_layers = true,
                      .takes_both_ends = true,
                      .traces_own_targets = true,
                      .geometry_passes = [](int layers) { return 1 + std::max(1, (layers + 1) / 2); },
                      .run = run_plain,
                      .run_with = run,
                      .resolve_loop = dual_resolve,
                      .features = {float_targets, fragment_programs},
                      .render_targets = 3}};
}

}  // namespace strata::peeling::listing::dual
