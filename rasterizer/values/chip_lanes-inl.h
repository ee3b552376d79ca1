// rasterizer/values/chip_lanes-inl.h - weights, window depth and depth codes of NV2A's interpolators, for a vector of
// binary64 at a time. For *_simd.cpp only, like weights-inl.h.
//
// Rule     The operations and their order are those of TruncatedWeights, PerspectiveWeights and WindowZ24. Exponents
//          are compared as powers of two, which a bit mask extracts; truncation is a bit mask, or Trunc of an exactly
//          scaled number.
// Numbers  chip_lanes.h. Lanes that the triangle does not cover may contain any value; their results are not used.
// Tests    tests/rasterizer/values/chip_lanes_test.cpp
#include "hwy/highway.h"
#include "rasterizer/values/chip_lanes.h"
#include "rasterizer/values/weights-inl.h"

#if defined(STRATA_RASTERIZER_CHIP_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_RASTERIZER_CHIP_LANES_INL_H
#undef STRATA_RASTERIZER_CHIP_LANES_INL_H
#else
#define STRATA_RASTERIZER_CHIP_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U64 = hn::Rebind<std::uint64_t, F64>;
using Mask64 = hn::Mask<F64>;

constexpr std::uint64_t leading_24 = ~std::uint64_t{0} << 29, leading_25 = ~std::uint64_t{0} << 28,
                        exponent_field = std::uint64_t{0x7ff} << 52, fraction_field = ~std::uint64_t{0} >> 12;

HWY_INLINE V64 all(double v) { return hn::Set(F64{}, v); }
HWY_INLINE V64 kept(V64 v, std::uint64_t mask) { return hn::And(v, hn::BitCast(F64{}, hn::Set(U64{}, mask))); }
HWY_INLINE V64 truncate_24(V64 v) { return kept(v, leading_24); }
// 2^floor(log2 |v|); 0 for zero.
HWY_INLINE V64 leading_power(V64 v) { return kept(v, exponent_field); }
HWY_INLINE V64 added_bits(V64 v, hn::Vec<U64> more) { return hn::BitCast(F64{}, hn::Add(hn::BitCast(U64{}, v), more)); }

// 1 / v for a power of two v.
HWY_INLINE V64 inverse_power(V64 v) {
    const auto twice_bias = hn::Set(U64{}, std::uint64_t{2 * 1023} << 52);
    return hn::BitCast(F64{}, hn::Sub(twice_bias, hn::BitCast(U64{}, v)));
}

// One value per corner.
struct Corners {
    V64 c0, c1, c2;
};

// The edge values of all three corners: e holds those of corners 1 and 2 in place of weights; corner 0 has the rest of
// the area.
HWY_INLINE Corners edge_values(const Weights& e, V64 area) { return {hn::Sub(hn::Sub(area, e.b1), e.b2), e.b1, e.b2}; }

HWY_INLINE Corners truncated_products(const Corners& p, V64 r) {
    return {truncate_24(hn::Mul(p.c0, r)), truncate_24(hn::Mul(p.c1, r)), truncate_24(hn::Mul(p.c2, r))};
}
// truncated_reciprocal of `sum`; `exact` is 1 / sum, rounded. `low` and the mask are those of ChipTriangle.
HWY_INLINE V64 truncated_inverse(V64 sum, V64 exact, double low, std::uint64_t reciprocal_mask) {
    const auto is_power = hn::Eq(hn::BitCast(U64{}, kept(sum, fraction_field)), hn::Zero(U64{}));
    const V64 truncated = kept(hn::Mul(exact, all(low)), reciprocal_mask);
    return hn::IfThenElse(hn::RebindMask(F64{}, is_power), exact, truncated);
}

class TruncatedWeightsAt {
  public:
    HWY_INLINE explicit TruncatedWeightsAt(const ChipTriangle& t)
        : q0_{t.q[0]},
          q1_{t.q[1]},
          q2_{t.q[2]},
          low_{t.low},
          constant_r_{t.constant_r},
          reciprocal_mask_{t.mask},
          is_perspective_{t.is_perspective} {}

