// peeling/algorithms/front_to_back.cpp - one layer per pass, nearest first, blended UNDER the layers before it. Everitt
// 2001 (the peel), Bavoil and Myers 2008 section "Under Blending"; peeling/reference/algorithms.md 4.
//
// Needs      a fragment program with discard, separate alpha blending, a depth buffer that it can read.
// Passes     N + 1 for N distinct depths: the last one finds nothing. Of equal depths only the first submitted is kept.
// Invariant  before pass i, `accumulated` = layers 0 .. i-1 composited, alpha = their transmittance,
//            and `peeled` = the depth of layer i-1.
// Replay     by default these passes define the result but do not run: in replay execution, on rgba8 and float targets,
//            peeling/loops/resolve.cpp computes their result from each pixel's sorted fragments. The passes run where
//            it cannot be used (its head states the conditions).
#include <utility>

#include "peeling/algorithms/entry.h"
#include "peeling/loops/resolve.h"
#include "peeling/programs/fixed_passes/tail.h"
#include "peeling/programs/layer_target.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::front_to_back {

using namespace pipeline;

namespace {

// Draws the nearest fragment behind `peeled`. The first pass peels nothing and needs a flag, because D24 has no depth
// below zero (E23).
DrawCounts peel(Region& region, Target layer, Target nearest, Target peeled, bool first) {
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = nearest;
    state.color[0] = layer;
    if (!first) state.reads[0] = peeled;
    const DepthCompare compare = region.frame().depth_compare();
    state.needs.shader_z = false;
    state.needs.reference = !first && !compare.is_plain();
    state.selection = nearest_behind(compare, state.reads[0]);
    const PreparedDraw& list = first ? *region.frame().transparent : region.frame().second_list();
    return region.draw(state, list, [first, compare](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        premultiply(in.color, out.color[0], lanes(in));
        if (!first) discard_peeled(compare, in, loads.depth(0), out);
    });
}

// One more pass draws the fragments behind the last peeled layer into the tail (fixed_passes/tail.h).
Target draw_tail(Region& region, const ListingInputs& inputs, Target peeled) {
    TailTargets tail{region, *inputs.options.tail, inputs};
    PassState state = tail.state();
    state.reads[0] = peeled;
    const DepthCompare compare = region.frame().depth_compare();
    state.needs.reference = !compare.is_plain();
    static_cast<void>(region.draw(state, region.frame().second_list(),
                                  [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                                      tail.write(in, out);
                                      discard_peeled(compare, in, loads.depth(0), out);
                                  }));
    return tail.resolve();
}

void run(Region& region, const ListingInputs& inputs) {
    const Target accumulated = region.make_color();
    const Target layer = region.make_color();
    Target peeled = region.make_depth();
    Target nearest = region.make_depth();
    region.set_name(accumulated, "accumulated");
    region.set_name(layer, "layer");
    region.set_name(peeled, "nearest");
    region.set_name(nearest, "nearest");
    region.clear(accumulated, {.color = {0, 0, 0, 1}});
    for (bool first = true; !region.limit_reached(); first = false) {
        region.begin_iteration();
        region.clear(layer, {.color = {0, 0, 0, 0}});
        region.copy(region.opaque_depth(), nearest);
        const DrawCounts drawn = peel(region, layer, nearest, peeled, first);
        composite_layer(region, layer, nearest, accumulated);
        std::swap(peeled, nearest);
        if (!region.any(drawn.passed, idle_when_zero(region.frame()))) {
            region.keep_no_layer(layer, peeled);
            break;
        }
        region.keep_layer(layer, peeled);
    }
    const bool has_tail = inputs.options.tail.value_or(Tail::none) != Tail::none;
    publish_over_background(region, accumulated, has_tail ? draw_tail(region, inputs, peeled) : region.opaque_color());
}

void run_plain(Region& region) { run(region, {}); }

}  // namespace

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "front_to_back",
                      .listed = 40,
                      .paper = "Bavoil and Myers 2008",
                      .section = "Depth Peeling; Under Blending",
                      .summary = "one layer a pass, nearest first, blended UNDER",
                      .pass_formula = "N + 1",
                      .ties = TiePolicy::unique,
                      .key = DepthKey::stored_code,
                      .exact = true,
                      .makes_layers = true,
                      .premultiplied_layers = true,
                      .shows_depth_paths = true,
                      .geometry_passes = every_layer_and_one,
                      .run = run_plain,
                      .run_with = run,
                      .resolve_loop = front_to_back_resolve,
                      .features = {fragment_programs, separate_alpha_blend}}};
}

}  // namespace strata::peeling::listing::front_to_back
