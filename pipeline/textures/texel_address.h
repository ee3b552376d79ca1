// pipeline/textures/texel_address.h - maps a texture coordinate to texels, one axis at a time, for colour and depth
// textures.
//
// Rule     u = coordinate * size for 2D textures, the coordinate itself for rectangles, exact. Nearest: texel floor(u),
//          with u first snapped to 1/256 (nearest even) if the profile requires it. Linear: u - 1/2 floored to a
//          multiple of 1/256; its integer part is the first texel, its fraction the second one's weight. Repeat and
//          mirrored repeat wrap the texel index, clamp to edge clamps u to [1/2, size - 1/2]; rectangles always clamp.
//          NaN is treated as 0, values beyond +-2^31 as +-2^31.
// Source   pipeline/reference/texturing.md 2 (GL 2.1 3.8.8; D3D 11.3 7.18.7; NV_texture_rectangle). Assumed: NaN
//          reads as 0, and coordinates are clamped to +-2^31.
// Numbers  coordinate * size * 256: 24 + 15 significant bits, below 2^55: exact in binary64 and in 64-bit integers.
// Tests    tests/pipeline/textures/texture_sample_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>

#include "pipeline/device/profile.h"
#include "pipeline/formats/texture.h"
#include "rasterizer/base/numerics.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

enum class PointSnap : std::uint8_t { none, to_256ths };

// All profiles that filter in binary32 snap nearest lookups to 1/256 texel (D3D 11.3 7.18.7).
[[nodiscard]] constexpr PointSnap point_snap(TextureFilterPrecision precision) noexcept {
    return precision == TextureFilterPrecision::unorm8 ? PointSnap::none : PointSnap::to_256ths;
}

// One axis of a texture: its target, its wrap mode and its number of texels.
struct TexelAxis {
    TextureTarget target = TextureTarget::two_d;
    TextureWrap wrap = TextureWrap::repeat;
    int size = 1;  // at most 2^15
};

// Per lane: two texels of the axis, and the weight of the second in units of 1/256. Nearest lookups do not set `second`
// and `fraction`.
struct TexelLanes {
    rasterizer::Lanes<std::int32_t> first, second, fraction;
};

inline namespace strict {

// 256 u, exact.
[[nodiscard]] constexpr double scaled_coordinate(const TexelAxis& axis, float coordinate) noexcept {
    const double number = coordinate == coordinate ? double{coordinate} : 0.0;
    const double bounded = std::clamp(number, -0x1p31, 0x1p31);
    return bounded * (axis.target == TextureTarget::two_d ? 256.0 * axis.size : 256.0);
}

[[nodiscard]] constexpr std::int64_t floor_of(double x) noexcept {
    const auto cut = static_cast<std::int64_t>(x);
    return cut - (x < static_cast<double>(cut) ? 1 : 0);
}

[[nodiscard]] constexpr std::int64_t nearest_even_of(double x) noexcept {
    const std::int64_t below = floor_of(x);
    const double rest = x - static_cast<double>(below);
    return below + (rest > 0.5 || (rest == 0.5 && (below & 1) != 0) ? 1 : 0);
}

[[nodiscard]] constexpr std::int64_t modulo(std::int64_t i, std::int64_t period) noexcept {
    if (i >= 0 && i < period) return i;  // nearly always true: avoids the division
    const std::int64_t rest = i % period;
    return rest < 0 ? rest + period : rest;
}

// The texel to which index `texel` is wrapped; the index may be any integer (texturing.md 2.3).
[[nodiscard]] constexpr std::int32_t wrapped(const TexelAxis& axis, std::int64_t texel) noexcept {
    const std::int64_t size = axis.size;
    const TextureWrap wrap = axis.target == TextureTarget::rectangle ? TextureWrap::clamp_to_edge : axis.wrap;
    switch (wrap) {
        case TextureWrap::repeat: return static_cast<std::int32_t>(modulo(texel, size));
        case TextureWrap::mirrored_repeat: {
            const std::int64_t place = modulo(texel, 2 * size);
            return static_cast<std::int32_t>(place < size ? place : 2 * size - 1 - place);
        }
        case TextureWrap::clamp_to_edge: break;
    }
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(texel, 0, size - 1));
}

// The rule of texturing.md 2.1; the shift by 8 floors, for negative numbers too.
[[nodiscard]] constexpr std::int32_t nearest_texel(const TexelAxis& axis, PointSnap snap, float coordinate) noexcept {
    const double scaled = scaled_coordinate(axis, coordinate);
    return wrapped(axis, (snap == PointSnap::none ? floor_of(scaled) : nearest_even_of(scaled)) >> 8);
}

// u - 1/2 in units of 1/256.
[[nodiscard]] constexpr std::int64_t linear_position(const TexelAxis& axis, float coordinate) noexcept {
    const std::int64_t position = floor_of(scaled_coordinate(axis, coordinate)) - 128;
    if (axis.target == TextureTarget::two_d && axis.wrap != TextureWrap::clamp_to_edge) return position;
    return std::clamp<std::int64_t>(position, 0, std::int64_t{256} * (axis.size - 1));
}

// nearest_texel for lanes [0, count) of a batch.
inline void nearest_texels(const TexelAxis& axis, PointSnap snap, const rasterizer::Lanes<float>& coordinate,
                           TexelLanes& out, int count) noexcept {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        out.first[i] = nearest_texel(axis, snap, coordinate[i]);
}

inline void linear_texels(const TexelAxis& axis, const rasterizer::Lanes<float>& coordinate, TexelLanes& out,
                          int count) noexcept {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const std::int64_t position = linear_position(axis, coordinate[i]);
        out.first[i] = wrapped(axis, position >> 8);
        out.second[i] = wrapped(axis, (position >> 8) + 1);
        out.fraction[i] = static_cast<std::int32_t>(position & 255);
    }
}

// Weights of the four texels (first or second column, first or second row) in units of 1/65536; they sum to 65536.
struct BilinearWeights {
    std::int32_t w00, w10, w01, w11;
};

[[nodiscard]] constexpr BilinearWeights bilinear_weights(std::int32_t s, std::int32_t t) noexcept {
    return {(256 - s) * (256 - t), s * (256 - t), (256 - s) * t, s * t};
}

// ((t00 w00 + t10 w10) + t01 w01) + t11 w11, each operation rounded to binary32. The weights are at most
// 65536, so their conversion to binary32 is exact.
[[nodiscard]] constexpr float bilinear(const BilinearWeights& w, float t00, float t10, float t01, float t11) noexcept {
    const float upper = t00 * (static_cast<float>(w.w00) * 0x1p-16f) + t10 * (static_cast<float>(w.w10) * 0x1p-16f);
    const float with_left = upper + t01 * (static_cast<float>(w.w01) * 0x1p-16f);
    return with_left + t11 * (static_cast<float>(w.w11) * 0x1p-16f);
}

}  // namespace strict
}  // namespace strata::pipeline
