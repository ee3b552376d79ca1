// pipeline/stages/stages_simd.cpp - the stages between program and blending, one source for every instruction set. The
// definitions are namespace scalar of lane_words.h, convert.h, alpha_test.h and stencil_lanes.h. Where a plain loop
// vectorizes, the kernel is that loop, inlined (flatten) and compiled per instruction set; gather, scatter and counts
// are written with Highway. How kernels are written: rasterizer/reference/kernels.md. Tests:
// tests/pipeline/stages/simd_stages_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/stages/stages_simd.cpp"
#include <algorithm>
#include <cassert>

#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/formats/convert.h"
#include "pipeline/formats/half-inl.h"
#include "pipeline/stages/alpha_test.h"
#include "pipeline/stages/lane_words.h"
#include "pipeline/stages/stencil_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::ScalableTag<std::uint32_t>;
using WordVec = hn::Vec<Words>;
using WordMask = hn::Mask<Words>;

// Arrays of a batch have room for whole vectors, so that no loop needs a remainder.
constexpr std::size_t padded(std::size_t count) { return (count + 15) & ~std::size_t{15}; }

// first, first + 1, ...; Highway's Iota would pass its start through memory.
HWY_INLINE WordVec counting(Word first) {
    const Words d;
    return hn::Add(hn::Set(d, first), hn::Iota(d, 0));
}

HWY_INLINE WordMask first_lanes(std::size_t count) {
    const Words d;
    return hn::Lt(hn::Iota(d, 0), hn::Set(d, static_cast<Word>(count)));
}

// The pixels of one vector of lanes, and whether they are contiguous (is_run) or within two consecutive vectors
// (is_near).
struct LaneGroup {
    WordMask in_batch;
    WordVec pixel, behind_first;
    Word first;
    bool is_run, is_near;
};

HWY_INLINE LaneGroup group_at(const PixelLanes& at, std::size_t i) {
    const Words d;
    const WordMask in_batch = first_lanes(at.count - i);
    const WordVec pixel = hn::LoadU(d, at.pixel + i);
    const WordVec behind_first = hn::IfThenElseZero(in_batch, hn::Sub(pixel, hn::Set(d, at.pixel[i])));
    const bool is_run = hn::AllTrue(d, hn::Or(hn::Eq(behind_first, hn::Iota(d, 0)), hn::Not(in_batch)));
    const bool is_near = hn::AllTrue(d, hn::Lt(behind_first, hn::Set(d, static_cast<Word>(2 * hn::Lanes(d)))));
    return {in_batch, pixel, behind_first, at.pixel[i], is_run, is_near};
}

// Unused lanes are redirected to spare words, one each, so that a gather or scatter can access them safely.
HWY_INLINE hn::Vec<hn::RebindToSigned<Words>> spare_index(Plane plane, WordMask used, WordVec pixel) {
    const WordVec spare = counting(static_cast<Word>(plane.pixels));
    return hn::BitCast(hn::RebindToSigned<Words>{}, hn::IfThenElse(used, pixel, spare));
}

// The stored words of a group: one load if its pixels are contiguous, as in rows of large triangles; two if few pixels
// are missing between them, as in a layer of a peel.
HWY_INLINE WordVec load(Plane plane, const LaneGroup& group) {
    const Words d;
    const Word* const words = plane.words + group.first;
    if (group.is_run) return hn::LoadU(d, words);
    if (group.is_near && group.first + 2 * hn::Lanes(d) <= plane.pixels + spare_words) {
        const WordVec lanes = hn::Set(d, static_cast<Word>(hn::Lanes(d)));
        const WordMask is_second = hn::Not(hn::Lt(group.behind_first, lanes));
        const auto index = hn::IndicesFromVec(d, hn::And(group.behind_first, hn::Sub(lanes, hn::Set(d, 1))));
        return hn::IfThenElse(is_second, hn::TableLookupLanes(hn::LoadU(d, words + hn::Lanes(d)), index),
                              hn::TableLookupLanes(hn::LoadU(d, words), index));
    }
    return hn::GatherIndex(d, plane.words, spare_index(plane, group.in_batch, group.pixel));
}

// Dead lanes keep their words. If all are dead, nothing is accessed.
HWY_INLINE void store(Plane plane, const LaneGroup& group, WordMask written, WordVec words) {
    const Words d;
    if (hn::AllFalse(d, written)) return;
    if (group.is_run) return hn::BlendedStore(words, written, d, plane.words + group.first);
    hn::ScatterIndex(words, d, plane.words, spare_index(plane, written, group.pixel));
}

HWY_INLINE WordMask is_set(const Word* alive) {
    const Words d;
    return hn::Ne(hn::LoadU(d, alive), hn::Zero(d));
}

