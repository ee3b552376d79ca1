// rasterizer/values/weight_lanes.h - the weights of a batch's fragments as arrays (defined in pixel_weights.h), and
// moving a fragment to another lane when fragments before it are dropped.
#pragma once
#include <array>

#include "rasterizer/coverage/fragment_batch.h"

namespace strata::rasterizer {

// The weights of each fragment of a batch in its own triangle.
struct alignas(64) WeightLanes {
    Lanes<double> b1, b2;
};

// Copies lane `from` to lane `to`. Only the arrays that are filled before fragments are dropped; `primitive` is the
// same in all lanes of the triangle.
inline void move_lane(std::size_t from, std::size_t to, FragmentBatch& batch, WeightLanes& weights) noexcept {
    batch.pixel[to] = batch.pixel[from];
    batch.x[to] = batch.x[from];
    batch.y[to] = batch.y[from];
    batch.shader_z[to] = batch.shader_z[from];
    weights.b1[to] = weights.b1[from];
    weights.b2[to] = weights.b2[from];
}

}  // namespace strata::rasterizer
