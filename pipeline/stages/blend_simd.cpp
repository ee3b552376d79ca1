// pipeline/stages/blend_simd.cpp - blending, one source for every instruction set: the loops of blend_lanes.h inlined
// (flatten) and compiled per instruction set over whole vectors, because the arrays of a batch have room for them. How
// kernels are written: rasterizer/reference/kernels.md. Tests: tests/pipeline/stages/simd_stages_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/stages/blend_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/formats/half-inl.h"
#include "pipeline/stages/blend_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2 && !defined(HWY_DISABLE_F16C)  // has_halves of half-inl.h
struct HalfWords {
    using Words = hn::ScalableTag<std::uint32_t>;
    using Floats = hn::RebindToFloat<Words>;

    static void decode(const std::uint32_t* codes, float* HWY_RESTRICT values, std::size_t count) {
        for (std::size_t i = 0; i < count; i += hn::Lanes(Words{}))
            hn::StoreU(half_values(Words{}, hn::LoadU(Words{}, codes + i)), Floats{}, values + i);
    }
    static void encode_nearest(const float* values, std::uint32_t* HWY_RESTRICT codes, std::size_t count) {
        for (std::size_t i = 0; i < count; i += hn::Lanes(Words{}))
            hn::StoreU(half_codes(Words{}, hn::LoadU(Floats{}, values + i)), Words{}, codes + i);
    }
};
#else
using HalfWords = scalar::PlainHalves;
#endif

// Processes whole vectors of up to 16 lanes; results past the count are scratch.
[[gnu::flatten]] void blend_lanes(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels,
                                  const scalar::ColorLanes& src, scalar::ColorCodes& codes, int count) {
    const std::size_t whole_vectors = (static_cast<std::size_t>(count) + 15) & ~std::size_t{15};
    scalar::blend<HalfWords>(state, type, profile, channels, src, codes, whole_vectors);
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "pipeline/formats/dither.h"
#include "pipeline/formats/packed.h"
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {

STRATA_EXPORT(blend_lanes);

void blend(const Blend& state, ChannelType type, const DeviceProfile& profile, int channels,
           const scalar::ColorLanes& src, scalar::ColorCodes& codes, int count) noexcept {
    if (simd_is_scalar())
        return scalar::blend(state, type, profile, channels, src, codes, static_cast<std::size_t>(count));
    kernel_of(HWY_DISPATCH_TABLE(blend_lanes))(state, type, profile, channels, src, codes, count);
}

namespace {

// Mesa's llvmpipe: rgb10_a2 in codes of 16 bits.
bool blends_in_16_bits(Format format, const DeviceProfile& profile) noexcept {
    return format == Format::rgb10_a2 && profile.unorm_rounding == UnormRounding::product_even &&
           profile.blend_storage == BlendStorage::target;
}

void blend_unorm16(const Blend& state, const scalar::ColorLanes& src, scalar::ColorCodes& codes, int count) noexcept {
    const auto lanes = static_cast<std::size_t>(count);
    const auto wide = [](float x) { return static_cast<float>(to_unorm_code(x, 65535, UnormRounding::product_even)); };
    alignas(64) scalar::ColorLanes s, d;
    std::array<float, 4> constant{};
    for (int channel = 0; channel < 4; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        constant[c] = wide(state.constant[c]);
        for (std::size_t i = 0; i < lanes; ++i) {
            s[c][i] = wide(src[c][i]);
            d[c][i] = state.enabled ? static_cast<float>(widened_to_16(channel, codes[c][i])) : 0.0f;
        }
    }
    const auto keep = [&](std::size_t c, const rasterizer::Lanes<float>& out) {
        for (std::size_t i = 0; i < lanes; ++i)
            codes[c][i] = shortened_from_16(static_cast<int>(c), static_cast<std::uint32_t>(out[i]));
    };
    Blend used = state;
    if (!state.enabled) used.color = used.alpha = BlendTerm{};  // ONE and ZERO
    scalar::blend_channels<Unorm16Arithmetic>({used, 4, src, codes, lanes}, constant, s, d, keep);
}

void blend_packed(Format format, const Blend& state, const DeviceProfile& profile, const scalar::ColorLanes& src,
                  scalar::ColorCodes& codes, int count) noexcept {
    const ColorRounding rounding = profile.color_rounding();
    const auto lanes = static_cast<std::size_t>(count);
    const bool clamps = info(format).type != ChannelType::half;
    Blend used = state;
    scalar::ColorLanes source{};
    scalar::ColorCodes words{};
    for (int channel = 0; channel < 4; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        if (clamps) used.constant[c] = unorm_clamped(state.constant[c]);
        for (std::size_t i = 0; i < lanes; ++i) {
            source[c][i] = clamps ? unorm_clamped(src[c][i]) : src[c][i];
            if (state.enabled)
                words[c][i] = std::bit_cast<std::uint32_t>(packed_value(format, channel, codes[c][i], rounding));
        }
    }
    blend(used, ChannelType::single, profile, 4, source, words, count);
    for (int channel = 0; channel < 4; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        if ((state.write_mask >> channel & 1u) == 0) continue;
        for (std::size_t i = 0; i < lanes; ++i)
            codes[c][i] = packed_code(format, channel, std::bit_cast<float>(words[c][i]), rounding);
    }
}

}  // namespace

void blend_into(Format format, const Blend& state, const DeviceProfile& profile, const scalar::ColorLanes& src,
                scalar::ColorCodes& codes, int count) noexcept {
    if (blends_in_16_bits(format, profile)) return blend_unorm16(state, src, codes, count);
    if (is_packed(format)) return blend_packed(format, state, profile, src, codes, count);
    blend(state, info(format).type, profile, info(format).channels, src, codes, count);
}

void finish_codes(Format format, const Blend& state, const scalar::ColorLanes& src, const DitherLanes& at,
                  scalar::ColorCodes& codes, int count) noexcept {
    const ChannelType type = info(format).type;
    const bool is_fixed = type == ChannelType::unorm8 || type == ChannelType::unorm10;
    if (!is_fixed || format == Format::srgb8_alpha8) return;
    const int greatest = type == ChannelType::unorm10 ? 1023 : 255;
    for (int channel = 0; channel < info(format).channels; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            std::uint32_t& code = codes[c][i];
            const std::uint32_t pattern = state.dither ? dither_pattern(at.x[i], at.y[i]) : 0;
            if (state.dither && !state.blends() && !is_narrow(format))
                code = format == Format::rgb10_a2 && channel == 3 ? dithered(src[c][i], 3, pattern) * 341
                                                                  : dithered(src[c][i], greatest, pattern);
            if (is_narrow(format)) code = dithered_narrow(format, channel, code, pattern);
            if (state.logic_op)
                code = narrowed(format, channel,
                                combined(*state.logic_op, code, at.stored[c][i], static_cast<std::uint32_t>(greatest)));
        }
    }
}

}  // namespace strata::pipeline
#endif
