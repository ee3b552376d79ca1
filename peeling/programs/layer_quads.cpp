// peeling/programs/layer_quads.cpp - the passes of layer_quads.h and layer_target.h.
#include "peeling/programs/layer_quads.h"

#include "peeling/programs/layer_target.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling {

using namespace pipeline;

// OVER, far to near (peeling/reference/algorithms.md 2). A pixel without such a layer has alpha 0, which leaves the
// target unchanged, and the opaque depth, by which the trace recognises it. Only the trace reads the depths; without
// one they are bound as textures instead of loads.
void publish_quads(Region& region, const SavedLayers& layers) {
    const Target result = region.make_color();
    region.set_name(result, "result");
    region.copy(region.opaque_color(), result);
    for (std::size_t layer = layers.color.size(); layer-- > 0;) {
        PassState state;
        state.color[0] = result;
        state.blend[0] = over_background(region.frame());
        state.reads[0] = layers.color[layer];
        const bool is_traced = trace_layer(state, region, layers.depth[layer]);
        static_cast<void>(
            region.full_screen(state, [is_traced](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                out.color[0] = loads.color(0);
                if (is_traced) trace_layer(loads, lanes(in), Side::back, out);
            }));
    }
    region.publish(result);
}

void composite_layer(Region& region, Target layer, Target depth, Target accumulated) {
    PassState state;
    state.color[0] = accumulated;
    state.blend[0] = blend_mode::under;
    state.reads[0] = layer;
    const bool is_traced = trace_layer(state, region, depth);
    static_cast<void>(region.full_screen(state, [is_traced](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = loads.color(0);  // alpha 0 where the pixel has no such layer: UNDER leaves the target unchanged
        if (is_traced) trace_layer(loads, lanes(in), Side::front, out);
    }));
}

}  // namespace strata::peeling
