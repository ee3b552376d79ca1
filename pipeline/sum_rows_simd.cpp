// pipeline/sum_rows_simd.cpp - add_sum_rows of sum_rows.h for the sets that convert halves.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/sum_rows_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "pipeline/color_planes-inl.h"
#include "pipeline/sum_rows.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

struct SumState {
    SumPlanes planes;
    rasterizer::DepthConversion to_code;
    double z_units;
    rasterizer::DepthDrawn drawn{};
};

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2 && !defined(HWY_DISABLE_F16C)

using Code16 = raster::U16;
using Half16 = hn::Rebind<hwy::float16_t, F32>;

HWY_INLINE V32 widened(const std::uint16_t* halves) {
    return hn::PromoteTo(F32{}, hn::BitCast(Half16{}, hn::LoadU(Code16{}, halves)));
}

// A denormal as the zero of its sign.
HWY_INLINE V32 flushed(V32 v) {
    const auto bits = hn::BitCast(U32{}, v);
    const auto is_small = hn::Eq(hn::And(bits, hn::Set(U32{}, 0x7f800000u)), hn::Zero(U32{}));
    return hn::BitCast(F32{}, hn::IfThenElse(is_small, hn::And(bits, hn::Set(U32{}, 0x80000000u)), bits));
}

// Adds `source` to what is stored, channel by channel, as sum_of_halves of stages_simd.cpp adds; stores the covered lanes. Two
// of its steps show only where a source is negative (a positive denormal and its zero become the same half, whatever they are
// added to) or a sum is NaN: they are done for rows that have one.
template <bool flushes, std::size_t channels>
HWY_INLINE void add(V32 (&source)[channels], raster::RowMask covered, std::uint16_t* const (&halves)[channels]) {
    const F32 d;
    if constexpr (flushes) {
        auto signs = hn::BitCast(hn::RebindToSigned<U32>{}, source[0]);
        for (std::size_t c = 1; c < channels; ++c)
            signs = hn::Or(signs, hn::BitCast(hn::RebindToSigned<U32>{}, source[c]));
        const auto negative = hn::RebindMask(d, hn::Lt(signs, hn::Zero(hn::RebindToSigned<U32>{})));
        if (HWY_UNLIKELY(!hn::AllFalse(d, hn::And(covered, negative))))
            for (V32& v : source) v = flushed(v);
    }
    V32 sum[channels];
    auto number = hn::Eq(source[0], source[0]);
    for (std::size_t c = 0; c < channels; ++c) {
        sum[c] = hn::Add(source[c], widened(halves[c]));
        number = hn::And(number, hn::Eq(sum[c], sum[c]));
    }
    if (HWY_UNLIKELY(!hn::AllFalse(d, hn::AndNot(number, covered)))) {
        const V32 nan = hn::BitCast(d, hn::Set(U32{}, 0x7fffffffu));
        for (V32& v : sum) v = hn::IfThenElse(hn::Eq(v, v), v, nan);
    }
    alignas(8) std::uint8_t bits[8] = {static_cast<std::uint8_t>(raster::bits_of(covered))};
    const auto lanes = hn::LoadMaskBits(Code16{}, bits);
    for (std::size_t c = 0; c < channels; ++c)
        hn::BlendedStore(hn::BitCast(Code16{}, hn::DemoteTo(Half16{}, sum[c])), lanes, Code16{}, halves[c]);
}

template <bool is_tested, bool flushes>
struct SumOf {
    template <bool unsnapped>
    class Shade {
      public:
        HWY_INLINE Shade(SumState& state, const DrawnTriangle& triangle)
            : state_{state}, planes_{state.planes}, to_code_{state.to_code}, triangle_{triangle}, color_{triangle} {
            if constexpr (!is_tested) return;
            depth_ = RationalPlane{triangle.geometry.depths(triangle.index), 1.0, state.z_units};
            filter_ = raster::filter_of(depth_, triangle);
        }

