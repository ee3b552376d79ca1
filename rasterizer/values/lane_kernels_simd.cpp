// rasterizer/values/lane_kernels_simd.cpp - the kernels of lane_kernels.h, compiled once per instruction set; that
// header defines their meaning. How kernels are written: rasterizer/reference/kernels.md. Tests:
// tests/rasterizer/walk/tile_rasterizer_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/values/lane_kernels_simd.cpp"
#include <bit>
#include <cstring>

#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
#include "rasterizer/values/weights-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A block of 16 pixels, or as many as the widest vector has lanes of 32 bits.
using Row32 = hn::CappedTag<std::int32_t, 16>;
using Row16 = hn::Rebind<std::uint16_t, Row32>;

alignas(64) constexpr std::int32_t counting32[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
alignas(64) constexpr std::uint16_t counting16[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

// Writes `count` pixels of a row, starting at lane `held`.
struct AppendRow {
    void operator()(FragmentBatch& batch, int held, int count, std::uint32_t pixel, int x, int y,
                    std::uint32_t primitive) const {
        const Row32 d;
        const Row16 d16;
        auto pixels = hn::Add(hn::LoadU(d, counting32), hn::Set(d, static_cast<std::int32_t>(pixel)));
        auto xs = hn::Add(hn::LoadU(d16, counting16), hn::Set(d16, static_cast<std::uint16_t>(x)));
        const int step = static_cast<int>(hn::Lanes(d)), end = held + count;
        for (int i = held; i < end; i += step) {
            const auto at = static_cast<std::size_t>(i);
            hn::StoreU(pixels, d, reinterpret_cast<std::int32_t*>(&batch.pixel[at]));
            hn::StoreU(xs, d16, &batch.x[at]);
            hn::StoreU(hn::Set(d16, static_cast<std::uint16_t>(y)), d16, &batch.y[at]);
            hn::StoreU(hn::Set(d, static_cast<std::int32_t>(primitive)), d,
                       reinterpret_cast<std::int32_t*>(&batch.primitive[at]));
            pixels = hn::Add(pixels, hn::Set(d, step));
            xs = hn::Add(xs, hn::Set(d16, static_cast<std::uint16_t>(step)));
        }
    }
};

// The walk is that of the scalar reference; it and the functions it calls are compiled here for this instruction set.
[[gnu::flatten]] bool emit(const RowSpan* spans, RowRun& run, PixelClaims& claims, FragmentBatch& batch) noexcept {
    const auto span_of = [&](int row) HWY_ATTR { return spans[row]; };
    return scalar::emit_rows(run, claims, batch, span_of, AppendRow{});
}

template <bool unsnapped>
HWY_INLINE void weights_of(const PixelWeights& w, const std::uint16_t* x, const std::uint16_t* y, int count,
                           double* HWY_RESTRICT b1, double* HWY_RESTRICT b2) {
    const F64 d;
    const WeightsAt<unsnapped> at{w};
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
        const Weights b = at.lanes(x + i, y + i);
        hn::StoreU(b.b1, d, b1 + i);
        hn::StoreU(b.b2, d, b2 + i);
    }
}

void weights(const PixelWeights& w, const std::uint16_t* x, const std::uint16_t* y, int count, double* b1,
             double* b2) noexcept {
    if (w.kind == PixelWeights::Kind::unsnapped) return weights_of<true>(w, x, y, count, b1, b2);
    weights_of<false>(w, x, y, count, b1, b2);
}

// The planes are filtered together, so each vector of weights is loaded once; `unsure` accumulates over all planes.
template <bool exact>
HWY_INLINE bool attributes_of(const AttributeLanes& a, const TriangleLanes& lanes) {
    const F64 d;
    FilterPlane planes[attribute_count + 1];
    for (std::size_t k = 0; k < a.count; ++k) planes[k] = FilterPlane{a.plane[k], lanes.reach};
    planes[a.count] = FilterPlane{a.inverse_w, lanes.reach};
    auto unsure = hn::Zero(U32{});
    const auto value = [&](const FilterPlane& plane, const Weights& b) HWY_ATTR {
        const V64 v = plane_at(plane, b);
        return exact ? rounded(v, hn::Set(d, plane.error), unsure) : hn::DemoteTo(F32{}, v);
    };
    for (int i = 0; i < lanes.count; i += static_cast<int>(hn::Lanes(d))) {
        const Weights b{hn::LoadU(d, lanes.weight1 + i), hn::LoadU(d, lanes.weight2 + i)};
        const V32 inverse_w = a.has_w ? value(planes[a.count], b) : hn::Set(F32{}, 1.0f);
        for (std::size_t k = 0; k < a.count; ++k) {
            const V32 u = value(planes[k], b);
            hn::StoreU(a.has_w ? hn::Div(u, inverse_w) : u, F32{}, a.out[k] + i);
        }
    }
    return exact && !hn::AllTrue(U32{}, hn::Eq(unsure, hn::Zero(U32{})));
}

void fill(float value, int count, float* out) {
    using Wide = hn::CappedTag<float, 16>;
    const auto v = hn::Set(Wide{}, value);
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(Wide{}))) hn::StoreU(v, Wide{}, out + i);
}

