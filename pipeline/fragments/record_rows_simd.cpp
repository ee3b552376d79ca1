// pipeline/fragments/record_rows_simd.cpp - record_rows.h, compiled once per instruction set. How kernels are written:
// rasterizer/reference/kernels.md. Tests: tests/pipeline/fragments/record_rows_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/fragments/record_rows_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/fragments/record_rows.h"
#include "pipeline/stages/color_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

using raster::U32;
using WordVec = hn::Vec<U32>;

constexpr std::size_t row_lanes = hn::MaxLanes(U32{});

struct RecordState {
    TileFragments& record;
    rasterizer::DepthConversion<float> to_code;
    double z_units;
    TileFragments::Space space;
    std::uint64_t fragments = 0;

    // Stores the first `count` lanes. The lanes after them are overwritten by the next call.
    HWY_INLINE void put(WordVec pixel, WordVec primitive, V32 z, const V32 (&color)[4], std::size_t count) {
        const std::size_t at = space.size;
        hn::StoreU(pixel, U32{}, space.pixel + at);
        hn::StoreU(primitive, U32{}, space.primitive + at);
        if (space.code != nullptr) hn::StoreU(raster::codes(z, to_code), U32{}, space.code + at);
        if (space.shader_z != nullptr) hn::StoreU(z, F32{}, space.shader_z + at);
        if (space.color != nullptr)
            hn::StoreInterleaved4(color[0], color[1], color[2], color[3], F32{}, space.color[at].data());
        space.size += count;
        if (HWY_UNLIKELY(space.size + row_lanes > space.capacity)) space = record.more_space(space);
    }
};

// Constructed once per triangle; covered pixels are its first lanes.
template <bool unsnapped>
class RecordShade {
  public:
    HWY_INLINE RecordShade(RecordState& state, const DrawnTriangle& triangle)
        : state_{state},
          triangle_{triangle},
          color_{triangle},
          depth_{triangle.geometry.depths(triangle.index), 1.0, state.z_units},
          filter_{raster::filter_of(depth_, triangle)} {}

    HWY_INLINE void operator()(const raster::Row& row, const raster::Weights& b) {
        put(row, hn::Add(hn::Set(U32{}, static_cast<std::uint32_t>(row.pixel)), hn::Iota(U32{}, 0)), b);
    }
    HWY_INLINE void operator()(const raster::Pixels& pixels, const raster::Weights& b) { put(pixels, pixels.pixel, b); }
    HWY_INLINE void finish(std::uint64_t pixels) { state_.fragments += pixels; }

  private:
    template <class Where>
    HWY_INLINE void put(const Where& where, WordVec pixel, const raster::Weights& b) {
        const V32 z = raster::rounded_plane<unsnapped>(filter_, b, depth_, triangle_.geometry, triangle_.index, where);
        V32 color[4];
        if (color_.is_flat())
            for (std::size_t c = 0; c < 4; ++c) color[c] = hn::Set(F32{}, color_.flat(c));
        else
            color_.template at<unsnapped>(where, b, color);
        state_.put(pixel, hn::Set(U32{}, triangle_.record.primitive), z, color, hn::CountTrue(F32{}, where.covered));
    }

    RecordState& state_;
    const DrawnTriangle& triangle_;
    const ColorPlanes color_;
    const RationalPlane depth_;
    const FilterPlane filter_;
};

std::uint64_t record_all(TileFragments& to, const rasterizer::Geometry& geometry,
                         std::span<const std::uint32_t> triangles, const rasterizer::Rect& region,
                         const rasterizer::DepthConversion<float>& to_code, double z_units) {
    RecordState state{to, to_code, z_units, to.more_space({.size = to.size()})};
    raster::RowWalk<RecordShade, RecordState>{state, geometry, region}.draw(triangles);
    to.close(state.space.size);
    return state.fragments;
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"
#include "rasterizer/values/depth/depth_scale.h"

namespace strata::pipeline {
STRATA_EXPORT(record_all);

std::uint64_t record_rows(TileFragments& to, const rasterizer::Geometry& geometry,
                          std::span<const std::uint32_t> triangles, const rasterizer::DepthRequest& depth,
                          const rasterizer::Rect& region) {
    const rasterizer::DepthScale scale = depth_scale(geometry, depth);
    return kernel_of(HWY_DISPATCH_TABLE(record_all))(to, geometry, triangles, region, scale.to_code, scale.z_units);
}

}  // namespace strata::pipeline
#endif
