// peeling/truth/real_texture.cpp - texture lookups in binary64 (real_texture.h).
#include "peeling/truth/real_texture.h"

#include <algorithm>
#include <cmath>

#include "pipeline/formats/srgb.h"
#include "pipeline/textures/texel_address.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// Two texels along an axis and the weight of the second.
struct RealTexels {
    std::int32_t first, second;
    double share;
};

[[nodiscard]] RealTexels texels_at(const TexelAxis& axis, TextureFilter filter, double coordinate) noexcept {
    const double bounded = std::clamp(coordinate, -0x1p31, 0x1p31);
    double u = axis.target == TextureTarget::two_d ? bounded * axis.size : bounded;
    const bool clamps = axis.target == TextureTarget::rectangle || axis.wrap == TextureWrap::clamp_to_edge;
    if (filter == TextureFilter::linear) u -= 0.5;
    if (filter == TextureFilter::linear && clamps) u = std::clamp(u, 0.0, axis.size - 1.0);
    const double whole = std::floor(u);
    const auto texel = static_cast<std::int64_t>(whole);
    const double share = filter == TextureFilter::linear ? u - whole : 0.0;
    return {wrapped(axis, texel), wrapped(axis, texel + 1), share};
}

[[nodiscard]] double texel_value(const Texture& texture, std::int32_t column, std::int32_t row, std::size_t channel) {
    const auto place =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(column);
    const std::uint8_t code = texture.texels[4 * place + channel];
    return texture.decode_srgb && channel < 3 ? double{srgb_to_linear[code]} : code / 255.0;
}

}  // namespace

std::array<double, 4> unquantized_sample(const Texture& texture, double s, double t) noexcept {
    const RealTexels x = texels_at({texture.target, texture.wrap_s, texture.width}, texture.filter, s);
    const RealTexels y = texels_at({texture.target, texture.wrap_t, texture.height}, texture.filter, t);
    std::array<double, 4> color{};
    for (std::size_t c = 0; c < color.size(); ++c) {
        const auto row = [&](std::int32_t r) {
            return (1 - x.share) * texel_value(texture, x.first, r, c) + x.share * texel_value(texture, x.second, r, c);
        };
        color[c] = (1 - y.share) * row(y.first) + y.share * row(y.second);
    }
    return color;
}

}  // namespace strata::peeling
