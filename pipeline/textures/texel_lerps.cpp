// pipeline/textures/texel_lerps.cpp - lookups by linear interpolations of texels (texel_lerps.h).
#include "pipeline/textures/texel_lerps.h"

#include "pipeline/formats/srgb_mesa.h"
#include "pipeline/textures/texel_pair.h"

namespace strata::pipeline {
namespace {

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
