// pipeline/textures/shadow_compare.cpp - compares a batch's coordinates with a depth texture (shadow_compare.h).
#include "pipeline/textures/shadow_compare.h"

#include <algorithm>
#include <bit>

#include "pipeline/device/compare.h"
#include "pipeline/textures/texel_address.h"

namespace strata::pipeline {
namespace {

using rasterizer::Lanes;

// A depth texture and the texels of each lane's lookup.
struct ShadowLookup {
    const DepthTexels& depth;
    TexelLanes s, t;

    [[nodiscard]] std::uint32_t texel(std::int32_t column, std::int32_t row) const { return depth.at(column, row); }
};

// passed(r, texel) is the comparison; its results are written to `result`.
void compare_nearest(const ShadowLookup& at, const Lanes<std::uint32_t>& r, float fail, Lanes<float>& result,
                     std::size_t count, auto passed) {
    for (std::size_t i = 0; i < count; ++i)
        result[i] = passed(r[i], at.texel(at.s.first[i], at.t.first[i])) ? 1.0f : fail;
}

// The results are filtered, not the depths: each texel gives 1 or the fail value first (pipeline/reference/texturing.md
// 4.2).
void compare_linear(const ShadowLookup& at, const Lanes<std::uint32_t>& r, float fail, Lanes<float>& result,
                    std::size_t count, auto passed) {
    for (std::size_t i = 0; i < count; ++i) {
        const auto tap = [&](std::int32_t column, std::int32_t row) {
            return passed(r[i], at.texel(column, row)) ? 1.0f : fail;
        };
        const BilinearWeights w = bilinear_weights(at.s.fraction[i], at.t.fraction[i]);
        result[i] = bilinear(w, tap(at.s.first[i], at.t.first[i]), tap(at.s.second[i], at.t.first[i]),
                             tap(at.s.first[i], at.t.second[i]), tap(at.s.second[i], at.t.second[i]));
    }
}

[[nodiscard]] bool has(const DepthTexels& depth, DepthFormat format) noexcept {
    return depth.format == format && !depth.is_eight_bit;
}
// The value of a texel in the texture's own units.
[[nodiscard]] double value_of(const DepthTexels& depth, std::uint32_t code) noexcept {
    return depth.is_eight_bit ? static_cast<double>(code) : rasterizer::buffer_value(code, depth.format);
}
// The factor that converts R to buffer units.
[[nodiscard]] double units_of(const DepthTexels& depth, const rasterizer::RasterRules& rules) noexcept {
    return rules.window_z == rasterizer::WindowZ::buffer_units ? 1.0 : value_of(depth, depth.max());
}

// R as the format of the texels would store it; unclamped binary32 bits for D32F.
void quantize(const DepthTexels& depth, const rasterizer::RasterRules& rules, const Lanes<float>& r,
              Lanes<std::uint32_t>& codes, std::size_t count) noexcept {
    if (has(depth, DepthFormat::d32f)) {
        for (std::size_t i = 0; i < count; ++i) codes[i] = std::bit_cast<std::uint32_t>(r[i]);
        return;
    }
    const double units = units_of(depth, rules), greatest = value_of(depth, depth.max()) / units;
    auto to = rasterizer::depth_conversion(depth.format, rules.depth_rounding, greatest);
    if (depth.is_eight_bit)
        to = {rasterizer::CodeKind::fixed, 0.0, greatest, units, truncates(rules.depth_rounding) ? 0.0 : 0.5};
    for (std::size_t i = 0; i < count; ++i) codes[i] = rasterizer::depth_code(double{r[i]}, to);
}

// Writes the result to the channels of texturing.md 4.3.
void route(DepthTextureMode mode, const Lanes<float>& result, std::array<Lanes<float>, 4>& rgba,
           std::size_t count) noexcept {
    const bool color_varies = mode == DepthTextureMode::luminance || mode == DepthTextureMode::intensity;
    const float color = mode == DepthTextureMode::texture_shader_alpha ? 1.0f : 0.0f;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count; ++i) rgba[c][i] = color_varies ? result[i] : color;
    for (std::size_t i = 0; i < count; ++i) rgba[3][i] = mode == DepthTextureMode::luminance ? 1.0f : result[i];
}

}  // namespace

void shadow_compare(const DepthTexels& depth, const ShadowCompare& state, const DeviceProfile& profile,
                    const ShadowCoordinates& at, std::array<Lanes<float>, 4>& rgba, int count) {
    const TexelAxis s_axis{state.target, state.wrap_s, depth.width}, t_axis{state.target, state.wrap_t, depth.height};
    const bool is_float = has(depth, DepthFormat::d32f);
    const auto n = static_cast<std::size_t>(count);
    ShadowLookup lookup{depth, {}, {}};
    Lanes<std::uint32_t> r;
    Lanes<float> result;
    quantize(depth, profile.raster, at.r, r, n);
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
    const bool quantizes = profile.raster.hypothesis.quantize_reference;
    const double units = units_of(depth, profile.raster);
    with_compare(state.func, [&](auto chosen) {
        constexpr CompareFunc func = chosen();
        if (!is_float && !quantizes) {
            // The hypothesis that R is compared unquantized: its bits are passed in place of codes, and texels are
            // converted to values.
            for (std::size_t i = 0; i < n; ++i) r[i] = std::bit_cast<std::uint32_t>(at.r[i]);
            const double max = value_of(depth, depth.max());
            compare([units, max, &depth](std::uint32_t a, std::uint32_t b) {
                const double scaled = double{std::bit_cast<float>(a)} * units;
                return passes<func>(scaled > 0.0 ? std::min(scaled, max) : 0.0, value_of(depth, b));
            });
        } else if (is_float) {
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
