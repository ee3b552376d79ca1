// pipeline/geforce3/texture_shader.cpp - runs the four texture shader stages over a batch (texture_shader.h).
#include "pipeline/geforce3/texture_shader.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "pipeline/formats/lane_mask.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/textures/texel_address.h"
#include "pipeline/textures/texture_sample.h"
#include "rasterizer/values/depth_quotient.h"

namespace strata::pipeline {
namespace {

using rasterizer::FragmentBatch;
using rasterizer::Lanes;
using Coordinates = std::array<Lanes<float>, 4>;

// One stage applied to one batch. Stages run in order, so the results of earlier stages are complete.
struct StageRun {
    const ShaderStages& stages;
    const ShaderDevice& device;
    std::size_t number;
    const Coordinates& coordinate;  // s t r q
    std::size_t count;
    ShaderResults& out;

    [[nodiscard]] const ShaderStage& stage() const noexcept { return stages[number]; }
    [[nodiscard]] StageResult& own() const noexcept { return out.stage[number]; }
    [[nodiscard]] const StageResult& before() const noexcept { return out.stage[number - 1]; }
    [[nodiscard]] std::size_t input() const noexcept { return static_cast<std::size_t>(stage().previous); }
};

// The colour of operations without a lookup: (0, 0, 0, 0).
void clear(ColorLanes& rgba, std::size_t count) noexcept {
    for (Lanes<float>& channel : rgba) std::fill_n(channel.begin(), count, 0.0f);
}

// Every division of a stage follows the rule of perspective_rq and depth_replace.
[[nodiscard]] rasterizer::DivideRule divide_rule(const ShaderDevice& device) noexcept {
    return device.profile->raster.hypothesis.divide;
}

void divide(const StageRun& run, std::size_t component, Lanes<float>& out) noexcept {
    for (std::size_t i = 0; i < run.count; ++i)
        out[i] = rasterizer::divide(run.coordinate[component][i], run.coordinate[3][i], divide_rule(run.device));
}

// One division: signed codes reach at most 32767/32768 (pipeline/reference/texture-shader.md 4).
float hilo_component(std::uint16_t k, bool is_signed) noexcept {
    return is_signed ? static_cast<float>(static_cast<std::int16_t>(k)) / 32768.0f : static_cast<float>(k) / 65535.0f;
}

// HILO textures have only nearest lookups; the third component of a signed one completes a unit vector
// (texture-shader.md 4).
void look_up(const HiloTexture& texture, const DeviceProfile& profile, const Lanes<float>& s, const Lanes<float>& t,
             StageResult& own, std::size_t count) {
    TexelLanes column, row;
    const PointSnap snap = point_snap(profile.texture_filter);
    nearest_texels({texture.target, texture.wrap_s, texture.width}, snap, s, column, static_cast<int>(count));
    nearest_texels({texture.target, texture.wrap_t, texture.height}, snap, t, row, static_cast<int>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const auto [high, low] =
            texture.texels[static_cast<std::size_t>(row.first[i]) * static_cast<std::size_t>(texture.width) +
                           static_cast<std::size_t>(column.first[i])];
        const float x = hilo_component(high, texture.is_signed), y = hilo_component(low, texture.is_signed);
        const float rest = (1.0f - x * x) - y * y;
        own.xyz[0][i] = x;
        own.xyz[1][i] = y;
        own.xyz[2][i] = !texture.is_signed ? 1.0f : rest > 0.0f ? std::sqrt(rest) : 0.0f;
    }
    clear(own.rgba, count);
}

void look_up(const StageRun& run, const Lanes<float>& s, const Lanes<float>& t) {
    const BoundTexture& texture = run.stage().texture;
    const DeviceProfile& profile = *run.device.profile;
    StageResult& own = run.own();
    if (texture.hilo != nullptr) return look_up(*texture.hilo, profile, s, t, own, run.count);
    if (texture.color != nullptr) {
        sample(*texture.color, profile.texture_filter, s, t, own.rgba, static_cast<int>(run.count));
    } else {
        Lanes<float> r{};
        if (texture.reference == CompareReference::r_over_q) divide(run, 2, r);
        shadow_compare(run.device.texels[run.number], texture.compare, profile, {s, t, r}, own.rgba,
                       static_cast<int>(run.count));
    }
    for (std::size_t c = 0; c < 3; ++c) std::copy_n(own.rgba[c].begin(), run.count, own.xyz[c].begin());
}

void projective_lookup(const StageRun& run) {
    Lanes<float> s, t;
    divide(run, 0, s);
    divide(run, 1, t);
    look_up(run, s, t);
}

// Converts [0, 1] to 8 bits like NV2A: 12 bits, times 255/256 by a shift, everything truncated. 1 becomes 255.
[[nodiscard]] constexpr std::uint8_t pass_through_code(float x) noexcept {
    // x has 24 bits and 4096 is a power of two, so only the truncation is inexact.
    const auto fixed = static_cast<std::uint32_t>(x * 4096.0f);
    return static_cast<std::uint8_t>((fixed - (fixed >> 8)) >> 4);
}

void pass_through(const StageRun& run) {
    const bool is_unorm8 = run.device.profile->texture_filter == TextureFilterPrecision::unorm8;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < run.count; ++i) {
            const float x = run.coordinate[c][i] > 0.0f ? std::min(run.coordinate[c][i], 1.0f) : 0.0f;
            run.own().rgba[c][i] = is_unorm8 ? from_unorm8(pass_through_code(x)) : x;
        }
}

// A comparison with NaN is false, so NaN kills the fragment in either mode.
void cull(const StageRun& run) {
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < run.count; ++i) {
            const float x = run.coordinate[c][i];
            run.out.alive[i] &= mask(run.stage().cull[c] == CullMode::gequal ? x >= 0.0f : x < 0.0f);
        }
    clear(run.own().rgba, run.count);
}

