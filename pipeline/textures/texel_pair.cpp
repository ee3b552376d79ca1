// pipeline/textures/texel_pair.cpp - the texels of a lookup by lerps (texel_pair.h).
#include "pipeline/textures/texel_pair.h"

#include <cmath>

namespace strata::pipeline {
namespace {

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

}  // namespace

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

}  // namespace strata::pipeline
