// rasterizer/values/weights-inl.h - weights, planes and codes of neighbouring or scattered pixels, for a vector of
// binary64 at a time. For *_simd.cpp only: Highway compiles it once per instruction set, in each file that includes
// foreach_target.h.
//
// Rule     The operations and their order are those of PixelWeights, FilterPlane and depth_text-inl.h: every
//          instruction set gives the bits of the scalar reference in lane_kernels.h.
// Tests    tests/rasterizer/walk/tile_rasterizer_test.cpp, rows_test.cpp
#include "hwy/highway.h"
#include "rasterizer/values/lane_kernels.h"

#if defined(STRATA_RASTERIZER_WEIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_RASTERIZER_WEIGHTS_INL_H
#undef STRATA_RASTERIZER_WEIGHTS_INL_H
#else
#define STRATA_RASTERIZER_WEIGHTS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::CappedTag<double, 8>;  // vectors of every other type have as many lanes as those of binary64
using F32 = hn::Rebind<float, F64>;
using I32 = hn::Rebind<std::int32_t, F64>;
using U32 = hn::Rebind<std::uint32_t, F64>;
using U16 = hn::Rebind<std::uint16_t, F64>;
using V64 = hn::Vec<F64>;
using V32 = hn::Vec<F32>;

// A table, because hn::Iota writes to the stack and stalls on reading it back.
alignas(64) constexpr double counting64[8] = {0, 1, 2, 3, 4, 5, 6, 7};

// Pixel coordinates as binary64.
HWY_INLINE V64 coordinates(const std::uint16_t* p) {
    return hn::PromoteTo(F64{}, hn::PromoteTo(I32{}, hn::LoadU(U16{}, p)));
}
// first, first + 1, ...
HWY_INLINE V64 numbers_from(int first) {
    return hn::Add(hn::Set(F64{}, static_cast<double>(first)), hn::Load(F64{}, counting64));
}

struct Weights {
    V64 b1, b2;
};

// The weights of one kind. They are sums of a term that depends on the column and one that depends on the row. The
// compiler hoists what is the same in all lanes.
template <bool unsnapped>
class WeightsAt {
  public:
    HWY_INLINE explicit WeightsAt(const PixelWeights& w) : w_{w} {}

    HWY_INLINE Weights lanes(const std::uint16_t* x, const std::uint16_t* y) const {
        return at(column_terms(coordinates(x)), row_terms(coordinates(y)));
    }
    HWY_INLINE Weights column_terms(V64 x) const {
        if constexpr (unsnapped) {
            const V64 dx = hn::Sub(hn::Add(x, set(0.5)), set(w_.x0));
            return {hn::Mul(dx, set(w_.y2)), hn::Mul(dx, set(w_.y1))};
        } else {
            return {hn::Mul(x, set(w_.e1.step_x)), hn::Mul(x, set(w_.e2.step_x))};
        }
    }
    HWY_INLINE Weights row_terms(V64 y) const {
        if constexpr (unsnapped) {
            const V64 dy = hn::Sub(hn::Add(y, set(0.5)), set(w_.y0));
            return {hn::Mul(dy, set(w_.x2)), hn::Mul(dy, set(w_.x1))};
        } else {
            return {hn::Mul(y, set(w_.e1.step_y)), hn::Mul(y, set(w_.e2.step_y))};
        }
    }
    HWY_INLINE Weights row_terms(int y) const { return row_terms(set(static_cast<double>(y))); }
    HWY_INLINE Weights at(const Weights& column, const Weights& row) const {
        if constexpr (unsnapped) {
            return {hn::Mul(hn::Sub(column.b1, row.b1), set(w_.r)), hn::Mul(hn::Sub(row.b2, column.b2), set(w_.r))};
        } else {
            const V64 e1 = hn::Add(hn::Add(column.b1, row.b1), set(w_.e1.constant));
            const V64 e2 = hn::Add(hn::Add(column.b2, row.b2), set(w_.e2.constant));
            return {hn::Mul(e1, set(w_.r)), hn::Mul(e2, set(w_.r))};
        }
    }

  private:
    [[nodiscard]] HWY_INLINE static V64 set(double v) { return hn::Set(F64{}, v); }
    const PixelWeights w_;
};

HWY_INLINE V64 plane_at(const FilterPlane& p, const Weights& b) {
    const F64 d;
    return hn::Add(hn::Set(d, p.w0), hn::Add(hn::Mul(b.b1, hn::Set(d, p.d1)), hn::Mul(b.b2, hn::Set(d, p.d2))));
}

// Returns the low end of the filter's interval, rounded; `unsure` accumulates the bits in which the high end differs.
HWY_INLINE V32 rounded(V64 v, V64 error, hn::Vec<U32>& unsure) {
    const V32 low = hn::DemoteTo(F32{}, hn::Sub(v, error)), high = hn::DemoteTo(F32{}, hn::Add(v, error));
    unsure = hn::Or(unsure, hn::Xor(hn::BitCast(U32{}, low), hn::BitCast(U32{}, high)));
    return low;
}

// a if it is greater (less) than b, else b: the behaviour of x86's MAX and MIN of (a, b), also for NaN and -0.
HWY_INLINE V32 greater_or_second(V32 a, V32 b) {
    return HWY_ARCH_X86 ? hn::Max(a, b) : hn::IfThenElse(hn::Gt(a, b), a, b);
}
HWY_INLINE V32 less_or_second(V32 a, V32 b) {
    return HWY_ARCH_X86 ? hn::Min(a, b) : hn::IfThenElse(hn::Lt(a, b), a, b);
}

// The operations of depth_text-inl.h. D16F is not among them: its passes run lane by lane.
struct DepthVectors {
    HWY_INLINE static V32 all(float v) { return hn::Set(F32{}, v); }
    HWY_INLINE static V32 greater_or_second(V32 a, V32 b) { return HWY_NAMESPACE::greater_or_second(a, b); }
    HWY_INLINE static V32 less_or_second(V32 a, V32 b) { return HWY_NAMESPACE::less_or_second(a, b); }
    HWY_INLINE static hn::Vec<U32> bits(V32 v) { return hn::BitCast(U32{}, v); }
    HWY_INLINE static V64 times(V32 v, double scale) { return hn::Mul(hn::PromoteTo(F64{}, v), hn::Set(F64{}, scale)); }
    HWY_INLINE static hn::Vec<U32> truncated_sum(V64 v, double half) {
        return hn::BitCast(U32{}, hn::DemoteTo(I32{}, hn::Add(v, hn::Set(F64{}, half))));
    }
};

#include "rasterizer/rules/depth_text-inl.h"

template <bool is_fixed>
HWY_INLINE hn::Vec<U32> codes(V32 z, const DepthConversion<float>& to) {
    constexpr CodeKind kind = is_fixed ? CodeKind::fixed : CodeKind::binary32;
    return HWY_NAMESPACE::depth_code<kind>(DepthVectors{}, z, to);
}
HWY_INLINE hn::Vec<U32> codes(V32 z, const DepthConversion<float>& to) {
    return to.is_fixed() ? codes<true>(z, to) : codes<false>(z, to);
}

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
