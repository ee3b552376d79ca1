// pipeline/formats/unorm8-inl.h - conversion between 8-bit codes and their values, a vector at a time. For *_simd.cpp
// only: Highway compiles it once per instruction set, in each file that includes foreach_target.h.
//
// Rule     unorm8_value and to_unorm8 of unorm8.h, bit for bit, for both roundings; `Words` is a tag of 32-bit words.
// Tests    tests/pipeline/formats/unorm8_test.cpp: every code, and values at and next to every boundary;
//          tests/peeling/execution/execution_test.cpp
#include "hwy/highway.h"
#include "pipeline/formats/unorm8.h"

#if defined(STRATA_PIPELINE_UNORM8_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_PIPELINE_UNORM8_INL_H
#undef STRATA_PIPELINE_UNORM8_INL_H
#else
#define STRATA_PIPELINE_UNORM8_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// unorm8_value of each lane: two products and a sum, each rounded as in the scalar reference.
template <class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> unorm8_values(Words, hn::Vec<Words> codes) {
    const hn::RebindToFloat<Words> d;
    const auto k = hn::ConvertTo(d, hn::BitCast(hn::RebindToSigned<Words>{}, codes));
    return hn::Add(hn::Mul(k, hn::Set(d, 0x1.01p-8f)), hn::Mul(k, hn::Set(d, 1.0f / 0xff0000p0f)));
}

template <UnormRounding rounding = UnormRounding::half_up, class Words>
HWY_INLINE hn::Vec<Words> unorm8_codes(Words words, hn::Vec<hn::RebindToFloat<Words>> x) {
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(words, to_unorm8<rounding>(hn::GetLane(x)));
#else
    const hn::RebindToFloat<Words> d;
    const hn::Half<hn::RebindToFloat<Words>> half;
    const hn::Rebind<double, decltype(half)> wide;
    // NaN does not compare greater than 0 and becomes 0, like -0.
    const auto positive = hn::IfThenElseZero(hn::Lt(hn::Zero(d), x), x);  // 0 for NaN
    const auto clamped = hn::IfThenElse(hn::Lt(positive, hn::Set(d, 1.0f)), positive, hn::Set(d, 1.0f));
    if constexpr (rounding != UnormRounding::half_up) {
        const auto at_one = hn::Set(d, 0x1.8p23f);  // the unit in the last place of a sum with it is 1
        const auto code = hn::Sub(hn::Add(hn::Mul(clamped, hn::Set(d, 255.0f)), at_one), at_one);
        return hn::BitCast(words, hn::ConvertTo(hn::RebindToSigned<Words>{}, code));
    }
    const auto rounded = [&](auto part) HWY_ATTR {
        const auto product = hn::Mul(hn::PromoteTo(wide, part), hn::Set(wide, 255.0));
        return hn::DemoteTo(hn::Rebind<std::int32_t, decltype(half)>{}, hn::Add(product, hn::Set(wide, 0.5)));
    };
    return hn::BitCast(words, hn::Combine(hn::RebindToSigned<Words>{}, rounded(hn::UpperHalf(half, clamped)),
                                          rounded(hn::LowerHalf(half, clamped))));
#endif
}

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