// The coordinates are not divided by q; HILO texels are never expanded (texture-shader.md 3).
void dot(const StageRun& run) {
    const StageResult& from = run.out.stage[run.input()];
    const bool is_colour = run.stages[run.input()].texture.hilo == nullptr;
    const bool expands = is_colour && run.stage().mapping == DotMapping::expand_normal;
    const auto mapped = [&](std::size_t c, std::size_t i) {
        const float x = from.xyz[c][i];
        return expands ? 2.0f * x - 1.0f : x;
    };
    for (std::size_t i = 0; i < run.count; ++i) {
        const float x = run.coordinate[0][i] * mapped(0, i);
        const float y = run.coordinate[1][i] * mapped(1, i);
        const float z = run.coordinate[2][i] * mapped(2, i);
        run.own().dot[i] = (x + y) + z;
    }
}

// The range and the conversion of a replaced depth, in the units of the device's quotient.
class DepthRule {
  public:
    rasterizer::DepthConversion<double> to_code;
    bool clamps;

    explicit DepthRule(const ShaderDevice& m) : to_code{conversion(m)}, clamps{m.depth_clamp} {}
    // With depth clamp everything except NaN is accepted, and `code` clamps it.
    [[nodiscard]] bool accepts(float z) const noexcept {
        return rasterizer::is_in_depth_range(z, to_code.least, to_code.greatest) || (clamps && z == z);
    }
    [[nodiscard]] std::uint32_t code(float z) const noexcept { return rasterizer::depth_code(double{z}, to_code); }

  private:
    static rasterizer::DepthConversion<double> conversion(const ShaderDevice& m) noexcept {
        const rasterizer::RasterRules& rules = m.profile->raster;
        const bool scaled = rules.window_z == rasterizer::WindowZ::buffer_units;
        const double units = scaled ? rasterizer::buffer_units(m.depth.format) : 1.0;
        return rasterizer::depth_conversion(m.depth.format, rules.depth_rounding, units, m.depth_near, m.depth_far);
    }
};

// The quotient is that of perspective_rq and depth_replace in the rasterizer, bit for bit (texture-shader.md 7).
void replace_depth(const StageRun& run) {
    const DepthRule rule{run.device};
    for (std::size_t i = 0; i < run.count; ++i) {
        const float z = rasterizer::divide(run.before().dot[i], run.own().dot[i], divide_rule(run.device));
        const bool accepted = rule.accepts(z);
        run.out.alive[i] &= mask(accepted);
        run.out.code[i] = accepted ? rule.code(z) : 0u;
    }
}

void run_stage(const StageRun& run, ShaderOp op) {
    switch (op) {
        case ShaderOp::none: return clear(run.own().rgba, run.count);
        case ShaderOp::texture_2d:
        case ShaderOp::texture_rectangle: return projective_lookup(run);
        case ShaderOp::pass_through: return pass_through(run);
        case ShaderOp::cull_fragment: return cull(run);
        case ShaderOp::dot_product: dot(run); return clear(run.own().rgba, run.count);
        case ShaderOp::dot_product_texture_2d:
        case ShaderOp::dot_product_texture_rectangle: dot(run); return look_up(run, run.before().dot, run.own().dot);
        case ShaderOp::dot_product_depth_replace:
            dot(run);
            replace_depth(run);
            return clear(run.own().rgba, run.count);
    }
}

}  // namespace

void run_texture_shader(const ShaderStages& stages, const ShaderOps& ops, const ShaderDevice& device,
                        const FragmentBatch& in, ShaderResults& out) {
    const auto count = static_cast<std::size_t>(in.count);
    std::fill_n(out.alive.begin(), count, ~0u);
    for (std::size_t stage = 0; stage < stages.size(); ++stage)
        run_stage({stages, device, stage, in.unit[stage], count, out}, ops[stage]);
}

}  // namespace strata::pipeline
