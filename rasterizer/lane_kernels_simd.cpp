// rasterizer/lane_kernels_simd.cpp - the kernels of lane_kernels.h for every instruction set; their meaning stands there.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/lane_kernels_simd.cpp"
#include <bit>
#include <cstring>

#include "hwy/foreach_target.h"  // compiles this file once a target
#include "hwy/highway.h"
#include "rasterizer/lane_kernels.h"
#include "rasterizer/simd.h"

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::ScalableTag<double>;  // as many lanes of everything else as of binary64
using F32 = hn::Rebind<float, F64>;
using I32 = hn::Rebind<std::int32_t, F64>;
using U32 = hn::Rebind<std::uint32_t, F64>;
using U16 = hn::Rebind<std::uint16_t, F64>;
using V64 = hn::Vec<F64>;
using V32 = hn::Vec<F32>;

// A block of 16 pixels, or as many of them as the widest vector has lanes of 32 bits.
using Row32 = hn::CappedTag<std::int32_t, 16>;
using Row16 = hn::Rebind<std::uint16_t, Row32>;

// hn::Iota goes through the stack, and waits for it.
alignas(64) constexpr std::int32_t counting32[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
alignas(64) constexpr double counting64[8] = {0, 1, 2, 3, 4, 5, 6, 7};
alignas(64) constexpr std::uint16_t counting16[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

// Writes `count` pixels of a row from lane `held` on.
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

// The walk is the twins'; it and what it calls are compiled here for this set.
[[gnu::flatten]] bool emit(const RowSpan* spans, RowRun& run, PixelClaims& claims, FragmentBatch& batch) noexcept {
    const auto span_of = [&](int row) HWY_ATTR { return spans[row]; };
    return scalar::emit_rows(run, claims, batch, span_of, AppendRow{});
}

// Pixel coordinates as binary64.
HWY_INLINE V64 coordinates(const std::uint16_t* p) {
    return hn::PromoteTo(F64{}, hn::PromoteTo(I32{}, hn::LoadU(U16{}, p)));
}

struct Weights {
    V64 b1, b2;
};

// The weights of a kind, lanes of any rows or of one. What is the same in all lanes is hoisted by the compiler.
template <bool unsnapped>
class WeightsAt {
  public:
    HWY_INLINE explicit WeightsAt(const PixelWeights& w) : w_{w} {}

    HWY_INLINE Weights lanes(const std::uint16_t* x, const std::uint16_t* y) const {
        return at(coordinates(x), row_terms(coordinates(y)));
    }
    // The pixels from (x, y) on; `terms` are those of row y.
    HWY_INLINE Weights row(int x, const Weights& terms) const {
        return at(hn::Add(hn::Set(F64{}, static_cast<double>(x)), hn::Load(F64{}, counting64)), terms);
    }
    // What depends on y alone.
    HWY_INLINE Weights row_terms(V64 y) const {
        if constexpr (unsnapped) {
            const V64 dy = hn::Sub(hn::Add(y, set(0.5)), set(w_.y0));
            return {hn::Mul(dy, set(w_.x2)), hn::Mul(dy, set(w_.x1))};
        } else {
            return {hn::Mul(y, set(w_.e1.step_y)), hn::Mul(y, set(w_.e2.step_y))};
        }
    }

  private:
    [[nodiscard]] HWY_INLINE static V64 set(double v) { return hn::Set(F64{}, v); }
    HWY_INLINE Weights at(V64 x, const Weights& terms) const {
        if constexpr (unsnapped) {
            const V64 dx = hn::Sub(hn::Add(x, set(0.5)), set(w_.x0));
            return {hn::Mul(hn::Sub(hn::Mul(dx, set(w_.y2)), terms.b1), set(w_.r)),
                    hn::Mul(hn::Sub(terms.b2, hn::Mul(dx, set(w_.y1))), set(w_.r))};
        } else {
            const V64 e1 = hn::Add(hn::Add(hn::Mul(x, set(w_.e1.step_x)), terms.b1), set(w_.e1.constant));
            const V64 e2 = hn::Add(hn::Add(hn::Mul(x, set(w_.e2.step_x)), terms.b2), set(w_.e2.constant));
            return {hn::Mul(e1, set(w_.r)), hn::Mul(e2, set(w_.r))};
        }
    }
    const PixelWeights w_;
};

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

HWY_INLINE V64 plane_at(const FilterPlane& p, const Weights& b) {
    const F64 d;
    return hn::Add(hn::Set(d, p.w0), hn::Add(hn::Mul(b.b1, hn::Set(d, p.d1)), hn::Mul(b.b2, hn::Set(d, p.d2))));
}

// Low end of the filter's interval, rounded; `unsure` gathers the bits in which the high end differs.
HWY_INLINE V32 rounded(V64 v, V64 error, hn::Vec<U32>& unsure) {
    const V32 low = hn::DemoteTo(F32{}, hn::Sub(v, error)), high = hn::DemoteTo(F32{}, hn::Add(v, error));
    unsure = hn::Or(unsure, hn::Xor(hn::BitCast(U32{}, low), hn::BitCast(U32{}, high)));
    return low;
}

template <bool exact>
HWY_INLINE bool attributes_of(const AttributeLanes& a, const TriangleLanes& lanes) {
    const F64 d;
    FilterPlane planes[attribute_count + 1];
    for (std::size_t k = 0; k < a.count; ++k) planes[k] = FilterPlane{a.plane[k], exact};
    planes[a.count] = FilterPlane{a.inverse_w, exact};
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
    return lanes.is_exact ? attributes_of<true>(a, lanes) : attributes_of<false>(a, lanes);
}

HWY_INLINE hn::Vec<U32> codes(V32 z, const DepthLanes& out) {
    const F32 d;
    const V32 least = hn::Set(d, out.least), greatest = hn::Set(d, out.greatest);
    const V32 above = hn::IfThenElse(hn::Gt(z, least), z, least);  // as the twin: NaN and -0 become `least`
    const V32 clamped = hn::IfThenElse(hn::Lt(above, greatest), above, greatest);
    if (!out.is_fixed) return hn::BitCast(U32{}, clamped);
    const F64 d64;
    const V64 scaled = hn::Mul(hn::PromoteTo(d64, clamped), hn::Set(d64, out.max));
    return hn::BitCast(U32{}, hn::DemoteTo(I32{}, hn::Add(scaled, hn::Set(d64, out.half))));
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
        // A vector within a row, as most of a large triangle are, shares what depends on y with the one before.
        const bool in_row = by_rows && i + step <= count && y[i] == y[i + step - 1];
        if (in_row && y[i] != row) {
            row = y[i];
            terms = at.row_terms(hn::Set(d, static_cast<double>(row)));
        }
        const Weights b = in_row ? at.row(x[i], terms) : at.lanes(x + i, y + i);
        const V64 v = plane_at(plane, b);
        auto different = hn::Zero(U32{});
        // The lanes beyond the count hold pixels of no triangle: they may be unsure for nothing, and cost time alone.
        const V32 z = unsnapped ? hn::DemoteTo(F32{}, v) : rounded(v, hn::Set(d, plane.error), different);
        unsure = hn::Or(unsure, different);
        if (out.shader_z != nullptr) hn::StoreU(z, F32{}, out.shader_z + i);
        if (out.code != nullptr) hn::StoreU(codes(z, out), U32{}, out.code + i);
        if (out.b1 == nullptr) continue;
        hn::StoreU(b.b1, d, out.b1 + i);
        hn::StoreU(b.b2, d, out.b2 + i);
    }
    return !unsnapped && !hn::AllTrue(U32{}, hn::Eq(unsure, hn::Zero(U32{})));
}

bool depth(const PixelWeights& w, const FilterPlane& plane, const std::uint16_t* x, const std::uint16_t* y, int count,
           const DepthLanes& out) noexcept {
    const bool by_rows = count >= 64;
    if (w.kind == PixelWeights::Kind::unsnapped)
        return by_rows ? depth_of<true, true>(w, plane, x, y, count, out)
                       : depth_of<true, false>(w, plane, x, y, count, out);
    return by_rows ? depth_of<false, true>(w, plane, x, y, count, out)
                   : depth_of<false, false>(w, plane, x, y, count, out);
}

const LaneKernels* table() {
    static constexpr LaneKernels kernels{emit, weights, attributes, depth};
    return &kernels;
}

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::rasterizer {
HWY_EXPORT(table);

inline namespace strict {

const LaneKernels& lane_kernels() noexcept {
    static constexpr LaneKernels twins{scalar::emit, scalar::weights, scalar::attributes, nullptr};
    return simd_is_scalar() ? twins : *HWY_DYNAMIC_DISPATCH(table)();
}

}  // namespace strict
}  // namespace strata::rasterizer
#endif
