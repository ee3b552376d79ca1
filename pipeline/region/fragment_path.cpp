// pipeline/region/fragment_path.cpp - GeForce3's two units as one fragment program: the texture shader outputs four
// colours, may kill fragments and may replace their depth; the combiners compute the fragment's colour from its
// outputs.
#include "pipeline/region/fragment_path.h"

#include "pipeline/device/check.h"
#include "pipeline/formats/unorm8.h"

namespace strata::pipeline {
namespace {

// The state that the texture shader reads in addition to its stages: the depth range and clamp of the draw list, the
// format of a replaced depth, and each unit's depth texture, either an image of the caller or a depth target of this
// region.
ShaderDevice device_of(const Region& region, const ShaderStages& stages, std::size_t sample) {
    const rasterizer::RasterState& raster = region.frame().transparent->geometry.state;
    ShaderDevice device;
    device.profile = &region.profile();
    device.depth = region.frame().key_request();
    device.depth_near = raster.depth_near;
    device.depth_far = raster.depth_far;
    device.depth_clamp = raster.depth_clamp;
    for (std::size_t u = 0; u < stages.size(); ++u) {
        const BoundTexture& texture = stages[u].texture;
        DepthTexels& texels = device.texels[u];
        if (texture.depth_image != nullptr) {
            texels = DepthTexels{*texture.depth_image};
            texels.bottom_up = texture.bottom_up;
        } else if (texture.depth.exists()) {
            texels = region.targets().depth_texels(texture.depth, sample);
        }
        texels.is_eight_bit = texture.eight_bit_depth;
    }
    return device;
}

}  // namespace

FragmentPathProgram::FragmentPathProgram(const Region& region, const FragmentPath& path)
    : path_{path},
      ops_{consistent_operations(path.shader)},
      pixels_{static_cast<std::uint32_t>(region.rect().area())},
      has_secondary_{region.frame().transparent->geometry.extras.has_secondary},
      combiners_{path.combiners},
      results_{std::make_unique<ShaderResults>()} {
    // Depth replace is a stage of NV_texture_shader: a profile without it has no texture shader at all
    // (pipeline/reference/devices.md 6).
    if (auto lacking = check(region.profile(), Feature::depth_replace))
        throw Refused{region.profile(), {"texture shaders", lacking->extension, lacking->way_out}};
    for (int sample = 0; sample < region.frame().samples(); ++sample)
        devices_.push_back(device_of(region, path.shader, static_cast<std::size_t>(sample)));
}

// A disabled stage gets no texture, so that it neither counts loads nor creates a feedback loop. Colours are needed as
// the combiners' primary colour, coordinates only as far as an operation reads them (texture-shader.md 8).
void FragmentPathProgram::apply(PassState& state) const {
    state.needs.color = true;
    state.needs.units |= coordinates_of(path_.shader, ops_);
    state.needs.fog |= path_.fog.has_value();
    state.needs.secondary |= has_secondary_;
    state.replaces_depth = replaces_depth(ops_);
    for (std::size_t u = 0; u < ops_.size(); ++u)
        state.textures[u] = ops_[u] == ShaderOp::none ? Target{} : path_.shader[u].texture.depth;
}

// Coordinates are not recorded, so the batch has elements of one sample. CULL_FRAGMENT or a depth out of range kills a
// fragment (texture-shader.md 6 and 7). Combiners also run on dead lanes,
// whose colours are never stored.
void FragmentPathProgram::operator()(const FragmentBatch& in, const Loads&, Outputs& out) {
    const auto count = static_cast<std::size_t>(in.count);
    if (count == 0) return;
    run_texture_shader(path_.shader, ops_, devices_[in.pixel[0] / pixels_], in, *results_);
    for (std::size_t i = 0; i < count; ++i) out.alive[i] &= results_->alive[i];
    if (replaces_depth(ops_)) {
        std::copy_n(results_->code.begin(), count, out.depth.begin());
        out.replaces_depth = true;
    }
    CombinerSources sources{.primary = &in.color};
    if (has_secondary_) sources.secondary = &in.secondary;
    rasterizer::Lanes<float> factor;
    if (path_.fog) {
        for (std::size_t i = 0; i < count; ++i)
            factor[i] = unorm8_value(static_cast<std::uint32_t>(fog_factor(*path_.fog, in.fog[i])));
        sources.fog = path_.fog->color;
        sources.fog_factor = &factor;
    }
    for (std::size_t u = 0; u < ops_.size(); ++u) sources.texture[u] = &results_->stage[u].rgba;
    combiners_.run(sources, out.color[0], in.count);
}

}  // namespace strata::pipeline