// An alive lane is ~0, which is -1.
std::uint64_t count_set(const Word* alive, std::size_t count) {
    const Words d;
    const std::size_t whole = count - count % hn::Lanes(d);
    WordVec living = hn::Zero(d);
    for (std::size_t i = 0; i < whole; i += hn::Lanes(d)) living = hn::Sub(living, hn::LoadU(d, alive + i));
    if (whole < count)
        living = hn::Sub(living, hn::IfThenElseZero(first_lanes(count - whole), hn::LoadU(d, alive + whole)));
    return hn::GetLane(hn::SumOfLanes(d, living));
}

// The number of channels per word, and the mask of the lowest.
template <int channels, int bits>
constexpr int per_word = std::min(channels, 32 / bits);
template <int bits>
constexpr Word low_bits = ~0u >> (32 - bits);

// Calls body(channels, bits) with the layout of `texels` as constants.
template <class Body>
HWY_INLINE void with_layout(const Texels& texels, Body&& body) {
    constexpr auto of = [](int channels, int bits) { return channels * 64 + bits; };
    const auto as = [&]<int channels, int bits>() { body.template operator()<channels, bits>(); };
    switch (of(texels.channels, texels.bits_per_channel)) {
        case of(4, 8): return as.template operator()<4, 8>();
        case of(4, 16): return as.template operator()<4, 16>();
        case of(4, 32): return as.template operator()<4, 32>();
        case of(2, 32): return as.template operator()<2, 32>();
        case of(1, 32): return as.template operator()<1, 32>();
        case of(1, 16): return as.template operator()<1, 16>();
        case of(1, 8): return as.template operator()<1, 8>();
    }
    assert(!"every format has one of these layouts");
}

// Gathers the channels of one word at every pixel of the batch.
template <int channels, int bits>
HWY_INLINE void gather_word(Plane plane, const PixelLanes& at, CodeLanes* codes) {
    const Words d;
    for (std::size_t i = 0; i < at.count; i += hn::Lanes(d)) {
        const WordVec stored = load(plane, group_at(at, i));
        for (int k = 0; k < per_word<channels, bits>; ++k) {
            const WordVec code = hn::And(hn::ShiftRightSame(stored, k * bits), hn::Set(d, low_bits<bits>));
            hn::StoreU(code, d, &codes[k][i]);
        }
    }
}

void gather(const Texels& from, const PixelLanes& at, CodeLanes* codes) {
    with_layout(from, [&]<int channels, int bits>() {
        for (std::size_t word = 0; word < from.words(); ++word)
            gather_word<channels, bits>(from.plane(word), at, codes + word * per_word<channels, bits>);
    });
}

// `written` has the channels of this word to replace. If it has all of them, the stored words are not read.
template <int channels, int bits>
HWY_INLINE void scatter_word(Plane plane, const PixelLanes& at, const Word* alive, unsigned written,
                             const CodeLanes* codes) {
    const Words d;
    Word kept = 0;
    for (int k = 0; k < per_word<channels, bits>; ++k)
        if ((written >> k & 1u) == 0) kept |= low_bits<bits> << (k * bits);
    for (std::size_t i = 0; i < at.count; i += hn::Lanes(d)) {
        const LaneGroup group = group_at(at, i);
        WordVec value = hn::LoadU(d, &codes[0][i]);
        for (int k = 1; k < per_word<channels, bits>; ++k)
            value = hn::Or(value, hn::ShiftLeftSame(hn::LoadU(d, &codes[k][i]), k * bits));
        if (kept != 0)
            value = hn::Or(hn::AndNot(hn::Set(d, kept), value), hn::And(hn::Set(d, kept), load(plane, group)));
        store(plane, group, hn::And(group.in_batch, is_set(alive + i)), value);
    }
}

void scatter(const Texels& to, const PixelLanes& at, const Word* alive, unsigned mask, const CodeLanes* codes) {
    with_layout(to, [&]<int channels, int bits>() {
        constexpr int n = per_word<channels, bits>;
        for (std::size_t word = 0; word < to.words(); ++word)
            if (const unsigned written = mask >> (word * n) & ((1u << n) - 1); written != 0)
                scatter_word<channels, bits>(to.plane(word), at, alive, written, codes + word * n);
    });
}

