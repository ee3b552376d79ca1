// rasterizer/values/move_lane.h - a fragment of a batch takes another one's place, when some between them are dropped.
#pragma once
#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/values/weight_lanes.h"

namespace strata::rasterizer {

// Lane `from` becomes lane `to`.
// Only arrays that are filled before fragments are dropped: `primitive` is the same in all lanes of the triangle.
inline void move_lane(std::size_t from, std::size_t to, FragmentBatch& batch, WeightLanes& weights) noexcept {
    batch.pixel[to] = batch.pixel[from];
    batch.x[to] = batch.x[from];
    batch.y[to] = batch.y[from];
    batch.shader_z[to] = batch.shader_z[from];
    weights.b1[to] = weights.b1[from];
    weights.b2[to] = weights.b2[from];
}

}  // namespace strata::rasterizer
