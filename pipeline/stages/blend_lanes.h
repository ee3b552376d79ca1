// pipeline/stages/blend_lanes.h - the loops of blend.h over the fragments of a batch. blend_simd.cpp, which alone
// includes this file, compiles them once per instruction set by inlining.
//
// Rule     Every instruction set gives the same bits.
// Tests    tests/pipeline/stages/simd_stages_test.cpp, blend_float_test.cpp, blend_unorm8_test.cpp
#pragma once
#include <bit>

#include "pipeline/formats/convert.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/stages/blend.h"
#include "pipeline/stages/blend_float.h"
#include "pipeline/stages/blend_kernels.h"
#include "pipeline/stages/blend_unorm8.h"

namespace strata::pipeline {
inline namespace strict {
namespace scalar {

using rasterizer::Lanes;
using ColorLanes = std::array<Lanes<float>, 4>;
using ColorCodes = std::array<Lanes<std::uint32_t>, 4>;

// The arguments of one blend of a batch; counts and masks as in `blend`.
struct BlendJob {
    const Blend& state;
    int channels;
    const ColorLanes& src;
    ColorCodes& codes;
    std::size_t count;

    [[nodiscard]] bool writes(int channel) const noexcept {
        return channel < channels && ((state.write_mask >> channel) & 1u) != 0;
    }
};

// Conversion between halves and binary32, rounding to nearest even. A kernel may substitute hardware instructions even
// if they make a signalling NaN quiet, because the only NaN that leaves a blend is the canonical one.
struct PlainHalves {
    static void decode(const std::uint32_t* codes, float* values, std::size_t count) noexcept {
        scalar::decode(ChannelType::half, codes, values, count);
    }
    static void encode_nearest(const float* values, std::uint32_t* codes, std::size_t count) noexcept {
        encode_half<HalfRounding::nearest_even>(values, codes, count);
    }
};

// The values of stored halves; `Halves` implements only formats with an infinity.
template <class Halves>
void widen(HalfRounding rounding, const std::uint32_t* codes, float* values, std::size_t count) noexcept {
    if (rounding != HalfRounding::no_infinity) return Halves::decode(codes, values, count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = half_value<HalfRounding::no_infinity>(static_cast<std::uint16_t>(codes[i]));
}

// The rounding of a store; `Halves` implements only round to nearest even.
template <class Halves>
void store(ChannelType type, ColorRounding rounding, const float* values, std::uint32_t* codes,
           std::size_t count) noexcept {
    if (type == ChannelType::half && rounding.half == HalfRounding::nearest_even)
        return Halves::encode_nearest(values, codes, count);
    encode(type, rounding, values, codes, count);
}

// Converts the lanes of a batch one by one to operands of the arithmetic.
template <class T>
void load(const Lanes<T>& source, Lanes<float>& operand, std::size_t count, auto convert) noexcept {
    for (std::size_t i = 0; i < count; ++i) operand[i] = convert(source[i]);
}

// Blends the loaded operands and passes the results to store(channel, lanes). Alpha is last, because the colours read
// the stored alpha.
template <class Arithmetic>
void blend_channels(const BlendJob& job, const std::array<float, 4>& constant, const ColorLanes& s, const ColorLanes& d,
                    auto store) noexcept {
    alignas(64) Lanes<float> out;
    for (int channel = 0; channel < 4; ++channel) {
        if (!job.writes(channel)) continue;
        const auto c = static_cast<std::size_t>(channel);
        const bool is_alpha = channel == 3;
        const BlendOperands operands{s[c], d[c], s[3], d[3], constant[c], constant[3], is_alpha};
        blend_channel<Arithmetic>(is_alpha ? job.state.alpha : job.state.color, operands, out, job.count);
        store(c, out);
    }
}

// 8-bit targets: codes are loaded as integers in binary32, blended, and stored again.
template <BlendRounding rounding, UnormRounding to_code>
void blend_unorm8(const BlendJob& job) noexcept {
    alignas(64) ColorLanes s, d;
    std::array<float, 4> constant{};
    for (int channel = 0; channel < 4; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        constant[c] = static_cast<float>(to_unorm8<to_code>(job.state.constant[c]));
        if (job.writes(channel) || channel == 3)
            load(job.src[c], s[c], job.count, [](float x) { return static_cast<float>(int{to_unorm8<to_code>(x)}); });
        // The mask is for lanes past the batch, which fill up a vector and may have any 32 bits.
        if (channel < job.channels)
            load(job.codes[c], d[c], job.count,
                 [](std::uint32_t code) { return static_cast<float>(static_cast<int>(code & 0xff)); });
    }
    // Destination alpha of a target without alpha is 1.
    if (job.channels < 4) d[3].fill(255.0f);
    blend_channels<Unorm8Arithmetic<rounding>>(job, constant, s, d, [&](std::size_t c, const Lanes<float>& out) {
        for (std::size_t i = 0; i < job.count; ++i)
            job.codes[c][i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(out[i]));
    });
}

// BlendRounding::unrounded_source: values in binary32, one rounding per operation, converted to a code at the end. No
// operand is a NaN, or a denormal that could affect a code.
inline void blend_unrounded(const BlendJob& job, UnormRounding to_code) noexcept {
    alignas(64) ColorLanes s, d;
    std::array<float, 4> constant{};
    for (int channel = 0; channel < 4; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        constant[c] = unorm_clamped(job.state.constant[c]);
        if (job.writes(channel) || channel == 3) load(job.src[c], s[c], job.count, unorm_clamped);
        if (channel < job.channels)
            load(job.codes[c], d[c], job.count, [=](std::uint32_t code) { return code_value(code & 0xff, to_code); });
    }
    if (job.channels < 4) d[3].fill(1.0f);
    using Arithmetic = FloatArithmetic<DenormalRule::keep, MinMaxNan::destination>;
    blend_channels<Arithmetic>(job, constant, s, d, [&](std::size_t c, const Lanes<float>& out) {
        encode(ChannelType::unorm8, {HalfRounding::nearest_even, to_code}, out.data(), job.codes[c].data(), job.count);
    });
}

template <UnormRounding to_code>
void blend_unorm8(const BlendJob& job, BlendRounding rounding) noexcept {
    switch (rounding) {
        case BlendRounding::nearest: return blend_unorm8<BlendRounding::nearest, to_code>(job);
        case BlendRounding::truncate: return blend_unorm8<BlendRounding::truncate, to_code>(job);
        case BlendRounding::each_product: return blend_unorm8<BlendRounding::each_product, to_code>(job);
        case BlendRounding::unrounded_source: return blend_unrounded(job, to_code);
    }
}

// Float targets: operands are widened and flushed once, each result is rounded to its format once.
template <class Halves, DenormalRule denormals, MinMaxNan nan_rule>
void blend_float(const BlendJob& job, ChannelType type, HalfRounding rounding) noexcept {
    const auto flush = [](float x) { return flushed<denormals>(x); };
    alignas(64) ColorLanes s, d;
    std::array<float, 4> constant{};
    for (int channel = 0; channel < 4; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        constant[c] = flush(job.state.constant[c]);
        if (job.writes(channel) || channel == 3) load(job.src[c], s[c], job.count, flush);
        if (channel >= job.channels) continue;
        if (type == ChannelType::single) {
            load(job.codes[c], d[c], job.count, [&](std::uint32_t code) { return flush(std::bit_cast<float>(code)); });
        } else {
            widen<Halves>(rounding, job.codes[c].data(), d[c].data(), job.count);  // never denormal
        }
    }
    if (job.channels < 4) d[3].fill(1.0f);
    blend_channels<FloatArithmetic<denormals, nan_rule>>(
        job, constant, s, d, [&](std::size_t c, const Lanes<float>& out) {
            store<Halves>(type, rounding, out.data(), job.codes[c].data(), job.count);
        });
}

template <class Halves>
void blend_float(const BlendJob& job, ChannelType type, const DeviceProfile& profile) noexcept {
    using enum DenormalRule;
    using enum MinMaxNan;
    const auto by = [&]<DenormalRule denormals>() {
        switch (profile.min_max_nan) {
            case other_operand: return blend_float<Halves, denormals, other_operand>(job, type, profile.half_rounding);
            case propagate: return blend_float<Halves, denormals, propagate>(job, type, profile.half_rounding);
            case destination: return blend_float<Halves, denormals, destination>(job, type, profile.half_rounding);
        }
    };
    profile.denormals == flush ? by.template operator()<flush>() : by.template operator()<keep>();
}

// With blending off the colour is only converted: nothing is flushed, and NaN keeps its sign
// (pipeline/reference/fragment-stages.md 9.2).
template <class Halves = PlainHalves>
void blend(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels, const ColorLanes& src,
           ColorCodes& codes, std::size_t count) noexcept {
    const BlendJob job{state, channels, src, codes, count};
    if (!state.enabled) {
        for (std::size_t c = 0; c < 4; ++c)
            if (job.writes(static_cast<int>(c)))
                store<Halves>(type, profile.color_rounding(), src[c].data(), codes[c].data(), count);
    } else if (type != ChannelType::unorm8) {
        blend_float<Halves>(job, type, profile);
    } else if (profile.unorm_rounding == UnormRounding::half_up) {
        blend_unorm8<UnormRounding::half_up>(job, profile.blend_rounding);
    } else if (profile.blend_rounding == BlendRounding::unrounded_source) {
        blend_unrounded(job, profile.unorm_rounding);  // the rounding also determines the values of codes
    } else {
        blend_unorm8<UnormRounding::product_even>(job, profile.blend_rounding);
    }
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::pipeline
