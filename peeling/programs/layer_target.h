// peeling/programs/layer_target.h - how front_to_back and other peels of one layer per pass composite the layer.
#pragma once
#include "peeling/programs/programs.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

// A full-screen quad that blends a premultiplied layer UNDER `accumulated`. `depth` differs from the opaque depth where
// the layer has a fragment.
void composite_layer(pipeline::Region& region, pipeline::Target layer, pipeline::Target depth,
                     pipeline::Target accumulated);

// A quad that blends a layer binds the two depths that show where it has fragments. Only the trace reads their values:
// without one they are bound as textures that no program samples. Returns true with a trace; the program then calls the
// other overload.
[[nodiscard]] inline bool trace_layer(pipeline::PassState& state, const pipeline::Region& region,
                                      pipeline::Target depth) {
    const bool is_traced = region.frame().trace;
    auto* const depths = is_traced ? state.reads.data() + 1 : state.textures.data();
    depths[0] = depth;
    depths[1] = region.opaque_depth();
    return is_traced;
}
inline void trace_layer(const pipeline::Loads& loads, std::size_t count, pipeline::Side side, pipeline::Outputs& out) {
    out.traced = true;
    for (std::size_t i = 0; i < count; ++i) {
        out.side[i] = loads.depth(1)[i] != loads.depth(2)[i] ? side : pipeline::Side::none;
        out.key[i] = loads.depth(1)[i];
    }
}

}  // namespace strata::peeling
