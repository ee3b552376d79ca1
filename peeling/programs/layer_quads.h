// peeling/programs/layer_quads.h - composites saved layers as textured quads, far to near. Everitt 2001, "Putting It
// All Together". Colours are not premultiplied, and alpha is 0 where a pixel has no such layer; blending SRC_ALPHA,
// ONE_MINUS_SRC_ALPHA. Where a layer has no fragment, its depth is the opaque surface's.
#pragma once
#include <vector>

#include "pipeline/region/region.h"

namespace strata::peeling {

struct SavedLayers {
    std::vector<pipeline::Target> color, depth;  // near to far
};

// Publishes the layers composited over the opaque picture. The work of a layer's quad is counted in the iteration that
// made the layer; the first iteration is 1.
void publish_quads(pipeline::Region& region, const SavedLayers& layers);

}  // namespace strata::peeling
