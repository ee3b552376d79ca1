// pipeline/textures/shadow_stage.h - ordinary shadow mapping: colours times a comparison with what a light sees.
//
// Rule     The light's depth buffer is a texture; unit 3 generates a fragment's place in it: eye-linear planes T(1/2)
//          S(1/2) P V of the light, specified under the camera's view. A fragment that lies behind the texel at s/q,
//          t/q is in shadow: its red, green and blue are times the comparison (MODULATE by a LUMINANCE result), which
//          fails with `ambient`. What lies outside the light's view is compared with the map's border texels.
// Source   Williams 1978 and Everitt 2001, "Shadow Mapping"; texturing.md 6. The comparison is shadow_compare.h's.
// Tests    tests/peeling/shadow_light_test.cpp
#pragma once
#include "pipeline/textures/shadow_compare.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/texgen.h"

namespace strata::pipeline {

// A light's finished map, and how it is compared.
struct ShadowStage {
    DepthTexels map;
    ShadowCompare compare;
};

// Coordinates of the light's map for a camera's list; `state` is the light's depth range and conventions.
[[nodiscard]] CoordinateUnits shadow_units(const ShadowLight& light, const Matrix& camera_view,
                                           const rasterizer::RasterState& state, const DeviceProfile& profile);

// The stage that looks up the map of `light`. The image outlives the stage.
[[nodiscard]] ShadowStage shadow_stage(const ShadowLight& light, const Image& map,
                                       const rasterizer::RasterState& state);

// Colours of the batch, with the coordinates of shadow_unit; `scratch` is free to be used.
void cast_shadow(const ShadowStage& stage, const DeviceProfile& profile, rasterizer::FragmentBatch& batch,
                 std::array<rasterizer::Lanes<float>, 4>& scratch);

}  // namespace strata::pipeline
