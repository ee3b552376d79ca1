// peeling/algorithms/depth_units.cpp - one layer per pass with two sequential depth units. Everitt 2001, Listing 1;
// peeling/reference/algorithms.md 2.
//
// Needs      STRATA_depth_units, an emulator extension: no device had sequential depth units.
// Passes     N + 1 for N distinct depths: the last one finds nothing. Of equal depths only the first submitted is kept.
// Invariant  before pass i, `peeled` = depth of layer i-1, and layers 0 .. i-1 are saved; alpha is 0 where a pixel has
//            no such layer.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/layer_quads.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::depth_units {

using namespace pipeline;

namespace {

// Draws the nearest fragment behind `peeled`. Comparisons other than of stored codes run in the fragment program,
// before the depth units.
DrawCounts peel(Region& region, Target peeled, Target nearest, Target layer, bool first) {
    const DepthCompare compare = region.frame().depth_compare();
    const bool in_program = !first && !compare.is_plain();
    PassState state;
    state.depth_units[0] = {.depth = peeled, .func = CompareFunc::greater};
    state.depth_unit_count = first || in_program ? 0 : 1;
    if (in_program) state.reads[0] = peeled;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = nearest;
    state.color[0] = layer;
    state.needs.shader_z = false;
    state.needs.reference = in_program;
    state.selection = nearest_behind(compare, first ? Target{} : peeled);
    const PreparedDraw& list = first ? *region.frame().transparent : region.frame().second_list();
    return region.draw(state, list, [in_program, compare](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = in.color;
        if (in_program) discard_peeled(compare, in, loads.depth(0), out);
    });
}

}  // namespace

void run(Region& region) {
    SavedLayers layers;
    Target peeled;
    while (!region.limit_reached()) {
        region.begin_iteration();
        const Target layer = region.make_color();
        const Target nearest = region.make_depth();
        region.set_name(layer, "layer");
        region.set_name(nearest, "nearest");
        region.clear(layer, {.color = {0, 0, 0, 0}});
        region.copy(region.opaque_depth(), nearest);
        const DrawCounts drawn = peel(region, peeled, nearest, layer, layers.color.empty());
        layers.color.push_back(layer);
        layers.depth.push_back(nearest);
        peeled = nearest;
        if (!region.any(drawn.passed, idle_when_zero(region.frame()))) {
            region.keep_no_layer(layer, nearest);
            break;
        }
        region.keep_layer(layer, nearest);
    }
    publish_quads(region, layers);
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "depth_units",
                      .listed = 20,
                      .paper = "Everitt 2001",
                      .section = "Multiple Depth Tests, Listing 1",
                      .summary = "one layer a pass by two sequential depth units; layers composited back to front",
                      .pass_formula = "N + 1",
                      .ties = TiePolicy::unique,
                      .key = DepthKey::stored_code,
                      .exact = true,
                      .makes_layers = true,
                      .geometry_passes = every_layer_and_one,
                      .run = run,
                      .features = {sequential_depth_units}}};
}

}  // namespace strata::peeling::listing::depth_units
