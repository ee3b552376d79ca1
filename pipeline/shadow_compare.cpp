#include "pipeline/shadow_compare.h"

#include <bit>

#include "pipeline/compare.h"
#include "pipeline/texel_address.h"

namespace strata::pipeline {
namespace {

using rasterizer::Lanes;

struct Lookup {
    const Image& depth;
    TexelLanes s, t;

    [[nodiscard]] std::uint32_t texel(std::int32_t column, std::int32_t row) const noexcept {
        return depth.codes[depth.index(column, row)];
    }
};

// passed(r, texel) is the comparison; answers go to `result`.
void compare_nearest(const Lookup& at, const Lanes<std::uint32_t>& r, float fail, Lanes<float>& result,
                     std::size_t count, auto passed) noexcept {
    for (std::size_t i = 0; i < count; ++i)
        result[i] = passed(r[i], at.texel(at.s.first[i], at.t.first[i])) ? 1.0f : fail;
}

void compare_linear(const Lookup& at, const Lanes<std::uint32_t>& r, float fail, Lanes<float>& result,
                    std::size_t count, auto passed) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const auto tap = [&](std::int32_t column, std::int32_t row) {
            return passed(r[i], at.texel(column, row)) ? 1.0f : fail;
        };
        const BilinearWeights w = bilinear_weights(at.s.fraction[i], at.t.fraction[i]);
        result[i] = bilinear(w, tap(at.s.first[i], at.t.first[i]), tap(at.s.second[i], at.t.first[i]),
                             tap(at.s.first[i], at.t.second[i]), tap(at.s.second[i], at.t.second[i]));
    }
}

// R as the texture's format would store it; binary32 bits, unclamped, for D32F.
void quantize(DepthFormat format, DepthRounding rounding, const Lanes<float>& r, Lanes<std::uint32_t>& codes,
              std::size_t count) noexcept {
    if (format == DepthFormat::d32f) {
        for (std::size_t i = 0; i < count; ++i) codes[i] = std::bit_cast<std::uint32_t>(r[i]);
    } else {
        for (std::size_t i = 0; i < count; ++i) codes[i] = rasterizer::to_depth_code(r[i], format, rounding);
    }
}

void route(DepthTextureMode mode, const Lanes<float>& result, std::array<Lanes<float>, 4>& rgba,
           std::size_t count) noexcept {
    const bool color_varies = mode == DepthTextureMode::luminance || mode == DepthTextureMode::intensity;
    const float color = mode == DepthTextureMode::texture_shader_alpha ? 1.0f : 0.0f;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count; ++i) rgba[c][i] = color_varies ? result[i] : color;
    for (std::size_t i = 0; i < count; ++i) rgba[3][i] = mode == DepthTextureMode::luminance ? 1.0f : result[i];
}

}  // namespace

void shadow_compare(const Image& depth, const ShadowCompare& state, const DeviceProfile& profile,
                    const ShadowCoordinates& at, std::array<Lanes<float>, 4>& rgba, int count) noexcept {
    const TexelAxis s_axis{state.target, state.wrap_s, depth.width}, t_axis{state.target, state.wrap_t, depth.height};
    const DepthFormat format = depth_format(depth.format);
    const auto n = static_cast<std::size_t>(count);
    Lookup lookup{depth, {}, {}};
    Lanes<std::uint32_t> r;
    Lanes<float> result;
    quantize(format, profile.raster.depth_rounding, at.r, r, n);
    const auto compare = [&](auto passed) {
        if (state.filter == TextureFilter::nearest) {
            nearest_texels(s_axis, point_snap(profile.texture_filter), at.s, lookup.s, count);
            nearest_texels(t_axis, point_snap(profile.texture_filter), at.t, lookup.t, count);
            compare_nearest(lookup, r, state.fail_value, result, n, passed);
        } else {
            linear_texels(s_axis, at.s, lookup.s, count);
            linear_texels(t_axis, at.t, lookup.t, count);
            compare_linear(lookup, r, state.fail_value, result, n, passed);
        }
    };
    with_compare(state.func, [&](auto chosen) {
        constexpr CompareFunc func = chosen();
        if (format == DepthFormat::d32f) {
            compare([](std::uint32_t a, std::uint32_t b) {
                return passes<func>(std::bit_cast<float>(a), std::bit_cast<float>(b));
            });
        } else {
            compare([](std::uint32_t a, std::uint32_t b) { return passes<func>(a, b); });
        }
    });
    route(state.mode, result, rgba, n);
}

}  // namespace strata::pipeline