bool attributes(const AttributeLanes& a, const TriangleLanes& lanes) noexcept {
    for (std::size_t k = 0; k < a.constant_count; ++k) fill(a.constant[k].value, lanes.count, a.constant[k].out);
    if (a.count == 0) return false;
    return lanes.reach > 0.0 ? attributes_of<true>(a, lanes) : attributes_of<false>(a, lanes);
}

template <bool unsnapped, bool by_rows>
HWY_INLINE bool depth_of(const PixelWeights& w, const FilterPlane& plane, const std::uint16_t* x,
                         const std::uint16_t* y, int count, const DepthLanes& out) {
    const F64 d;
    const int step = static_cast<int>(hn::Lanes(d));
    const WeightsAt<unsnapped> at{w};
    Weights terms{hn::Zero(d), hn::Zero(d)};
    int row = -1;
    auto unsure = hn::Zero(U32{});
    for (int i = 0; i < count; i += step) {
        // Most vectors of a large triangle are within one row and share the terms that depend on y with the previous
        // vector.
        const bool in_row = by_rows && i + step <= count && y[i] == y[i + step - 1];
        if (in_row && y[i] != row) {
            row = y[i];
            terms = at.row_terms(row);
        }
        const Weights b = in_row ? at.at(at.column_terms(numbers_from(x[i])), terms) : at.lanes(x + i, y + i);
        const V64 v = plane_at(plane, b);
        auto different = hn::Zero(U32{});
        // Lanes past the count hold pixels outside the triangle. If they are not certain, the only cost is time.
        const V32 z = unsnapped ? hn::DemoteTo(F32{}, v) : rounded(v, hn::Set(d, plane.error), different);
        unsure = hn::Or(unsure, different);
        if (out.shader_z != nullptr) hn::StoreU(z, F32{}, out.shader_z + i);
        if (out.code != nullptr) hn::StoreU(codes(z, out.to_code), U32{}, out.code + i);
        if (out.b1 == nullptr) continue;
        hn::StoreU(b.b1, d, out.b1 + i);
        hn::StoreU(b.b2, d, out.b2 + i);
    }
    return !unsnapped && !hn::AllTrue(U32{}, hn::Eq(unsure, hn::Zero(U32{})));
}

bool depth(const PixelWeights& w, const FilterPlane& plane, const std::uint16_t* x, const std::uint16_t* y, int count,
           const DepthLanes& out) noexcept {
    // In batches of few fragments hardly any vector is within one row.
    const bool by_rows = count >= 64;
    if (w.kind == PixelWeights::Kind::unsnapped)
        return by_rows ? depth_of<true, true>(w, plane, x, y, count, out)
                       : depth_of<true, false>(w, plane, x, y, count, out);
    return by_rows ? depth_of<false, true>(w, plane, x, y, count, out)
                   : depth_of<false, false>(w, plane, x, y, count, out);
}

