// pipeline/textures/texel_lerps.cpp - lookups by linear interpolations of texels (texel_lerps.h).
#include "pipeline/textures/texel_lerps.h"

#include "pipeline/formats/srgb.h"
#include "pipeline/textures/texel_address.h"

namespace strata::pipeline {
namespace {

using Rule = TextureFilterPrecision;

// Two texels along an axis, and the weight of the second: in units of 1/256 under code_lerps.
struct TexelPair {
    std::int32_t first = 0, second = 0, weight_256 = 0;
    float weight = 0;
};

float whole_part(float x) noexcept { return static_cast<float>(floor_of(x)); }

bool clamps(const TexelAxis& axis) noexcept {
    return axis.target == TextureTarget::rectangle || axis.wrap == TextureWrap::clamp_to_edge;
}

// u of the rule. NaN is treated as 0, values beyond +-2^31 as +-2^31, as in texel_address.h.
float position(const TexelAxis& axis, Rule rule, float coordinate) noexcept {
    float c = coordinate == coordinate ? std::clamp(coordinate, -0x1p31f, 0x1p31f) : 0.0f;
    if (axis.target == TextureTarget::rectangle) return c;
    const bool is_power_of_two = (axis.size & (axis.size - 1)) == 0;
    if (rule == Rule::code_lerps && axis.wrap == TextureWrap::repeat && !is_power_of_two) c -= whole_part(c);
    return c * static_cast<float>(axis.size);
}

TexelPair pair_of(const TexelAxis& axis, Rule rule, TextureFilter filter, float coordinate) noexcept {
    float u = position(axis, rule, coordinate);
    if (filter == TextureFilter::nearest) return {.first = wrapped(axis, floor_of(u))};
    if (rule == Rule::code_lerps) {
        const std::int64_t p = nearest_even_of(256.0 * double{u}) - 128;
        return {wrapped(axis, p >> 8), wrapped(axis, (p >> 8) + 1), static_cast<std::int32_t>(p & 255)};
    }
    if (clamps(axis)) u = std::clamp(u, 0.5f, static_cast<float>(axis.size) - 0.5f);
    const float v = u - 0.5f;
    const std::int64_t first = floor_of(v);
    return {.first = wrapped(axis, first), .second = wrapped(axis, first + 1), .weight = v - whole_part(v)};
}

std::int32_t lerp(std::int32_t weight_256, std::int32_t a, std::int32_t b) noexcept {
    return a + ((weight_256 * (b - a) + 128) >> 8);
}

float lerp(float weight, float a, float b) noexcept {
    const float share = weight * (b - a);
    return a + share;
}

}  // namespace

void sample_lerps(const Texture& texture, Rule rule, const rasterizer::Lanes<float>& s,
                  const rasterizer::Lanes<float>& t, std::array<rasterizer::Lanes<float>, 4>& rgba,
                  int count) noexcept {
    constexpr float of_code = 1.0f / 255.0f;
    const Rule used = texture.decode_srgb ? Rule::single_lerps : rule;  // decoded texels have no codes
    const TexelAxis s_axis{texture.target, texture.wrap_s, texture.width};
    const TexelAxis t_axis{texture.target, texture.wrap_t, texture.height};
    const auto texel = [&](std::int32_t column, std::int32_t row) {
        return texture.texels.data() + 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) +
                                            static_cast<std::size_t>(column));
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const TexelPair x = pair_of(s_axis, used, texture.filter, s[i]),
                        y = pair_of(t_axis, used, texture.filter, t[i]);
        const std::uint8_t* const t00 = texel(x.first, y.first);
        const std::uint8_t* const t10 = texel(x.second, y.first);
        const std::uint8_t* const t01 = texel(x.first, y.second);
        const std::uint8_t* const t11 = texel(x.second, y.second);
        for (std::size_t c = 0; c < 4; ++c) {
            const auto value = [&](std::uint8_t code) {
                return texture.decode_srgb && c < 3 ? srgb_to_linear[code] : static_cast<float>(code) * of_code;
            };
            if (texture.filter == TextureFilter::nearest)
                rgba[c][i] = value(t00[c]);
            else if (used == Rule::code_lerps)
                rgba[c][i] = static_cast<float>(lerp(y.weight_256, lerp(x.weight_256, t00[c], t10[c]),
                                                     lerp(x.weight_256, t01[c], t11[c]))) *
                             of_code;
            else
                rgba[c][i] = lerp(y.weight, lerp(x.weight, value(t00[c]), value(t10[c])),
                                  lerp(x.weight, value(t01[c]), value(t11[c])));
        }
    }
}

}  // namespace strata::pipeline
