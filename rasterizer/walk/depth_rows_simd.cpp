// rasterizer/walk/depth_rows_simd.cpp - draw_float_rows of rows.h, compiled once per instruction set. How kernels are
// written: rasterizer/reference/kernels.md. Tests: tests/rasterizer/walk/rows_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/walk/depth_rows_simd.cpp"
#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "rasterizer/walk/row_walk-inl.h"
#include "rasterizer/walk/rows.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// State of a depth pass over all its triangles: the region's codes, the conversion to codes, and the counts.
struct DepthState {
    DepthConversion<float> to_code;
    double z_units;
    std::uint32_t* codes;
    DepthDrawn drawn;
};

template <bool is_fixed>
struct DepthOf {
    // The planes of one triangle. Members are const copies, so that the compiler does not reload them after stores of
    // codes.
    template <bool unsnapped>
    class Shade {
      public:
        HWY_INLINE Shade(DepthState& state, const DrawnTriangle& triangle)
            : state_{state},
              to_code_{state.to_code},
              codes_{state.codes},
              geometry_{triangle.geometry},
              index_{triangle.index},
              exact_{triangle.geometry.depths(triangle.index), 1.0, state.z_units},
              plane_{filter_of(exact_, triangle)} {}

        HWY_INLINE void operator()(const Row& row, const Weights& b) {
            const V32 z = rounded_plane<unsnapped>(plane_, b, exact_, geometry_, index_, row);
            const auto code = codes<is_fixed>(z, to_code_);
            std::uint32_t* const stored = codes_ + row.pixel;
            const auto passed = hn::And(row.covered, nearer(code, hn::LoadU(U32{}, stored), is_fixed));
            hn::BlendedStore(code, hn::RebindMask(U32{}, passed), U32{}, stored);
            passed_ += hn::CountTrue(F32{}, passed);
        }
        HWY_INLINE void finish(std::uint64_t pixels) {
            state_.drawn.fragments += pixels;
            state_.drawn.passed += passed_;
        }

      private:
        DepthState& state_;
        const DepthConversion<float> to_code_;
        std::uint32_t* const codes_;
        const Geometry& geometry_;
        const std::uint32_t index_;
        const RationalPlane exact_;
        const FilterPlane plane_;
        std::size_t passed_ = 0;
    };
};

template <bool is_fixed>
void draw(const Geometry& geometry, std::span<const std::uint32_t> triangles, const Rect& region, DepthState& state) {
    RowWalk<DepthOf<is_fixed>::template Shade, DepthState>{state, geometry, region}.draw(triangles);
}

DepthDrawn draw_depth(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                      const DepthConversion<float>& to_code, double units, const Rect& region, std::uint32_t* codes) {
    DepthState state{to_code, units, codes, {}};
    if (to_code.is_fixed())
        draw<true>(geometry, triangles, region, state);
    else
        draw<false>(geometry, triangles, region, state);
    return state.drawn;
}

}  // namespace
}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"
#include "rasterizer/values/depth/depth_scale.h"

namespace strata::rasterizer {
STRATA_EXPORT(draw_depth);

DepthDrawn draw_float_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                           const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept {
    const DepthScale scale = depth_scale(geometry, depth);
    return kernel_of(HWY_DISPATCH_TABLE(draw_depth))(geometry, triangles, scale.to_code, scale.z_units, region, codes);
}

}  // namespace strata::rasterizer
#endif