// passes<func>(a, b) of compare.h; a NaN passes only `notequal`, which Highway's Ne does not guarantee on every
// instruction set.
template <CompareFunc func, class V>
HWY_INLINE auto compare(V a, V b) {
    if constexpr (func == CompareFunc::less) return hn::Lt(a, b);
    if constexpr (func == CompareFunc::greater) return hn::Lt(b, a);
    if constexpr (func == CompareFunc::equal) return hn::Eq(a, b);
    if constexpr (func == CompareFunc::notequal) return hn::Not(hn::Eq(a, b));
    if constexpr (func == CompareFunc::lequal) return hn::Or(hn::Lt(a, b), hn::Eq(a, b));
    if constexpr (func == CompareFunc::gequal) return hn::Or(hn::Lt(b, a), hn::Eq(a, b));
}

template <CompareFunc func>
HWY_INLINE WordMask passing(DepthFormat format, WordVec code, WordVec stored) {
    const Words d;
    const hn::Repartition<float, Words> df;
    if constexpr (func == CompareFunc::always) return hn::FirstN(d, hn::Lanes(d));
    if constexpr (func == CompareFunc::never) return hn::FirstN(d, 0);
    if constexpr (func != CompareFunc::always && func != CompareFunc::never) {
        if (format != DepthFormat::d32f) return compare<func>(code, stored);
        return hn::RebindMask(d, compare<func>(hn::BitCast(df, code), hn::BitCast(df, stored)));
    }
}

// Loads, compares, stores and counts in one loop over the lanes.
template <CompareFunc func>
DepthResult test(bool writes, DepthFormat format, Plane plane, const PixelLanes& at, const Word* codes, Word* alive) {
    const Words d;
    DepthResult result;
    for (std::size_t i = 0; i < at.count; i += hn::Lanes(d)) {
        const LaneGroup group = group_at(at, i);
        const WordVec code = hn::LoadU(d, codes + i);
        const WordMask arriving = hn::And(group.in_batch, is_set(alive + i));
        const WordMask passed = hn::And(arriving, passing<func>(format, code, load(plane, group)));
        hn::StoreU(hn::VecFromMask(d, passed), d, alive + i);
        result.arriving += hn::CountTrue(d, arriving);
        result.passed += hn::CountTrue(d, passed);
        if (writes) store(plane, group, passed, code);
    }
    return result;
}

DepthResult test_plane(const DepthTest& state, DepthFormat format, Plane plane, const PixelLanes& at, const Word* codes,
                       Word* alive) {
    DepthResult result;
    with_compare(state.enabled ? state.func : CompareFunc::always,
                 [&](auto func) { result = test<func()>(writes_depth(state), format, plane, at, codes, alive); });
    return result;
}

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2 && !defined(HWY_DISABLE_F16C)  // has_halves of half-inl.h
using Floats = hn::Repartition<float, Words>;
using FloatVec = hn::Vec<Floats>;

// Adds source and destination as blend_float.h does. A sum that is denormal in binary32 becomes a zero of its sign as a
// half, flushed or not; a denormal source must be flushed, because the sign of its zero affects the result.
template <bool flushes>
HWY_INLINE WordVec sum_of_halves(FloatVec source, WordVec stored) {
    const Words d;
    if constexpr (flushes) source = flushed(d, source);
    return half_codes(d, canonical(d, hn::Add(source, half_values(d, stored))));
}

template <bool flushes, int channels>
HWY_INLINE void add_to_word(Plane plane, const PixelLanes& at, const Word* alive,
                            const rasterizer::Lanes<float>* source) {
    const Words d;
    for (std::size_t i = 0; i < at.count; i += hn::Lanes(d)) {
        const LaneGroup group = group_at(at, i);
        const WordVec stored = load(plane, group);
        WordVec sum = sum_of_halves<flushes>(hn::LoadU(Floats{}, &source[0][i]), hn::And(stored, hn::Set(d, 0xffffu)));
        if constexpr (channels == 2) {
            const WordVec upper =
                sum_of_halves<flushes>(hn::LoadU(Floats{}, &source[1][i]), hn::ShiftRight<16>(stored));
            sum = hn::Or(sum, hn::ShiftLeft<16>(upper));
        }
        store(plane, group, hn::And(group.in_batch, is_set(alive + i)), sum);
    }
}

template <bool flushes>
void add_to_words(const Texels& to, const PixelLanes& at, const Word* alive, const rasterizer::Lanes<float>* source) {
    if (to.channels == 1) return add_to_word<flushes, 1>(to.plane(0), at, alive, source);
    for (std::size_t word = 0; word < to.words(); ++word)
        add_to_word<flushes, 2>(to.plane(word), at, alive, source + 2 * word);
}
#else
template <bool flushes>
void add_to_words(const Texels&, const PixelLanes&, const Word*, const rasterizer::Lanes<float>*) {}
#endif

