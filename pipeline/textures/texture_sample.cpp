// pipeline/textures/texture_sample.cpp - nearest and bilinear colour lookups for a batch (texture_sample.h).
#include "pipeline/textures/texture_sample.h"

#include "pipeline/formats/srgb.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/textures/texel_address.h"
#include "pipeline/textures/texel_lerps.h"

namespace strata::pipeline {
namespace {

using rasterizer::Lanes;
using ColorLanes = std::array<Lanes<float>, 4>;

// The four texels of a lookup, each four bytes r g b a.
struct Footprint {
    const std::uint8_t *t00, *t10, *t01, *t11;
};

// A texture and the texels of each lane's lookup; nearest lookups use only `first`.
struct TextureLookup {
    const Texture& texture;
    TexelLanes s, t;

    [[nodiscard]] const std::uint8_t* texel(std::int32_t column, std::int32_t row) const noexcept {
        const auto place =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(column);
        return texture.texels.data() + 4 * place;
    }
    [[nodiscard]] const std::uint8_t* nearest(std::size_t i) const noexcept { return texel(s.first[i], t.first[i]); }
    [[nodiscard]] Footprint footprint(std::size_t i) const noexcept {
        return {texel(s.first[i], t.first[i]), texel(s.second[i], t.first[i]), texel(s.first[i], t.second[i]),
                texel(s.second[i], t.second[i])};
    }
    [[nodiscard]] BilinearWeights weights(std::size_t i) const noexcept {
        return bilinear_weights(s.fraction[i], t.fraction[i]);
    }
};

// The values of texel bytes: one table per channel.
using Decoder = std::array<const float*, 4>;

Decoder decoder(const Texture& texture) noexcept {
    const float* const color = texture.decode_srgb ? srgb_to_linear.data() : unorm8_table.data();
    return {color, color, color, unorm8_table.data()};
}

void sample_nearest(const TextureLookup& lookup, const Decoder& decode, ColorLanes& rgba, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* const texel = lookup.nearest(i);
        for (std::size_t c = 0; c < 4; ++c) rgba[c][i] = decode[c][texel[c]];
    }
}

void sample_bilinear(const TextureLookup& lookup, const Decoder& decode, ColorLanes& rgba, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const Footprint f = lookup.footprint(i);
        const BilinearWeights w = lookup.weights(i);
        for (std::size_t c = 0; c < 4; ++c)
            rgba[c][i] =
                bilinear(w, decode[c][f.t00[c]], decode[c][f.t10[c]], decode[c][f.t01[c]], decode[c][f.t11[c]]);
    }
}

// The exact sum of 8-bit texels, rounded once.
void sample_bilinear_unorm8(const TextureLookup& lookup, ColorLanes& rgba, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const Footprint f = lookup.footprint(i);
        const BilinearWeights w = lookup.weights(i);
        for (std::size_t c = 0; c < 4; ++c) {
            const std::int32_t sum = f.t00[c] * w.w00 + f.t10[c] * w.w10 + f.t01[c] * w.w01 + f.t11[c] * w.w11;
            rgba[c][i] = unorm8_table[static_cast<std::size_t>((sum + 32768) >> 16)];
        }
    }
}

// texture_filter unorm8 after sRGB decoding: the binary32 result is rounded to 8 bits here, its only rounding
// (pipeline/reference/texturing.md 3.2).
void round_to_unorm8(ColorLanes& rgba, std::size_t count) noexcept {
    for (Lanes<float>& channel : rgba)
        for (std::size_t i = 0; i < count; ++i) channel[i] = from_unorm8(to_unorm8(channel[i]));
}

}  // namespace

void sample(const Texture& texture, TextureFilterPrecision precision, const Lanes<float>& s, const Lanes<float>& t,
            ColorLanes& rgba, int count) noexcept {
    using enum TextureFilterPrecision;
    if (precision == code_lerps || precision == code_lerps_fused || precision == single_lerps)
        return sample_lerps(texture, precision, s, t, rgba, count);
    const TexelAxis s_axis{texture.target, texture.wrap_s, texture.width};
    const TexelAxis t_axis{texture.target, texture.wrap_t, texture.height};
    const bool is_unorm8 = precision == unorm8;
    const auto n = static_cast<std::size_t>(count);
    TextureLookup lookup{texture, {}, {}};
    if (texture.filter == TextureFilter::nearest) {
        nearest_texels(s_axis, point_snap(precision), s, lookup.s, count);
        nearest_texels(t_axis, point_snap(precision), t, lookup.t, count);
        sample_nearest(lookup, decoder(texture), rgba, n);
    } else {
        linear_texels(s_axis, s, lookup.s, count);
        linear_texels(t_axis, t, lookup.t, count);
        if (is_unorm8 && !texture.decode_srgb) return sample_bilinear_unorm8(lookup, rgba, n);
        sample_bilinear(lookup, decoder(texture), rgba, n);
    }
    if (is_unorm8 && texture.decode_srgb) round_to_unorm8(rgba, n);
}

}  // namespace strata::pipeline
