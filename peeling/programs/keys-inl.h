// peeling/programs/keys-inl.h - the keys of neighbouring fragments, and which of them are visible: what every way of putting fragments down
// shares. For *_simd.cpp alone: Highway compiles it once a set, wherever foreach_target.h asks. Twin: append of arrivals.h.
#include "hwy/highway.h"

#if defined(STRATA_PEELING_KEYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_PEELING_KEYS_INL_H
#undef STRATA_PEELING_KEYS_INL_H
#else
#define STRATA_PEELING_KEYS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// D: a tag of 32-bit words.
template <class D>
struct Keys {
    hn::Vec<D> key;
    hn::Mask<D> is_visible, is_denormal;
};

// ordered_code; no visible shader_z is NaN.
template <class D>
HWY_INLINE Keys<D> keys_of_z(D d, hn::Vec<hn::RebindToFloat<D>> z, hn::Vec<D> surface) {
    const hn::RebindToFloat<D> floats;
    const hn::RebindToSigned<D> numbers;
    const auto bits = hn::BitCast(d, hn::IfThenZeroElse(hn::Eq(z, hn::Zero(floats)), z));
    const auto sign = hn::BitCast(d, hn::ShiftRight<31>(hn::BitCast(numbers, bits)));
    const auto key = hn::Xor(bits, hn::Or(sign, hn::Set(d, 0x80000000u)));
    const auto magnitude = hn::And(bits, hn::Set(d, 0x7fffffffu));
    const auto is_denormal = hn::Lt(hn::Sub(magnitude, hn::Set(d, 1)), hn::Set(d, 0x007fffffu));
    return {key, hn::RebindMask(d, hn::Lt(z, hn::BitCast(floats, surface))), is_denormal};
}

// A code is its own key; no code counts as denormal.
template <class D>
HWY_INLINE Keys<D> keys_of_code(D d, hn::Vec<D> code, hn::Vec<D> surface) {
    return {code, hn::Lt(code, surface), hn::FirstN(d, 0)};
}

}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
