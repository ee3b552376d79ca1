// pipeline/formats/half-inl.h - binary16 codes and their values, a vector at a time, by the machine's conversions. For
// *_simd.cpp alone: Highway compiles it once a set, wherever foreach_target.h asks (rasterizer/reference/kernels.md 3).
//
// Rule     half_to_float and to_half<nearest_even> of half.h, to the bit; but a signalling NaN becomes quiet. `Words`
//          is a tag of 32-bit words, a code in the low half of each. Only sets with has_halves convert as fast as that.
// Tests    tests/pipeline/stages/simd_stages_test.cpp; tests/peeling/execution_test.cpp
#include "hwy/highway.h"
#include "rasterizer/base/numerics.h"

#if defined(STRATA_PIPELINE_HALF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_PIPELINE_HALF_INL_H
#undef STRATA_PIPELINE_HALF_INL_H
#else
#define STRATA_PIPELINE_HALF_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2 && !defined(HWY_DISABLE_F16C)
constexpr bool has_halves = true;

template <class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> half_values(Words, hn::Vec<Words> codes) {
    const hn::RebindToFloat<Words> d;
    const auto narrow =
        hn::DemoteTo(hn::Rebind<std::uint16_t, Words>{}, hn::BitCast(hn::RebindToSigned<Words>{}, codes));
    return hn::PromoteTo(d, hn::BitCast(hn::Rebind<hwy::float16_t, decltype(d)>{}, narrow));
}

template <class Words>
HWY_INLINE hn::Vec<Words> half_codes(Words words, hn::Vec<hn::RebindToFloat<Words>> values) {
    const auto narrow = hn::DemoteTo(hn::Rebind<hwy::float16_t, Words>{}, values);
    return hn::PromoteTo(words, hn::BitCast(hn::Rebind<std::uint16_t, Words>{}, narrow));
}
#else
constexpr bool has_halves = false;
#endif

// A denormal as the zero of its sign: flushed of blend_float.h.
template <class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> flushed(Words d, hn::Vec<hn::RebindToFloat<Words>> v) {
    const auto bits = hn::BitCast(d, v);
    const auto is_small = hn::Eq(hn::And(bits, hn::Set(d, 0x7f800000u)), hn::Zero(d));
    const auto kept = hn::IfThenElse(is_small, hn::And(bits, hn::Set(d, 0x80000000u)), bits);
    return hn::BitCast(hn::RebindToFloat<Words>{}, kept);
}

// Every NaN as 0x7fffffff: canonical of blend_float.h.
template <class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> canonical(Words d, hn::Vec<hn::RebindToFloat<Words>> v) {
    const auto nan = hn::BitCast(hn::RebindToFloat<Words>{}, hn::Set(d, 0x7fffffffu));
    return hn::IfThenElse(hn::Eq(v, v), v, nan);
}

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