    // TruncatedWeights::at, or PerspectiveWeights::truncated_at if w differs between the corners.
    HWY_INLINE Corners at(const Corners& e) const {
        if (constant_r_ != 0.0) return truncated_products(e, all(constant_r_));
        Corners p{truncate_24(e.c0), truncate_24(e.c1), truncate_24(e.c2)};
        V64 sum = hn::Add(hn::Add(p.c0, p.c1), p.c2);
        if (is_perspective_) {
            const Corners whole{hn::Mul(p.c0, all(q0_)), hn::Mul(p.c1, all(q1_)), hn::Mul(p.c2, all(q2_))};
            sum = aligned_sum(whole);
            p = {kept(whole.c0, leading_25), kept(whole.c1, leading_25), kept(whole.c2, leading_25)};
        }
        return truncated_products(p, truncated_inverse(sum, hn::Div(all(1.0), sum), low_, reciprocal_mask_));
    }

  private:
    // aligned_sum of perspective_weights.h.
    HWY_INLINE static V64 aligned_sum(const Corners& p) {
        const V64 largest = hn::Max(leading_power(p.c0), hn::Max(leading_power(p.c1), leading_power(p.c2)));
        const V64 unit = hn::Mul(largest, all(0x1p-28)), units = inverse_power(unit);
        const auto truncated = [&](V64 v) { return hn::Trunc(hn::Mul(v, units)); };
        return hn::Mul(hn::Add(hn::Add(truncated(p.c0), truncated(p.c1)), truncated(p.c2)), unit);
    }

    const double q0_, q1_, q2_, low_, constant_r_;
    const std::uint64_t reciprocal_mask_;
    const bool is_perspective_;
};

// The corner that takes the remainder in with_remainder: is0, is2, or corner 1 if both are false.
struct Remainder {
    Mask64 is0, is2;

    HWY_INLINE explicit Remainder(const Corners& b) {
        const V64 k0 = leading_power(b.c0), k1 = leading_power(b.c1), k2 = leading_power(b.c2);
        // As remainder_vertex decides: 2 if largest, alone or tied with 0; else 1 if largest, alone or tied with 2;
        // else 0 if largest, alone or tied with 1; else 2.
        const Mask64 is2_first = hn::And(hn::Ge(k2, k0), hn::Gt(k2, k1)), is1 = hn::Gt(k1, k0);
        is0 = hn::AndNot(is2_first, hn::AndNot(is1, hn::Gt(k0, k2)));
        is2 = hn::Or(is2_first, hn::AndNot(is1, hn::Not(hn::Gt(k0, k2))));
    }
};

// high + low is the exact sum.
struct TwoLanes {
    V64 high, low;
};
HWY_INLINE TwoLanes two_sum_lanes(V64 a, V64 b) {
    const V64 sum = hn::Add(a, b);
    const V64 b_seen = hn::Sub(sum, a);
    const V64 a_seen = hn::Sub(sum, b_seen);
    return {sum, hn::Add(hn::Sub(a, a_seen), hn::Sub(b, b_seen))};
}
// truncate_sum_24. The two terms have different signs if their product is negative.
HWY_INLINE V64 truncated_sum(const TwoLanes& s) {
    const Mask64 is_below =
        hn::And(hn::Eq(truncate_24(s.high), s.high), hn::Lt(hn::Mul(s.low, s.high), hn::Zero(F64{})));
    const auto minus_one = hn::BitCast(U64{}, hn::VecFromMask(F64{}, is_below));
    return truncate_24(added_bits(s.high, minus_one));
}

// WindowZ24 for narrow corners, without the offset. `last_place` is 2^(1 - sum_bits).
struct WindowZLanes {
    V64 z0, z1, z2;
    V64 d10, d20, d21, minus_d10, minus_d20, minus_d21;  // the differences of NarrowWindowZ and their negatives

