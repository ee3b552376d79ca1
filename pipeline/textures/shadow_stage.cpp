// pipeline/textures/shadow_stage.cpp - the coordinates of a light's map and the product of colours with its comparison
// (shadow_stage.h).
#include "pipeline/textures/shadow_stage.h"

#include "pipeline/vertices/matrix.h"
#include "rasterizer/set_up/window.h"

namespace strata::pipeline {

CoordinateUnits shadow_units(const ShadowLight& light, const Matrix& camera_view, const rasterizer::RasterState& state,
                             const DeviceProfile& profile) {
    const double n = state.depth_near, f = state.depth_far;
    const bool symmetric = state.clip_depth == rasterizer::ClipDepth::minus_one_to_one;
    // From the light's clip space to texture coordinates 0..1 and to its depth range, as in
    // pipeline/reference/vertices.md 4.4.
    const Matrix to_window = product(translation(0.5, 0.5, symmetric ? (f + n) * 0.5 : n),
                                     scaling(0.5, 0.5, symmetric ? (f - n) * 0.5 : f - n));
    const Matrix rows = product(to_window, product(light.projection, light.view));
    CoordinateUnits units{};
    units[shadow_unit].enabled = true;
    units[shadow_unit].depth_units[2] = rasterizer::z_units(state, profile.raster);
    for (std::size_t c = 0; c < 4; ++c)
        units[shadow_unit].gen[c] = {TexGenMode::eye_linear,
                                     eye_plane({rows[0][c], rows[1][c], rows[2][c], rows[3][c]}, camera_view)};
    return units;
}

ShadowStage shadow_stage(const ShadowLight& light, const Image& map, const rasterizer::RasterState& state) {
    ShadowStage stage;
    stage.map = DepthTexels{map};
    stage.map.bottom_up = state.y_direction == rasterizer::YDirection::up;
    stage.compare = {.func = CompareFunc::lequal,
                     .mode = DepthTextureMode::luminance,
                     .fail_value = light.ambient,
                     .filter = light.percentage_closer ? TextureFilter::linear : TextureFilter::nearest};
    return stage;
}

void cast_shadow(const ShadowStage& stage, const DeviceProfile& profile, rasterizer::FragmentBatch& batch,
                 std::array<rasterizer::Lanes<float>, 4>& scratch) {
    const auto& [s, t, r, q] = batch.unit[shadow_unit];
    const auto count = static_cast<std::size_t>(batch.count);
    // Plain binary32 divisions (texturing.md 6); DivideRule does not apply.
    rasterizer::Lanes<float> over_q[3];
    for (std::size_t i = 0; i < count; ++i) {
        over_q[0][i] = s[i] / q[i];
        over_q[1][i] = t[i] / q[i];
        over_q[2][i] = r[i] / q[i];
    }
    shadow_compare(stage.map, stage.compare, profile, {over_q[0], over_q[1], over_q[2]}, scratch, batch.count);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count; ++i) batch.color[c][i] *= scratch[c][i];
}

}  // namespace strata::pipeline
