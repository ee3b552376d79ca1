// pipeline/stages/sum_rows_simd.cpp - add_sum_rows of sum_rows.h for instruction sets that convert halves. How kernels
// are written: rasterizer/reference/kernels.md. Tests: tests/peeling/execution/execution_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/stages/sum_rows_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/formats/half-inl.h"
#include "pipeline/stages/color_planes-inl.h"
#include "pipeline/stages/sum_rows.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

// State of a pass of sums over all its triangles: the planes, the conversion of depths to codes, the counts.
struct SumState {
    SumPlanes planes;
    rasterizer::DepthConversion<float> to_code;
    double z_units;
    rasterizer::DepthDrawn drawn{};
};

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2 && !defined(HWY_DISABLE_F16C)

// A word has two halves: two channels, or one and 0. A vector of Pair accordingly has twice as many lanes.
using Pair = hn::Twice<F32>;
using VPair = hn::Vec<Pair>;
using HalfPair = hn::Rebind<hwy::float16_t, Pair>;

constexpr std::int32_t lanes = hn::MaxLanes(F32{});
alignas(64) constexpr std::int32_t zipped[16] = {0, lanes,     1, lanes + 1, 2, lanes + 2, 3, lanes + 3,
                                                 4, lanes + 4, 5, lanes + 5, 6, lanes + 6, 7, lanes + 7};

// Interleaves the lanes of two channels in the order of a word's halves.
HWY_INLINE VPair paired(V32 low, V32 high) {
    return hn::TableLookupLanes(hn::Combine(Pair{}, high, low), hn::SetTableIndices(Pair{}, zipped));
}
// Loads words as pairs of binary32.
HWY_INLINE VPair loaded(const std::uint32_t* words) {
    return hn::PromoteTo(Pair{}, hn::BitCast(HalfPair{}, hn::LoadU(U32{}, words)));
}
// Rounds to nearest even and stores only the covered words.
HWY_INLINE void store(VPair sum, raster::RowMask covered, std::uint32_t* words) {
    hn::BlendedStore(hn::BitCast(U32{}, hn::DemoteTo(HalfPair{}, sum)), hn::RebindMask(U32{}, covered), U32{}, words);
}

// Sums stored as halves.
struct HalfSums {
    static HWY_INLINE void flush_negative(V32 (&source)[4], raster::RowMask covered, const SumPlanes& planes) {
        if (!planes.flushes) return;
        const F32 d;
        const hn::RebindToSigned<U32> integers;
        const auto signs = hn::Or(hn::Or(hn::BitCast(integers, source[0]), hn::BitCast(integers, source[1])),
                                  hn::Or(hn::BitCast(integers, source[2]), hn::BitCast(integers, source[3])));
        const auto negative = hn::RebindMask(d, hn::Lt(signs, hn::Zero(integers)));
        if (HWY_UNLIKELY(!hn::AllFalse(d, hn::And(covered, negative))))
            for (V32& v : source) v = flushed(U32{}, v);
    }

    // Adds `source` to the stored sums, per channel, like sum_of_halves of stages_simd.cpp; stores the covered lanes.
    // Two steps of sum_of_halves matter only if a source is negative (a positive denormal and +0 give the same half,
    // whatever they are added to) or a sum is NaN, so they are done only for rows that have one.
    static HWY_INLINE void add(V32 (&source)[4], raster::RowMask covered, const SumPlanes& planes, std::size_t pixel) {
        flush_negative(source, covered, planes);
        VPair low = hn::Add(paired(source[0], source[1]), loaded(planes.sums[0] + pixel));
        VPair high = hn::Add(paired(source[2], source[3]), loaded(planes.sums[1] + pixel));
        // One test for both: NaN if either sum is NaN, and if infinities of both signs are added.
        const VPair both = hn::Add(low, high);
        if (HWY_UNLIKELY(!hn::AllTrue(Pair{}, hn::Eq(both, both)))) {
            for (VPair* v : {&low, &high}) *v = canonical(hn::RebindToUnsigned<Pair>{}, *v);
        }
        store(low, covered, planes.sums[0] + pixel);
        store(high, covered, planes.sums[1] + pixel);
    }

    // Adds one to the count in the low half of each word. NaN is handled as above.
    static HWY_INLINE void count(raster::RowMask covered, const SumPlanes& planes, std::size_t pixel) {
        const F32 d;
        std::uint32_t* const words = planes.count + pixel;
        V32 sum = hn::Add(half_values(U32{}, hn::LoadU(U32{}, words)), hn::Set(d, 1.0f));
        if (HWY_UNLIKELY(!hn::AllTrue(d, hn::Eq(sum, sum)))) sum = canonical(U32{}, sum);
        hn::BlendedStore(half_codes(U32{}, sum), hn::RebindMask(U32{}, covered), U32{}, words);
    }
};

