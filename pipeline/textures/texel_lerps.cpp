// pipeline/textures/texel_lerps.cpp - lookups by linear interpolations of texels (texel_lerps.h): the two texels
// of an axis as Mesa's drivers find them (gallivm/lp_bld_sample_soa.c, softpipe/sp_tex_sample.c), and their mixture.
#include "pipeline/textures/texel_lerps.h"

#include <cmath>

#include "pipeline/formats/srgb_mesa.h"
#include "pipeline/textures/texel_address.h"

namespace strata::pipeline {
namespace {

// Two texels along an axis, and the weight of the second: in units of 1/256 if texels are mixed as codes.
struct TexelPair {
    std::int32_t first = 0, second = 0, weight_256 = 0;
    float weight = 0;
};

// llvmpipe has two ways: codes of RGBA8 that repeat or clamp on both axes, and floats for everything else.
enum class LerpAddress : std::uint8_t { codes, floats, softpipe };

float whole_part(float x) noexcept { return static_cast<float>(floor_of(x)); }

bool clamps(const TexelAxis& axis) noexcept {
    return axis.target == TextureTarget::rectangle || axis.wrap == TextureWrap::clamp_to_edge;
}
bool mirrors(const TexelAxis& axis) noexcept {
    return axis.target == TextureTarget::two_d && axis.wrap == TextureWrap::mirrored_repeat;
}
bool is_power_of_two(int size) noexcept { return (size & (size - 1)) == 0; }

// The texel of v and the next one, by the axis's own wrapping.
TexelPair pair_at(const TexelAxis& axis, float v) noexcept {
    const std::int64_t first = floor_of(v);
    return {.first = wrapped(axis, first), .second = wrapped(axis, first + 1), .weight = v - whole_part(v)};
}

// The same with texels outside replaced by the first or the last one.
TexelPair clamped_pair(const TexelAxis& axis, float v) noexcept {
    return pair_at({.target = TextureTarget::rectangle, .size = axis.size}, v);
}

// llvmpipe mirrors the coordinate to 2 |c/2 - nearest_even(c/2)|, in [0, 1].
TexelPair mirrored_by_llvmpipe(const TexelAxis& axis, TextureFilter filter, float c) noexcept {
    const float half = c * 0.5f, rest = half - static_cast<float>(nearest_even_of(half));
    const float u = std::fabs(rest + rest) * static_cast<float>(axis.size);
    return clamped_pair(axis, filter == TextureFilter::linear ? u - 0.5f : u);
}

// softpipe takes the fraction, or in every second copy 1 less it, where the second texel is the one before the first.
TexelPair mirrored_by_softpipe(const TexelAxis& axis, TextureFilter filter, float c) noexcept {
    const auto size = static_cast<float>(axis.size);
    const float fraction = c - whole_part(c);
    const bool is_reversed = (floor_of(c) & 1) != 0;
    const float m = is_reversed ? 1.0f - fraction : fraction;
    if (filter == TextureFilter::nearest) {
        const float least = 1.0f / (2.0f * size);
        return {.first = m < least ? 0 : m > 1.0f - least ? axis.size - 1 : clamped_pair(axis, m * size).first};
    }
    if (!is_reversed) return clamped_pair(axis, m * size - 0.5f);
    const float u = m * size + 0.5f, beyond = 1.0f - u;
    const std::int64_t first = floor_of(u);
    const TexelAxis clamped{.target = TextureTarget::rectangle, .size = axis.size};
    return {
        .first = wrapped(clamped, first), .second = wrapped(clamped, first - 1), .weight = beyond - whole_part(beyond)};
}

// `coordinate` may be any value: NaN is treated as 0, values beyond +-2^31 as +-2^31.
TexelPair texel_pair(const TexelAxis& axis, LerpAddress address, TextureFilter filter, float coordinate) noexcept {
    float c = coordinate == coordinate ? std::clamp(coordinate, -0x1p31f, 0x1p31f) : 0.0f;
    if (mirrors(axis))
        return address == LerpAddress::softpipe ? mirrored_by_softpipe(axis, filter, c)
                                                : mirrored_by_llvmpipe(axis, filter, c);
    if (axis.target == TextureTarget::two_d) {
        const bool takes_fraction = address != LerpAddress::softpipe && !clamps(axis) && !is_power_of_two(axis.size);
        if (takes_fraction) c -= whole_part(c);
        c *= static_cast<float>(axis.size);
    }
    if (filter == TextureFilter::nearest) return {.first = wrapped(axis, floor_of(c))};
    if (address == LerpAddress::codes) {
        const std::int64_t p = nearest_even_of(256.0 * double{c}) - 128;
        return {wrapped(axis, p >> 8), wrapped(axis, (p >> 8) + 1), static_cast<std::int32_t>(p & 255)};
    }
    if (!clamps(axis)) return pair_at(axis, c - 0.5f);
    const auto size = static_cast<float>(axis.size);
    if (address == LerpAddress::floats) return pair_at(axis, std::max(std::min(c, size) - 0.5f, 0.0f));
    return pair_at(axis, std::clamp(c, 0.5f, size - 0.5f) - 0.5f);
}

using Rule = TextureFilterPrecision;
using rasterizer::Lanes;

constexpr float of_code = 1.0f / 255.0f;

// How a texture is read: the way its texels are found, and the values of its codes if they are sRGB.
struct Reading {
    LerpAddress address;
    bool is_fused;
    const std::array<float, 256>& decoded;
};

bool is_mirrored(const Texture& texture) noexcept {
    return texture.target == TextureTarget::two_d &&
           (texture.wrap_s == TextureWrap::mirrored_repeat || texture.wrap_t == TextureWrap::mirrored_repeat);
}

Reading reading_of(const Texture& texture, Rule rule) noexcept {
    if (rule == Rule::single_lerps) return {LerpAddress::softpipe, false, srgb_in_8_digits};
    const bool is_fused = rule == Rule::code_lerps_fused;
    const bool has_codes = !texture.decode_srgb && !is_mirrored(texture);
    return {has_codes ? LerpAddress::codes : LerpAddress::floats, is_fused,
            is_fused ? srgb_cubic<true> : srgb_cubic<false>};
}

std::int32_t lerp(std::int32_t weight_256, std::int32_t a, std::int32_t b) noexcept {
    return a + ((weight_256 * (b - a) + 128) >> 8);
}

float lerp(bool is_fused, float weight, float a, float b) noexcept {
    return is_fused ? multiply_add<true>(weight, b - a, a) : multiply_add<false>(weight, b - a, a);
}

}  // namespace

void sample_lerps(const Texture& texture, Rule rule, const Lanes<float>& s, const Lanes<float>& t,
                  std::array<Lanes<float>, 4>& rgba, int count) noexcept {
    const Reading reading = reading_of(texture, rule);
    const TexelAxis s_axis{texture.target, texture.wrap_s, texture.width};
    const TexelAxis t_axis{texture.target, texture.wrap_t, texture.height};
    const auto texel = [&](std::int32_t column, std::int32_t row) {
        return texture.texels.data() + 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) +
                                            static_cast<std::size_t>(column));
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const TexelPair x = texel_pair(s_axis, reading.address, texture.filter, s[i]),
                        y = texel_pair(t_axis, reading.address, texture.filter, t[i]);
        const std::uint8_t* const t00 = texel(x.first, y.first);
        const std::uint8_t* const t10 = texel(x.second, y.first);
        const std::uint8_t* const t01 = texel(x.first, y.second);
        const std::uint8_t* const t11 = texel(x.second, y.second);
        for (std::size_t c = 0; c < 4; ++c) {
            const auto value = [&](std::uint8_t code) {
                return texture.decode_srgb && c < 3 ? reading.decoded[code] : static_cast<float>(code) * of_code;
            };
            const auto mix = [&](float weight, float a, float b) { return lerp(reading.is_fused, weight, a, b); };
            if (texture.filter == TextureFilter::nearest)
                rgba[c][i] = value(t00[c]);
            else if (reading.address == LerpAddress::codes)
                rgba[c][i] = static_cast<float>(lerp(y.weight_256, lerp(x.weight_256, t00[c], t10[c]),
                                                     lerp(x.weight_256, t01[c], t11[c]))) *
                             of_code;
            else
                rgba[c][i] = mix(y.weight, mix(x.weight, value(t00[c]), value(t10[c])),
                                 mix(x.weight, value(t01[c]), value(t11[c])));
        }
    }
}

}  // namespace strata::pipeline
