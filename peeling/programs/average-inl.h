// peeling/programs/average-inl.h - average_text-inl.h for vectors. Only for *_simd.cpp: Highway's foreach_target.h
// compiles it once per target (rasterizer/reference/kernels.md 3). Tests: tests/peeling/programs/programs_test.cpp
#include <cstdint>

#include "hwy/highway.h"
#include "rasterizer/base/numerics.h"

#if defined(STRATA_PEELING_AVERAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_PEELING_AVERAGE_INL_H
#undef STRATA_PEELING_AVERAGE_INL_H
#else
#define STRATA_PEELING_AVERAGE_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace average {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::ScalableTag<std::uint32_t>;
using Floats = hn::Repartition<float, Words>;
using Integers = hn::RebindToSigned<Words>;
using WordVec = hn::Vec<Words>;
using FloatVec = hn::Vec<Floats>;

// The operations of scalar::OneAverage, where they are documented, for vectors.
struct AverageLanes {
    HWY_INLINE static FloatVec all(float v) { return hn::Set(Floats{}, v); }
    HWY_INLINE static WordVec whole(FloatVec n) {
        const Floats d;
        const FloatVec positive = hn::IfThenElseZero(hn::Gt(n, hn::Zero(d)), n);
        const FloatVec limited = hn::IfThenElse(hn::Lt(positive, all(0x1p30f)), positive, all(0x1p30f));
        return hn::BitCast(Words{}, hn::ConvertTo(Integers{}, limited));
    }
    HWY_INLINE static bool any(WordVec left) { return !hn::AllTrue(Words{}, hn::Eq(left, hn::Zero(Words{}))); }
    HWY_INLINE static WordVec halved(WordVec left) { return hn::ShiftRight<1>(left); }
    HWY_INLINE static FloatVec if_odd(WordVec left, FloatVec yes, FloatVec no) {
        const auto is_odd = hn::Ne(hn::And(left, hn::Set(Words{}, 1)), hn::Zero(Words{}));
        return hn::IfThenElse(hn::RebindMask(Floats{}, is_odd), yes, no);
    }
};

#include "peeling/programs/average_text-inl.h"

// Lanes with something to average; the others keep the background.
HWY_INLINE hn::Mask<Floats> has_average(FloatVec a, FloatVec n) {
    const FloatVec zero = hn::Zero(Floats{});
    return hn::And(hn::Gt(n, zero), hn::Gt(a, zero));
}

}  // namespace average
}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
