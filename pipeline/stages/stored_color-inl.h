// pipeline/stages/stored_color-inl.h - stored_color.h for a vector of pixels at a time. For *_simd.cpp only: Highway
// compiles it once per instruction set, in each file that includes foreach_target.h (rasterizer/reference/kernels.md
// 3).
//
// Rule     Between blends an 8-bit channel is held as its code, a float channel as its blending operand: without
//          denormals if the device flushes them.
// Numbers  Halves are multiples of 2^-24 and 1 - x of a half is 0 or at least 2^-11, so no product or sum of them is a
//          denormal of binary32, which flushing would change to 0.
// Tests    tests/peeling/loops/block_passes_test.cpp
#include "hwy/highway.h"
#include "pipeline/formats/half-inl.h"
#include "pipeline/formats/unorm8-inl.h"
#include "pipeline/stages/stored_color.h"

#if defined(STRATA_PIPELINE_STORED_COLOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_PIPELINE_STORED_COLOR_INL_H
#undef STRATA_PIPELINE_STORED_COLOR_INL_H
#else
#define STRATA_PIPELINE_STORED_COLOR_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr std::size_t most_lanes = 16;  // of a block of per-pixel lists
using Words = hn::CappedTag<std::uint32_t, most_lanes>;
using Signed = hn::RebindToSigned<Words>;
using Floats = hn::RebindToFloat<Words>;

using WordVec = hn::Vec<Words>;
using WordMask = hn::Mask<Words>;
using FloatVec = hn::Vec<Floats>;

HWY_INLINE WordVec where(WordMask mask, WordVec x) { return hn::IfThenElseZero(mask, x); }
HWY_INLINE FloatVec where(WordMask mask, FloatVec x) { return hn::IfThenElseZero(hn::RebindMask(Floats{}, mask), x); }
HWY_INLINE WordVec choose(WordMask mask, WordVec yes, WordVec no) { return hn::IfThenElse(mask, yes, no); }
HWY_INLINE FloatVec choose(WordMask mask, FloatVec yes, FloatVec no) {
    return hn::IfThenElse(hn::RebindMask(Floats{}, mask), yes, no);
}
HWY_INLINE WordMask is_set(WordVec x) { return hn::Ne(x, hn::Zero(Words{})); }
HWY_INLINE WordMask is_set(FloatVec x) { return is_set(hn::BitCast(Words{}, x)); }
// For values that are not negative, whose bits have the same order.
HWY_INLINE WordVec greater(WordVec a, WordVec b) { return hn::Max(a, b); }
HWY_INLINE FloatVec greater(FloatVec a, FloatVec b) {
    return hn::BitCast(Floats{}, hn::Max(hn::BitCast(Words{}, a), hn::BitCast(Words{}, b)));
}

template <class Rules>
class StoredColors;

template <BlendRounding blend, UnormRounding to_code, BlendStorage storage>
class StoredColors<Unorm8Rules<blend, to_code, storage>> {
  public:
    using Held = WordVec;
    static constexpr bool is_float = false;

    HWY_INLINE explicit StoredColors(const ColorRules&) {}
    HWY_INLINE static FloatVec one() { return hn::Set(Floats{}, blends_values ? 1.0f : 255.0f); }
    HWY_INLINE static Held held(WordVec codes) { return codes; }
    HWY_INLINE static WordVec codes(Held x) { return x; }
    HWY_INLINE static FloatVec value(Held x) {
        if constexpr (to_code == UnormRounding::half_up) return unorm8_values(Words{}, x);
        if constexpr (to_code == UnormRounding::product_even_wide)
            return hn::Mul(hn::Mul(number(x), hn::Set(Floats{}, 257.0f)), hn::Set(Floats{}, 1.0f / 65535.0f));
        return hn::Mul(number(x), hn::Set(Floats{}, 1.0f / 255.0f));
    }
    HWY_INLINE static Held stored(FloatVec x) { return unorm8_codes<to_code>(Words{}, x); }
    HWY_INLINE static FloatVec operand(Held x) { return blends_values ? value(x) : number(x); }
    HWY_INLINE static FloatVec rest(FloatVec x) { return hn::Sub(one(), x); }

