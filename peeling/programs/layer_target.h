// peeling/programs/layer_target.h - what one-layer-a-pass peels do with the layer.
#pragma once
#include "pipeline/region/region.h"

namespace strata::peeling {

// Full screen: a premultiplied layer UNDER what is accumulated. `depth` differs from the opaque depth where it has a fragment.
void composite_layer(pipeline::Region& region, pipeline::Target layer, pipeline::Target depth,
                     pipeline::Target accumulated);

}  // namespace strata::peeling
