// rasterizer/values/weight_lanes.h - the weights of a batch's fragments as arrays (pixel_weights.h says which).
#pragma once
#include <array>

#include "rasterizer/coverage/fragment_batch.h"

namespace strata::rasterizer {

// The weights of a batch's fragments in their own triangles.
struct alignas(64) WeightLanes {
    Lanes<double> b1, b2;
};

}  // namespace strata::rasterizer
