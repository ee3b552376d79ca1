// peeling/programs/layer_target.h - what one-layer-a-pass peels do with the layer.
#pragma once
#include "peeling/programs/programs.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

// Full screen: a premultiplied layer UNDER what is accumulated. `depth` differs from the opaque depth where it has a
// fragment.
void composite_layer(pipeline::Region& region, pipeline::Target layer, pipeline::Target depth,
                     pipeline::Target accumulated);

// A quad that blends a layer reads the two depths that tell where it is. The trace alone looks at their values: without
// one they are textures, as good as loads, which no program samples. True with a trace: then a program calls the other
// of this name.
[[nodiscard]] inline bool trace_layer(pipeline::PassState& state, const pipeline::Region& region,
                                      pipeline::Target depth) {
    const bool is_traced = region.frame().trace;
    auto* const depths = is_traced ? state.reads.data() + 1 : state.textures.data();
    depths[0] = depth;
    depths[1] = region.opaque_depth();
    return is_traced;
}
inline void trace_layer(const pipeline::Loads& own, std::size_t count, pipeline::Side side, pipeline::Outputs& out) {
    out.traced = true;
    for (std::size_t i = 0; i < count; ++i) {
        out.side[i] = own.depth(1)[i] != own.depth(2)[i] ? side : pipeline::Side::none;
        out.key[i] = own.depth(1)[i];
    }
}

}  // namespace strata::peeling
