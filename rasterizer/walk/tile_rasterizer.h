// rasterizer/walk/tile_rasterizer.h - walks set-up triangles over a region and hands out batches of fragments.
//
// Rule     Fragments come in submission order per pixel; coverage and values are a function of the set-up triangle and
//          the pixel alone, never of the region, the tile size or the walk.
// Tests    tests/rasterizer/walk/tile_rasterizer_test.cpp
#pragma once
#include <span>

#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/coverage/pixel_claims.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/weight_lanes.h"
#include "rasterizer/walk/batch_sink.h"

namespace strata::rasterizer {

// Walks one region; it may draw many lists, one after the other, and is used by one thread at a time.
class TileRasterizer {
  public:
    // The region lies inside the viewport of every geometry that it will walk.
    explicit TileRasterizer(Rect region);

    // Rasterizes `triangles` (indices into geometry.triangles, ascending) and calls `sink` with every batch that has
    // fragments. Scissor and, with ZClip::per_fragment, the depth range have been applied.
    void draw(const Geometry& geometry, std::span<const std::uint32_t> triangles, const DepthRequest& depth,
              const FragmentNeeds& needs, BatchSink sink);

    // Fragments whose filtered depth or attribute needed the exact arithmetic of plane.h; for tests and statistics.
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