    HWY_INLINE V64 value(const Corners& e, const Corners& b, double last_place) const {
        const V64 k0 = leading_power(e.c0), k1 = leading_power(e.c1), k2 = leading_power(e.c2);
        const Mask64 is1 = hn::And(hn::Ge(k1, k0), hn::Ge(k1, k2)), is0 = hn::AndNot(is1, hn::Ge(k0, k2));
        const Mask64 is01 = hn::Or(is0, is1);
        // The depth of the reference corner, and the products of the other two corners.
        const V64 z = hn::IfThenElse(is1, z1, hn::IfThenElse(is0, z0, z2));
        const V64 dj = hn::IfThenElse(is0, d10, hn::IfThenElse(is1, minus_d10, minus_d20));
        const V64 dk = hn::IfThenElse(is0, d20, hn::IfThenElse(is1, d21, minus_d21));
        const V64 pj = hn::Mul(hn::IfThenElse(is0, b.c1, b.c0), dj);
        const V64 pk = hn::Mul(hn::IfThenElse(is01, b.c2, b.c1), dk);
        // The power of two of the largest term; if all terms are 0, any power gives the same result.
        const V64 own = hn::Max(leading_power(z), all(0x1p-500));
        const V64 largest = hn::Max(own, hn::Max(leading_power(pj), leading_power(pk)));
        const V64 unit = hn::Mul(largest, all(last_place)), units = inverse_power(unit);
        const V64 sum = hn::Add(hn::Trunc(hn::Mul(pj, units)), hn::Trunc(hn::Mul(pk, units)));
        return truncated_sum(two_sum_lanes(z, hn::Mul(sum, unit)));
    }
};

// Evaluates one triangle's window depth in all lanes, with its offset.
class WindowZAt {
  public:
    HWY_INLINE explicit WindowZAt(const NarrowWindowZ& z)
        : z0_{z.z[0]},
          z1_{z.z[1]},
          z2_{z.z[2]},
          d10_{z.d10},
          d20_{z.d20},
          d21_{z.d21},
          offset_{z.offset},
          last_place_{power_of_two(1 - z.sum_bits)} {}

    HWY_INLINE V64 value(const Corners& e, const Corners& b) const {
        const WindowZLanes lanes{all(z0_),  all(z1_),   all(z2_),   all(d10_), all(d20_),
                                 all(d21_), all(-d10_), all(-d20_), all(-d21_)};
        const V64 v = lanes.value(e, b, last_place_);
        return offset_ == 0.0 ? v : truncated_sum(two_sum_lanes(v, all(offset_)));
    }

  private:
    const double z0_, z1_, z2_, d10_, d20_, d21_, offset_, last_place_;
};

template <CodeKind kind>
HWY_INLINE hn::Vec<U32> chip_codes(V64 value, const ChipConversion& to) {
    const V64 v = hn::Min(hn::Max(value, all(to.least)), all(to.greatest));
    if constexpr (kind == CodeKind::fixed) {
        return hn::BitCast(U32{}, hn::DemoteTo(I32{}, v));
    } else {
        // As in to_d16f_code and to_d24f_code, values below the smallest normal code give code 0.
        constexpr bool is_d16f = kind == CodeKind::d16f;
        constexpr double least_normal = is_d16f ? 0x1p-6 : 0x1p-126;
        constexpr int dropped = is_d16f ? 40 : 36;
        constexpr std::uint64_t below = std::uint64_t{is_d16f ? 1023 - 7 : 1023 - 127} << 52;
        const auto code = hn::ShiftRight<dropped>(hn::Sub(hn::BitCast(U64{}, v), hn::Set(U64{}, below)));
        const auto is_normal = hn::RebindMask(U64{}, hn::Ge(v, all(least_normal)));
        return hn::TruncateTo(U32{}, hn::IfThenElseZero(is_normal, code));
    }
}

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
