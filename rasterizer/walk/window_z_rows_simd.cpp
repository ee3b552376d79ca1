// rasterizer/walk/window_z_rows_simd.cpp - draw_window_z_rows of rows.h, where NV2A interpolates window z, compiled
// once per instruction set.
//
// Rule     WindowZ24 and the codes of its values; ZClip::per_fragment drops fragments outside the depth range, for
//          triangles that have a corner outside it (depth_range.cpp). Corners that are not narrow run lane by lane.
// How kernels are written: rasterizer/reference/kernels.md. Tests: tests/rasterizer/walk/window_z_rows_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/walk/window_z_rows_simd.cpp"
#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "rasterizer/chip/window_z.h"
#include "rasterizer/values/chip_lanes-inl.h"
#include "rasterizer/walk/row_walk-inl.h"
#include "rasterizer/walk/rows.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// State of a depth pass over all its triangles. The region's `pixels` codes are followed by spare words.
struct WindowZState {
    ChipDepth depth;
    std::uint32_t* codes;
    std::size_t pixels;
    DepthDrawn drawn;
};

alignas(32) constexpr std::int32_t lane_numbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};

template <CodeKind kind>
struct WindowZOf {
    template <bool>
    class Shade {
      public:
        static constexpr bool takes_edges = true;

        HWY_INLINE Shade(WindowZState& state, const DrawnTriangle& triangle)
            : Shade{state, triangle,
                    NarrowWindowZ{window_z_corners(triangle.geometry, triangle.index, state.depth.offset),
                                  triangle.geometry.rules.hypothesis}} {}

        // Adjacent pixels, at their stored positions.
        HWY_INLINE void operator()(const Row& row, const Weights& e) {
            RowMask covered = row.covered;
            const auto code = code_at(row, e, covered);
            std::uint32_t* const stored = codes_ + row.pixel;
            const auto passed = hn::And(covered, nearer(code, hn::LoadU(U32{}, stored), true));
            hn::BlendedStore(code, hn::RebindMask(U32{}, passed), U32{}, stored);
            passed_ += hn::CountTrue(F32{}, passed);
        }
        // Pixels of a small triangle, each at most once; lanes past the last one write spare words back.
        HWY_INLINE void operator()(const Pixels& pixels, const Weights& e) {
            RowMask covered = pixels.covered;
            const auto code = code_at(pixels, e, covered);
            const auto spare = hn::Add(hn::Set(I32{}, spare_), hn::Load(I32{}, lane_numbers));
            const auto at =
                hn::IfThenElse(hn::RebindMask(I32{}, pixels.covered), hn::BitCast(I32{}, pixels.pixel), spare);
            const auto stored = hn::GatherIndex(U32{}, codes_, at);
            const auto passed = hn::And(covered, nearer(code, stored, true));
            hn::ScatterIndex(hn::IfThenElse(hn::RebindMask(U32{}, passed), code, stored), U32{}, codes_, at);
            passed_ += hn::CountTrue(F32{}, passed);
        }
        HWY_INLINE void finish(std::uint64_t pixels) {
            state_.drawn.fragments += pixels - dropped_;
            state_.drawn.passed += passed_;
        }

      private:
        HWY_INLINE Shade(WindowZState& state, const DrawnTriangle& triangle, const NarrowWindowZ& corners)
            : state_{state},
              codes_{state.codes},
              spare_{static_cast<std::int32_t>(state.pixels)},
              geometry_{triangle.geometry},
              index_{triangle.index},
              offset_{state.depth.offset},
              to_code_{state.depth.to_code},
              area_{triangle.weights.area},
              weights_{ChipTriangle{triangle.weights, triangle.geometry.rules.hypothesis}},
              is_narrow_{corners.is_narrow},
              clips_{state.depth.may_leave_range(triangle.geometry.depths(triangle.index))},
              least_{state.depth.least},
              greatest_{state.depth.greatest},
              depth_{corners} {}

        // Returns the codes; removes from `covered` the lanes outside the depth range.
        template <class Where>
        HWY_INLINE hn::Vec<U32> code_at(const Where& where, const Weights& edge, RowMask& covered) {
            const Corners e = edge_values(edge, all(area_));
            V64 v = depth_.value(e, weights_.at(e));
            if (HWY_UNLIKELY(!is_narrow_)) v = wide_at(where);
            if (HWY_UNLIKELY(clips_)) {
                const RowMask inside = mask_of(bits_of(hn::And(hn::Ge(v, all(least_)), hn::Le(v, all(greatest_)))));
                dropped_ += hn::CountTrue(F32{}, hn::AndNot(inside, covered));
                covered = hn::And(covered, inside);
            }
            return chip_codes<kind>(v, to_code_);
        }
        HWY_INLINE static std::uint32_t bits_of(Mask64 mask) {
            alignas(8) std::uint8_t bytes[8] = {};
            hn::StoreMaskBits(F64{}, mask, bytes);
            return bytes[0];
        }
        template <class Where>
        HWY_INLINE V64 wide_at(const Where& where) const {
            alignas(64) double values[row_lanes] = {};
            alignas(64) std::int32_t x[row_lanes], y[row_lanes];
            hn::Store(where.columns(), I32{}, x);
            hn::Store(where.rows(), I32{}, y);
            wide_window_z(geometry_, index_, PolygonOffset{offset_}, x, y, HWY_NAMESPACE::bits_of(where.covered),
                          values);
            return hn::Load(F64{}, values);
        }

        WindowZState& state_;
        std::uint32_t* const codes_;
        const std::int32_t spare_;
        const Geometry& geometry_;
        const std::uint32_t index_;
        const PolygonOffset offset_;
        const ChipConversion to_code_;
        const double area_;
        const TruncatedWeightsAt weights_;
        const bool is_narrow_, clips_;
        const double least_, greatest_;
        const WindowZAt depth_;
        std::size_t passed_ = 0, dropped_ = 0;
    };
};

template <CodeKind kind>
void draw(const Geometry& geometry, std::span<const std::uint32_t> triangles, const Rect& region, WindowZState& state) {
    RowWalk<WindowZOf<kind>::template Shade, WindowZState>{state, geometry, region}.draw(triangles);
}

DepthDrawn draw_window_z(const Geometry& geometry, std::span<const std::uint32_t> triangles, const ChipDepth& depth,
                         const Rect& region, std::uint32_t* codes) {
    WindowZState state{depth, codes, region.area(), {}};
    switch (depth.to_code.kind) {
        case CodeKind::d16f: draw<CodeKind::d16f>(geometry, triangles, region, state); break;
        case CodeKind::d24f: draw<CodeKind::d24f>(geometry, triangles, region, state); break;
        case CodeKind::fixed:
        case CodeKind::fixed_product:
        case CodeKind::fixed_truncated_product:
        case CodeKind::binary32: draw<CodeKind::fixed>(geometry, triangles, region, state); break;
    }
    return state.drawn;
}

}  // namespace
}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"
#include "rasterizer/values/depth/depth_scale.h"

namespace strata::rasterizer {
STRATA_EXPORT(draw_window_z);

DepthDrawn draw_window_z_rows(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                              const DepthRequest& depth, const Rect& region, std::uint32_t* codes) noexcept {
    const DepthScale scale = depth_scale(geometry, depth);
    return kernel_of(HWY_DISPATCH_TABLE(draw_window_z))(geometry, triangles, scale.chip, region, codes);
}

}  // namespace strata::rasterizer
#endif