#if HWY_NATIVE_FMA
using Wide = hn::CappedTag<float, 16>;
using WideVec = hn::Vec<Wide>;

// Numbers below 2^-126 become zeros of the same sign.
HWY_INLINE WideVec flushed(WideVec v) {
    const Wide d;
    return hn::IfThenElse(hn::Lt(hn::Abs(v), hn::Set(d, 0x1p-126f)), hn::And(v, hn::SignBit(d)), v);
}

struct WidePlane {
    WideVec origin, dx, dy, right, down;
    const FloatPlane& plane;
    HWY_INLINE explicit WidePlane(const FloatPlane& p)
        : origin{hn::Set(Wide{}, p.origin)},
          dx{hn::Set(Wide{}, p.dx)},
          dy{hn::Set(Wide{}, p.dy)},
          right{hn::Set(Wide{}, p.right)},
          down{hn::Set(Wide{}, p.down)},
          plane{p} {}

    template <PlaneRule rule>
    HWY_INLINE WideVec at(hn::Vec<hn::RebindToSigned<Wide>> x, hn::Vec<hn::RebindToSigned<Wide>> y) const {
        const Wide d;
        const hn::RebindToSigned<Wide> di;
        // The instruction set has a fused multiply-add, rounded once as in the scalar reference.
        if constexpr (rule == PlaneRule::reciprocal_area_fused)
            return hn::MulAdd(dy, across(y, down), hn::MulAdd(dx, across(x, right), origin));
        if constexpr (rule == PlaneRule::greatest_w) {
            const WideVec counted = hn::Mul(hn::Set(d, plane.row_step), across(y, down));  // exact
            const WideVec row = hn::Sub(hn::Add(hn::Set(d, plane.row_base), counted), hn::Set(d, plane.y0));
            const WideVec column = hn::Sub(across(x, right), hn::Set(d, plane.x0));
            const WideVec below = flushed(hn::Add(origin, flushed(hn::Mul(row, dy))));
            return flushed(hn::Add(flushed(hn::Mul(column, dx)), below));
        }
        if constexpr (rule == PlaneRule::reciprocal_area)
            return hn::Add(hn::Add(hn::Mul(dx, across(x, right)), origin), hn::Mul(dy, across(y, down)));
        const auto one = hn::Set(di, 1), odd_x = hn::And(x, one), odd_y = hn::And(y, one);
        const auto even_x = hn::ConvertTo(d, hn::Sub(x, odd_x)), even_y = hn::ConvertTo(d, hn::Sub(y, odd_y));
        const WideVec corner = hn::Add(hn::Add(origin, hn::Mul(dx, even_x)), hn::Mul(dy, even_y));
        const WideVec stepped = hn::IfThenElse(hn::RebindMask(d, hn::Eq(odd_x, one)), hn::Add(corner, dx), corner);
        return hn::IfThenElse(hn::RebindMask(d, hn::Eq(odd_y, one)), hn::Add(stepped, dy), stepped);
    }

  private:
    // Pixel coordinate plus the sample's offset: exact.
    HWY_INLINE static WideVec across(hn::Vec<hn::RebindToSigned<Wide>> pixel, WideVec sample) {
        return hn::Add(hn::ConvertTo(Wide{}, pixel), sample);
    }
};

template <PlaneRule rule>
HWY_INLINE void float_plane_of(const FloatPlane& plane, const std::uint16_t* x, const std::uint16_t* y, int count,
                               float* HWY_RESTRICT out) {
    const hn::RebindToSigned<Wide> di;
    const hn::Rebind<std::uint16_t, Wide> narrow;
    const WidePlane at{plane};
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(Wide{}))) {
        const auto column = hn::PromoteTo(di, hn::LoadU(narrow, x + i)),
                   row = hn::PromoteTo(di, hn::LoadU(narrow, y + i));
        hn::StoreU(at.at<rule>(column, row), Wide{}, out + i);
    }
}

