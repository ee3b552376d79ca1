// pipeline/formats/half-inl.h - conversion between binary16 codes and their values, a vector at a time, with hardware
// instructions where available. For *_simd.cpp only: Highway compiles it once per instruction set, in each file that
// includes foreach_target.h (rasterizer/reference/kernels.md 3).
//
// Rule     half_to_float and to_half<nearest_even> of half.h, bit for bit, except that a signalling NaN becomes quiet.
//          `Words` is a tag of 32-bit words with a code in the low half of each. Only instruction sets with has_halves
//          convert this fast. On the others values_of_halves and codes_of_halves run lane by lane and rounded_to_half
//          uses integers; with no_infinity all three run lane by lane.
// Tests    tests/pipeline/stages/simd_stages_test.cpp; tests/peeling/loops/block_passes_test.cpp;
//          tests/peeling/execution/execution_test.cpp
#include "hwy/highway.h"
#include "pipeline/formats/half.h"

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

// The two conversions for any instruction set, for use on a few vectors.
template <HalfRounding rounding, class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> values_of_halves(Words d, hn::Vec<Words> codes) {
    if constexpr (has_halves && rounding != HalfRounding::no_infinity) {
        return half_values(d, codes);
    } else {
        alignas(64) std::uint32_t word[hn::MaxLanes(d)];
        alignas(64) float value[hn::MaxLanes(d)];
        hn::Store(codes, d, word);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i)
            value[i] = half_value<rounding>(static_cast<std::uint16_t>(word[i]));
        return hn::Load(hn::RebindToFloat<Words>{}, value);
    }
}

// For values that a half represents exactly.
template <HalfRounding rounding, class Words>
HWY_INLINE hn::Vec<Words> codes_of_halves(Words d, hn::Vec<hn::RebindToFloat<Words>> values) {
    constexpr bool is_special = rounding == HalfRounding::no_infinity;
    if constexpr (has_halves && !is_special) {
        return half_codes(d, values);
    } else {
        alignas(64) std::uint32_t word[hn::MaxLanes(d)];
        alignas(64) float value[hn::MaxLanes(d)];
        hn::Store(values, hn::RebindToFloat<Words>{}, value);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i)
            word[i] = to_half < is_special ? rounding : HalfRounding::nearest_even > (value[i]);
        return hn::Load(d, word);
    }
}

// half_value of to_half: each lane rounded to a half, by the steps of to_half on the bits of binary32.
template <HalfRounding rounding, class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> rounded_to_half(Words words, hn::Vec<hn::RebindToFloat<Words>> values) {
    if constexpr (rounding == HalfRounding::no_infinity)
        return values_of_halves<rounding>(words, codes_of_halves<rounding>(words, values));
    const hn::RebindToSigned<Words> d;
    const hn::RebindToFloat<Words> floats;
    constexpr bool is_nearest = rounding == HalfRounding::nearest_even;
    if constexpr (has_halves && is_nearest)
        return hn::PromoteTo(floats, hn::DemoteTo(hn::Rebind<hwy::float16_t, Words>{}, values));
    const auto bits = hn::BitCast(d, values), magnitude = hn::And(bits, hn::Set(d, 0x7fffffff));
    const auto cut = hn::Set(d, ~0x1fff), infinity = hn::Set(d, 255 << 23), two_to_16 = hn::Set(d, 143 << 23);
    const auto is_small = hn::Lt(magnitude, hn::Set(d, 113 << 23));  // below 2^-14
    const auto small = hn::BitCast(floats, hn::IfThenElseZero(is_small, magnitude));
    auto result = magnitude, denormal = magnitude, beyond = infinity;
    if constexpr (is_nearest) {
        const auto last = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(d, 1));
        result = hn::And(hn::Add(magnitude, hn::Add(last, hn::Set(d, 0xfff))), cut);
        const auto half = hn::Set(floats, 0.5f);
        denormal = hn::BitCast(d, hn::Sub(hn::Add(small, half), half));
    } else {
        result = hn::And(magnitude, cut);
        const auto units = hn::ConvertTo(d, hn::Mul(small, hn::Set(floats, 0x1p24f)));  // truncates
        denormal = hn::BitCast(d, hn::Mul(hn::ConvertTo(floats, units), hn::Set(floats, 0x1p-24f)));
        beyond = hn::IfThenElse(hn::Eq(magnitude, infinity), infinity, hn::Set(d, 0x477fe000));  // 65504
    }
    result = hn::IfThenElse(is_small, denormal, result);
    result = hn::IfThenElse(hn::Lt(result, two_to_16), result, beyond);
    const auto nan = hn::Or(hn::And(magnitude, cut), hn::Set(d, 0x7fc00000));
    result = hn::IfThenElse(hn::Gt(magnitude, infinity), nan, result);
    return hn::BitCast(floats, hn::Or(result, hn::AndNot(hn::Set(d, 0x7fffffff), bits)));
}

// Replaces a denormal by the zero of its sign: flushed of blend_float.h.
template <class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> flushed(Words d, hn::Vec<hn::RebindToFloat<Words>> v) {
    const auto bits = hn::BitCast(d, v);
    const auto is_small = hn::Eq(hn::And(bits, hn::Set(d, 0x7f800000u)), hn::Zero(d));
    const auto kept = hn::IfThenElse(is_small, hn::And(bits, hn::Set(d, 0x80000000u)), bits);
    return hn::BitCast(hn::RebindToFloat<Words>{}, kept);
}

// Replaces every NaN by 0x7fffffff: canonical of blend_float.h.
template <class Words>
HWY_INLINE hn::Vec<hn::RebindToFloat<Words>> canonical(Words d, hn::Vec<hn::RebindToFloat<Words>> v) {
    const auto nan = hn::BitCast(hn::RebindToFloat<Words>{}, hn::Set(d, 0x7fffffffu));
    return hn::IfThenElse(hn::Eq(v, v), v, nan);
}

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
