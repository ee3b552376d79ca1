// peeling/programs/average_words_simd.cpp - resolve_average_words for the sets that convert halves. Whole vectors:
// planes have spare words.
// How kernels are written: kernels.md. Tests: tests/peeling/execution_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/programs/average_words_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "peeling/programs/average-inl.h"
#include "peeling/programs/average_words.h"
#include "pipeline/formats/half-inl.h"
#include "pipeline/formats/unorm8-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2 && !defined(HWY_DISABLE_F16C)  // has_halves of half-inl.h

using average::Floats;
using average::FloatVec;
using average::Integers;
using average::VectorLanes;
using average::Words;
using average::WordVec;
using pipeline::HWY_NAMESPACE::half_values;
using pipeline::HWY_NAMESPACE::unorm8_codes;
using pipeline::HWY_NAMESPACE::unorm8_values;

// Two halves a word, the earlier channel below: red and blue are low, green and alpha high.
HWY_INLINE FloatVec low_half(WordVec words) { return half_values(Words{}, hn::And(words, hn::Set(Words{}, 0xffffu))); }
HWY_INLINE FloatVec high_half(WordVec words) { return half_values(Words{}, hn::ShiftRight<16>(words)); }

// Lanes behind the last pixel are scratch and no pixels.
void note_stuck(hn::Mask<Floats> stuck, std::size_t first, std::size_t pixels, StuckPixels& all) {
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Floats{}, stuck, bits);
    for (std::size_t i = 0; i < hn::Lanes(Floats{}) && first + i < pixels; ++i) {
        if ((bits[i / 8] >> i % 8 & 1) == 0) continue;
        all.first = std::min(all.first, static_cast<std::uint32_t>(first + i));
        ++all.pixels;
    }
}

// A count of 2048 and a sum beyond 65504 have stopped growing in a half (algorithms.md 7). A sum of NaN is
// reported, too.
StuckPixels resolve(const pipeline::ScreenWords& words) {
    const Words d;
    const Floats df;
    StuckPixels stuck;
    for (std::size_t i = 0; i < words.pixels; i += hn::Lanes(d)) {
        const auto load = [&](std::size_t read, std::size_t word)
                              HWY_ATTR { return hn::LoadU(d, words.reads[read].plane(word).words + i); };
        const WordVec red_green = load(0, 0), blue_alpha = load(0, 1), background = load(2, 0);
        const FloatVec a = high_half(blue_alpha), n = low_half(load(1, 0));
        const auto sound = hn::And(hn::Lt(n, hn::Set(df, 2048.0f)), hn::Le(a, hn::Set(df, 65504.0f)));
        if (HWY_UNLIKELY(!hn::AllTrue(df, sound))) note_stuck(hn::Not(sound), i, words.pixels, stuck);
        const auto has = average::has_average(a, n);
        WordVec result = hn::Or(background, hn::Set(d, 0xff000000u));  // a code is its own value's code
        if (!hn::AllFalse(df, has)) {
            const FloatVec t = average::transmittance(VectorLanes{}, a, n);
            const auto channel = [&](FloatVec sum, WordVec behind) HWY_ATTR {
                return unorm8_codes(d, average::average_over(VectorLanes{}, sum, a, t, unorm8_values(d, behind)));
            };
            const WordVec byte = hn::Set(d, 0xffu);
            WordVec mixed = hn::Or(hn::Set(d, 0xff000000u), channel(low_half(red_green), hn::And(background, byte)));
            mixed = hn::Or(
                mixed, hn::ShiftLeft<8>(channel(high_half(red_green), hn::And(hn::ShiftRight<8>(background), byte))));
            mixed = hn::Or(
                mixed, hn::ShiftLeft<16>(channel(low_half(blue_alpha), hn::And(hn::ShiftRight<16>(background), byte))));
            result = hn::IfThenElse(hn::RebindMask(d, has), mixed, result);
        }
        hn::StoreU(result, d, words.color.plane(0).words + i);
    }
    return stuck;
}
#else
StuckPixels resolve(const pipeline::ScreenWords&) { return {}; }
#endif

bool converts_halves() { return pipeline::HWY_NAMESPACE::has_halves; }

}  // namespace
}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::peeling {
STRATA_EXPORT(resolve);
STRATA_EXPORT(converts_halves);

StuckPixels resolve_average_words(const pipeline::ScreenWords& words) noexcept {
    return kernel_of(HWY_DISPATCH_TABLE(resolve))(words);
}
bool resolves_words() noexcept { return !simd_is_scalar() && kernel_of(HWY_DISPATCH_TABLE(converts_halves))(); }

}  // namespace strata::peeling
#endif