// Sums stored in separate words: combine<add> of blend_float.h on each.
struct FloatSums {
    static HWY_INLINE void add_to(V32 source, raster::RowMask covered, bool flushes, std::uint32_t* words) {
        const U32 d;
        V32 stored = hn::BitCast(F32{}, hn::LoadU(d, words));
        if (flushes) source = flushed(d, source), stored = flushed(d, stored);
        V32 sum = hn::Add(source, stored);
        if (flushes) sum = flushed(d, sum);
        hn::BlendedStore(hn::BitCast(d, canonical(d, sum)), hn::RebindMask(d, covered), d, words);
    }
    static HWY_INLINE void add(V32 (&source)[4], raster::RowMask covered, const SumPlanes& planes, std::size_t pixel) {
        for (std::size_t c = 0; c < 4; ++c) add_to(source[c], covered, planes.flushes, planes.sums[c] + pixel);
    }
    static HWY_INLINE void count(raster::RowMask covered, const SumPlanes& planes, std::size_t pixel) {
        add_to(hn::Set(F32{}, 1.0f), covered, planes.flushes, planes.count + pixel);
    }
};

template <bool is_tested, class Sums>
struct SumOf {
    // The planes of one triangle. is_tested is a constant of the pass; without a test no depth is computed.
    template <bool unsnapped>
    class Shade {
      public:
        HWY_INLINE Shade(SumState& state, const DrawnTriangle& triangle)
            : state_{state}, planes_{state.planes}, to_code_{state.to_code}, triangle_{triangle}, color_{triangle} {
            // Without opaque surfaces there is no test, and the plane of depth is not needed.
            if constexpr (!is_tested) return;
            depth_ = RationalPlane{triangle.geometry.depths(triangle.index), 1.0, state.z_units};
            filter_ = raster::filter_of(depth_, triangle);
        }

        HWY_INLINE void operator()(const raster::Row& row, const raster::Weights& b) {
            raster::RowMask covered = row.covered;
            if constexpr (is_tested) {
                covered = hn::And(covered, nearer(row, b));
                // A row that is completely behind the opaque surfaces needs no colours.
                if (hn::AllFalse(F32{}, covered)) return;
                passed_ += hn::CountTrue(F32{}, covered);
            }
            V32 color[4];
            color_.template at<unsnapped>(row, b, color);
            for (std::size_t c = 0; c < 3; ++c) color[c] = hn::Mul(color[c], color[3]);
            Sums::add(color, covered, planes_, row.pixel);
            if (planes_.count != nullptr) Sums::count(covered, planes_, row.pixel);
        }
        HWY_INLINE void finish(std::uint64_t pixels) {
            state_.drawn.fragments += pixels;
            state_.drawn.passed += is_tested ? passed_ : pixels;
        }

      private:
        HWY_INLINE raster::RowMask nearer(const raster::Row& row, const raster::Weights& b) const {
            const V32 z =
                raster::rounded_plane<unsnapped>(filter_, b, depth_, triangle_.geometry, triangle_.index, row);
            return raster::nearer(raster::codes(z, to_code_), hn::LoadU(U32{}, planes_.opaque + row.pixel),
                                  to_code_.is_fixed());
        }

        SumState& state_;
        const SumPlanes planes_;
        const rasterizer::DepthConversion<float> to_code_;
        const DrawnTriangle& triangle_;
        const ColorPlanes color_;
        RationalPlane depth_;
        FilterPlane filter_;
        std::uint64_t passed_ = 0;
    };
};

void add_all(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles,
             const rasterizer::Rect& region, SumState& state) {
    const auto add_to = [&]<class Sums>(Sums) {
        const auto draw = [&]<bool is_tested>(std::bool_constant<is_tested>) {
            raster::RowWalk<SumOf<is_tested, Sums>::template Shade, SumState>{state, geometry, region}.draw(triangles);
        };
        state.planes.opaque == nullptr ? draw(std::false_type{}) : draw(std::true_type{});
    };
    state.planes.words == SumWords::halves ? add_to(HalfSums{}) : add_to(FloatSums{});
}

#else

void add_all(const rasterizer::Geometry&, std::span<const std::uint32_t>, const rasterizer::Rect&, SumState&) {}

#endif

rasterizer::DepthDrawn add_rows(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles,
                                const rasterizer::Rect& region, const rasterizer::DepthConversion<float>& to_code,
                                double units, const SumPlanes& planes) {
    SumState state{planes, to_code, units};
    add_all(geometry, triangles, region, state);
    return state.drawn;
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"
#include "rasterizer/values/depth/depth_scale.h"

namespace strata::pipeline {
STRATA_EXPORT(add_rows);

rasterizer::DepthDrawn add_sum_rows(const rasterizer::Geometry& geometry, std::span<const std::uint32_t> triangles,
                                    const rasterizer::DepthRequest& depth, const rasterizer::Rect& region,
                                    const SumPlanes& planes) noexcept {
    const rasterizer::DepthScale scale = depth_scale(geometry, depth);
    return kernel_of(HWY_DISPATCH_TABLE(add_rows))(geometry, triangles, region, scale.to_code, scale.z_units, planes);
}

}  // namespace strata::pipeline
#endif
