// rasterizer/walk/tile_rasterizer.h - walks the triangles of a Geometry over a region and passes batches of fragments
// to a sink.
//
// Rule     Fragments of a pixel come in submission order. Coverage and values are functions of the triangle after
//          set-up and the pixel, never of the region, the tile size or the walk.
// Tests    tests/rasterizer/walk/tile_rasterizer_test.cpp
#pragma once
#include <span>

#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/coverage/pixel_claims.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/weight_lanes.h"
#include "rasterizer/walk/batch_sink.h"

namespace strata::rasterizer {

// Walks one region. It can draw several lists, one after the other, from one thread at a time.
class TileRasterizer {
  public:
    // The region must be inside the viewport of every geometry that is drawn.
    explicit TileRasterizer(Rect region);

    // Rasterizes `triangles` (indices into geometry.triangles, ascending) and calls `sink` with every nonempty batch.
    // Scissor and, with ZClip::per_fragment, the depth range are already applied. Values are evaluated as the
    // geometry's state says.
    void draw(const Geometry& geometry, std::span<const std::uint32_t> triangles, const DepthRequest& depth,
              const FragmentNeeds& needs, BatchSink sink) {
        draw_at(geometry.state.interpolation, geometry, triangles, depth, needs, sink);
    }
    // The same, but values are evaluated elsewhere; only at the sample if the state has none.
    void draw_at(Interpolation at, const Geometry& geometry, std::span<const std::uint32_t> triangles,
                 const DepthRequest& depth, const FragmentNeeds& needs, BatchSink sink);

    // The number of fragments whose filtered depth or attribute needed the exact arithmetic of plane.h, for tests and
    // statistics.
    [[nodiscard]] std::uint64_t exact_fallbacks() const noexcept { return exact_fallbacks_; }

  private:
    class Pass;

    Rect region_;
    PixelClaims claims_;
    std::uint64_t exact_fallbacks_ = 0;
    FragmentBatch batch_;
    WeightLanes weights_{};
};

}  // namespace strata::rasterizer