        HWY_INLINE void operator()(const raster::Row& row, const raster::Weights& b) {
            raster::RowMask covered = row.covered;
            if constexpr (is_tested) {
                covered = hn::And(covered, nearer(row, b));
                if (hn::AllFalse(F32{}, covered)) return;
                passed_ += hn::CountTrue(F32{}, covered);
            }
            V32 color[4];
            color_.template at<unsnapped>(row, b, color);
            for (std::size_t c = 0; c < 3; ++c) color[c] = hn::Mul(color[c], color[3]);
            const auto& sums = planes_.sums;
            add<flushes>(color, covered, {sums[0] + row.pixel, sums[1] + row.pixel, sums[2] + row.pixel, sums[3] + row.pixel});
            if (planes_.count == nullptr) return;
            V32 one[1] = {hn::Set(F32{}, 1.0f)};
            add<false>(one, covered, {planes_.count + row.pixel});
        }
        HWY_INLINE void finish(std::uint64_t pixels) {
            state_.drawn.fragments += pixels;
            state_.drawn.passed += is_tested ? passed_ : pixels;
        }

      private:
        HWY_INLINE raster::RowMask nearer(const raster::Row& row, const raster::Weights& b) const {
            const auto v = raster::plane_at(filter_, b);
            auto unsure = hn::Zero(U32{});
            V32 z = unsnapped ? hn::DemoteTo(F32{}, v) : raster::rounded(v, hn::Set(F64{}, filter_.error), unsure);
            if constexpr (!unsnapped)
                z = raster::decided(z, unsure, depth_, triangle_.geometry, triangle_.index, row);
            return raster::nearer(raster::codes(z, to_code_), hn::LoadU(U32{}, planes_.opaque + row.pixel), to_code_.is_fixed);
        }

        SumState& state_;
        const SumPlanes planes_;
        const rasterizer::DepthConversion to_code_;
        const DrawnTriangle& triangle_;
        const ColorPlanes color_;
        RationalPlane depth_;
        FilterPlane filter_;
        std::uint64_t passed_ = 0;
    };
};

template <bool is_tested, bool flushes>
void add_all(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles, const rasterizer::Rect& region,
             SumState& state) {
    raster::RowWalk<SumOf<is_tested, flushes>::template Shade, SumState>{state, geometry, region}.draw(triangles);
}

#else

template <bool is_tested, bool flushes>
void add_all(const rasterizer::Geometry&, std::span<const std::uint32_t>, const rasterizer::Rect&, SumState&) {}

#endif

rasterizer::DepthDrawn add_rows(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles,
                                const rasterizer::Rect& region, const rasterizer::DepthConversion& to_code, double units,
                                const SumPlanes& planes, bool flushes) {
    SumState state{planes, to_code, units};
    if (planes.opaque == nullptr && flushes) add_all<false, true>(geometry, triangles, region, state);
    if (planes.opaque == nullptr && !flushes) add_all<false, false>(geometry, triangles, region, state);
    if (planes.opaque != nullptr && flushes) add_all<true, true>(geometry, triangles, region, state);
    if (planes.opaque != nullptr && !flushes) add_all<true, false>(geometry, triangles, region, state);
    return state.drawn;
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/window.h"

namespace strata::pipeline {
HWY_EXPORT(add_rows);

rasterizer::DepthDrawn add_sum_rows(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles,
                                    const rasterizer::DepthRequest& depth, const rasterizer::Rect& region,
                                    const SumPlanes& planes, bool flushes) noexcept {
    const rasterizer::FragmentValues values{geometry, depth, {.shader_z = false, .code = true, .color = false}};
    return HWY_DYNAMIC_DISPATCH(add_rows)(geometry, triangles, region, values.to_code(),
                                          z_units(geometry.state, geometry.rules), planes, flushes);
}

}  // namespace strata::pipeline
#endif