void float_plane(PlaneRule rule, const FloatPlane& plane, const std::uint16_t* x, const std::uint16_t* y, int count,
                 float* out) noexcept {
    switch (rule) {
        case PlaneRule::reciprocal_area: return float_plane_of<PlaneRule::reciprocal_area>(plane, x, y, count, out);
        case PlaneRule::least_corner: return float_plane_of<PlaneRule::least_corner>(plane, x, y, count, out);
        case PlaneRule::greatest_w: return float_plane_of<PlaneRule::greatest_w>(plane, x, y, count, out);
        case PlaneRule::reciprocal_area_fused:
        case PlaneRule::exact: break;
    }
    float_plane_of<PlaneRule::reciprocal_area_fused>(plane, x, y, count, out);
}

template <PlaneRule rule>
HWY_INLINE void float_attributes_of(const FloatAttributeLanes& a, const std::uint16_t* x, const std::uint16_t* y,
                                    int count) {
    const hn::RebindToSigned<Wide> di;
    const hn::Rebind<std::uint16_t, Wide> narrow;
    const bool multiplies = a.perspective == PerspectiveDivide::reciprocal;
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(Wide{}))) {
        const auto column = hn::PromoteTo(di, hn::LoadU(narrow, x + i)),
                   row = hn::PromoteTo(di, hn::LoadU(narrow, y + i));
        const WideVec inverse_w = WidePlane{a.inverse_w}.at<rule>(column, row);
        constexpr bool flushes = rule == PlaneRule::greatest_w;
        const WideVec reciprocal = hn::Div(hn::Set(Wide{}, 1.0f), inverse_w);
        const WideVec by = !multiplies ? inverse_w : flushes ? flushed(reciprocal) : reciprocal;
        for (std::size_t k = 0; k < a.count; ++k) {
            const WideVec value = WidePlane{a.plane[k]}.at<rule>(column, row);
            const WideVec divided = multiplies ? hn::Mul(value, by) : hn::Div(value, by);
            hn::StoreU(flushes ? flushed(divided) : divided, Wide{}, a.out[k] + i);
        }
    }
}

void float_attributes(const FloatAttributeLanes& a, const std::uint16_t* x, const std::uint16_t* y,
                      int count) noexcept {
    switch (a.rule) {
        case PlaneRule::reciprocal_area: return float_attributes_of<PlaneRule::reciprocal_area>(a, x, y, count);
        case PlaneRule::least_corner: return float_attributes_of<PlaneRule::least_corner>(a, x, y, count);
        case PlaneRule::greatest_w: return float_attributes_of<PlaneRule::greatest_w>(a, x, y, count);
        case PlaneRule::reciprocal_area_fused:
        case PlaneRule::exact: break;
    }
    float_attributes_of<PlaneRule::reciprocal_area_fused>(a, x, y, count);
}
#else
// Without a fused multiply-add the scalar reference's exact emulation is used.
void float_plane(PlaneRule rule, const FloatPlane& plane, const std::uint16_t* x, const std::uint16_t* y, int count,
                 float* out) noexcept {
    scalar::float_plane(rule, plane, x, y, count, out);
}
void float_attributes(const FloatAttributeLanes& a, const std::uint16_t* x, const std::uint16_t* y,
                      int count) noexcept {
    scalar::float_attributes(a, x, y, count);
}
#endif

const LaneKernels* table() {
    static constexpr LaneKernels kernels{emit, weights, attributes, depth, float_plane, float_attributes};
    return &kernels;
}

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::rasterizer {
STRATA_EXPORT(table);

inline namespace strict {

const LaneKernels& lane_kernels() noexcept {
    static constexpr LaneKernels scalar_reference{scalar::emit, scalar::weights,     scalar::attributes,
                                                  nullptr,      scalar::float_plane, scalar::float_attributes};
    return simd_is_scalar() ? scalar_reference : *kernel_of(HWY_DISPATCH_TABLE(table))();
}

}  // namespace strict
}  // namespace strata::rasterizer
#endif