// Returns false on instruction sets without half conversion, where add_to_words does nothing.
bool add(const Texels& to, const PixelLanes& at, const Word* alive, const rasterizer::Lanes<float>* source,
         bool flushes) {
    if (flushes)
        add_to_words<true>(to, at, alive, source);
    else
        add_to_words<false>(to, at, alive, source);
    return has_halves;
}

// The plain loops, compiled for this instruction set; arrays of a batch have room for whole vectors.
[[gnu::flatten]] void decode_lanes(ChannelType type, const std::uint32_t* codes, float* values, std::size_t count) {
    scalar::decode(type, codes, values, padded(count));
}

[[gnu::flatten]] void encode_lanes(ChannelType type, ColorRounding rounding, const float* values, std::uint32_t* codes,
                                   std::size_t count) {
    scalar::encode(type, rounding, values, codes, padded(count));
}

[[gnu::flatten]] void test_alpha(const AlphaTest& state, bool eight_bit, const float* alpha, std::uint32_t* alive,
                                 int count) {
    scalar::alpha_test(state, eight_bit, alpha, alive, count);
}

[[gnu::flatten]] int test_stencil(const StencilTest& state, const StencilLanes& lanes) {
    return scalar::stencil_test(state, lanes);
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {

STRATA_EXPORT(count_set);
STRATA_EXPORT(gather);
STRATA_EXPORT(scatter);
STRATA_EXPORT(test_plane);
STRATA_EXPORT(add);
STRATA_EXPORT(decode_lanes);
STRATA_EXPORT(encode_lanes);
STRATA_EXPORT(test_alpha);
STRATA_EXPORT(test_stencil);

std::uint64_t count_lanes(const Word* alive, std::size_t count) noexcept {
    return simd_is_scalar() ? scalar::count_lanes(alive, count)
                            : kernel_of(HWY_DISPATCH_TABLE(count_set))(alive, count);
}

void gather_codes(const Texels& from, const PixelLanes& at, CodeLanes* codes) noexcept {
    if (simd_is_scalar()) return scalar::gather_codes(from, at, codes);
    kernel_of(HWY_DISPATCH_TABLE(gather))(from, at, codes);
}

void scatter_codes(const Texels& to, const PixelLanes& at, const Word* alive, unsigned mask,
                   const CodeLanes* codes) noexcept {
    if (simd_is_scalar()) return scalar::scatter_codes(to, at, alive, mask, codes);
    kernel_of(HWY_DISPATCH_TABLE(scatter))(to, at, alive, mask, codes);
}

DepthResult test_depth(const DepthTest& state, DepthFormat format, Plane plane, const PixelLanes& at, const Word* code,
                       Word* alive) noexcept {
    if (simd_is_scalar()) return scalar::test_depth(state, format, plane, at, code, alive);
    return kernel_of(HWY_DISPATCH_TABLE(test_plane))(state, format, plane, at, code, alive);
}

bool add_halves(const Texels& to, const PixelLanes& at, const Word* alive, const rasterizer::Lanes<float>* source,
                bool flushes) noexcept {
    return !simd_is_scalar() && kernel_of(HWY_DISPATCH_TABLE(add))(to, at, alive, source, flushes);
}

void decode(ChannelType type, const rasterizer::Lanes<std::uint32_t>& codes, rasterizer::Lanes<float>& values,
            int count) noexcept {
    const auto n = static_cast<std::size_t>(count);
    if (simd_is_scalar()) return scalar::decode(type, codes.data(), values.data(), n);
    kernel_of(HWY_DISPATCH_TABLE(decode_lanes))(type, codes.data(), values.data(), n);
}

void encode(ChannelType type, ColorRounding rounding, const rasterizer::Lanes<float>& values,
            rasterizer::Lanes<std::uint32_t>& codes, int count) noexcept {
    const auto n = static_cast<std::size_t>(count);
    if (simd_is_scalar()) return scalar::encode(type, rounding, values.data(), codes.data(), n);
    kernel_of(HWY_DISPATCH_TABLE(encode_lanes))(type, rounding, values.data(), codes.data(), n);
}

void alpha_test(const AlphaTest& state, bool eight_bit, const float* alpha, std::uint32_t* alive, int count) noexcept {
    if (simd_is_scalar()) return scalar::alpha_test(state, eight_bit, alpha, alive, count);
    kernel_of(HWY_DISPATCH_TABLE(test_alpha))(state, eight_bit, alpha, alive, count);
}

int stencil_test(const StencilTest& state, const StencilLanes& lanes) noexcept {
    if (simd_is_scalar()) return scalar::stencil_test(state, lanes);
    return kernel_of(HWY_DISPATCH_TABLE(test_stencil))(state, lanes);
}

}  // namespace strata::pipeline
#endif
