// peeling/programs/layer_quads.h - saved layers composited as textured quads, far to near. Everitt 2001, "Putting It
// All Together". Straight colours, alpha 0 where a pixel has no such layer; blending SRC_ALPHA, ONE_MINUS_SRC_ALPHA. A
// layer's depth says where it has a fragment: elsewhere it is the opaque surface's.
#pragma once
#include <vector>

#include "pipeline/region/region.h"

namespace strata::peeling {

struct SavedLayers {
    std::vector<pipeline::Target> color, depth;  // near to far
};

// The work of a layer's quad is counted with the iteration that made the layer; the first iteration is 1.
void composite_quads(pipeline::Region& region, const SavedLayers& layers, pipeline::Target result);

}  // namespace strata::peeling