    // Unorm8Arithmetic::combine with BlendEquation::add. s F + d G is at most 2 * 255^2, exact in binary32, and is
    // clamped to 255^2; the shifts divide by 255 and round as in pipeline/reference/fragment-stages.md 8.2.
    HWY_INLINE static Held add(FloatVec s, FloatVec s_factor, FloatVec d, FloatVec d_factor) {
        using enum BlendRounding;
        const Signed di;
        const FloatVec source = hn::Mul(s, s_factor), destination = hn::Mul(d, d_factor);
        if constexpr (blends_values) return stored(hn::Add(source, destination));
        if constexpr (blend == each_product)
            return hn::BitCast(Words{}, hn::Min(hn::Add(product(source), product(destination)), hn::Set(di, 255)));
        const auto sum = hn::Min(hn::ConvertTo(di, hn::Add(source, destination)), hn::Set(di, 65025));
        const auto biased = hn::Add(sum, hn::Set(di, blend == nearest ? 128 : 1));
        return hn::BitCast(Words{}, hn::ShiftRight<8>(hn::Add(biased, hn::ShiftRight<8>(biased))));
    }

  private:
    static constexpr bool blends_values =
        storage == BlendStorage::cached_tiles || blend == BlendRounding::unrounded_source;

    // Codes are at most 255: exact in binary32, and positive as signed words.
    HWY_INLINE static FloatVec number(Held x) { return hn::ConvertTo(Floats{}, hn::BitCast(Signed{}, x)); }
    // Unorm8Arithmetic::product.
    HWY_INLINE static hn::Vec<Signed> product(FloatVec ab) {
        const Signed di;
        const auto whole = hn::ConvertTo(di, ab);
        return hn::ShiftRight<8>(hn::Add(hn::Add(whole, hn::ShiftRight<8>(whole)), hn::Set(di, 128)));
    }
};

template <ChannelType type, HalfRounding half>
class StoredColors<FloatRules<type, half>> {
  public:
    using Held = FloatVec;
    static constexpr bool is_float = true;

    HWY_INLINE explicit StoredColors(const ColorRules& rules)
        : kept_of_small_{hn::Set(Words{}, rules.flushes ? 0x80000000u : ~0u)} {}
    HWY_INLINE static FloatVec one() { return hn::Set(Floats{}, 1.0f); }
    HWY_INLINE Held held(WordVec codes) const {
        if constexpr (is_half) return values_of_halves<half>(Words{}, codes);
        return flushed(hn::BitCast(Floats{}, codes));
    }
    HWY_INLINE static WordVec codes(Held x) {
        if constexpr (is_half) return codes_of_halves<half>(Words{}, x);
        return hn::BitCast(Words{}, x);
    }
    HWY_INLINE static FloatVec value(Held x) { return x; }
    HWY_INLINE Held stored(FloatVec x) const { return flushed(rounded(x)); }
    HWY_INLINE static FloatVec operand(Held x) { return x; }
    HWY_INLINE FloatVec rest(FloatVec x) const { return flushed(hn::Sub(one(), x)); }
    HWY_INLINE Held add(FloatVec s, FloatVec s_factor, FloatVec d, FloatVec d_factor) const {
        const FloatVec sum = hn::Add(flushed(hn::Mul(s, s_factor)), flushed(hn::Mul(d, d_factor)));
        return rounded(canonical(Words{}, flushed(sum)));
    }

  private:
    static constexpr bool is_half = type == ChannelType::half;

    HWY_INLINE FloatVec flushed(FloatVec x) const {
        if constexpr (is_half) return x;
        const WordVec bits = hn::BitCast(Words{}, x);
        const WordMask is_small = hn::Eq(hn::And(bits, hn::Set(Words{}, 0x7f800000u)), hn::Zero(Words{}));
        return hn::BitCast(Floats{}, hn::IfThenElse(is_small, hn::And(bits, kept_of_small_), bits));
    }
    HWY_INLINE static FloatVec rounded(FloatVec x) {
        if constexpr (is_half) return rounded_to_half<half>(Words{}, x);
        return x;
    }

    WordVec kept_of_small_;
};

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
