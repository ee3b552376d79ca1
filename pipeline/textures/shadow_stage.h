// pipeline/textures/shadow_stage.h - ordinary shadow mapping: multiplies colours by the result of a comparison with a
// light's depth map.
//
// Rule     The light's depth buffer is a texture; unit 3 generates a fragment's coordinates in it: eye-linear planes
//          T(1/2) S(1/2) P V of the light, specified under the camera's view. A fragment behind the texel at s/q, t/q
//          is in shadow: its red, green and blue are multiplied by the result of the comparison (MODULATE by a
//          LUMINANCE result), which is `ambient` if it fails. Outside the light's view the comparison uses the map's
//          border texels.
// Source   Williams 1978 and Everitt 2001, "Shadow Mapping"; pipeline/reference/texturing.md 6. The comparison is
//          shadow_compare.h's.
// Tests    tests/peeling/frame/shadow_light_test.cpp
#pragma once
#include "pipeline/textures/shadow_compare.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/texgen.h"

namespace strata::pipeline {

// A light's finished map, and the comparison with it.
struct ShadowStage {
    DepthTexels map;
    ShadowCompare compare;
};

// Coordinates of the light's map for a camera's list; `state` has the light's depth range and conventions.
[[nodiscard]] CoordinateUnits shadow_units(const ShadowLight& light, const Matrix& camera_view,
                                           const rasterizer::RasterState& state, const DeviceProfile& profile);

// The stage that looks up the map of `light`. The image must outlive the stage.
[[nodiscard]] ShadowStage shadow_stage(const ShadowLight& light, const Image& map,
                                       const rasterizer::RasterState& state);

// Shades the colours of the batch with the coordinates of shadow_unit; `scratch` is overwritten.
void cast_shadow(const ShadowStage& stage, const DeviceProfile& profile, rasterizer::FragmentBatch& batch,
                 std::array<rasterizer::Lanes<float>, 4>& scratch);

}  // namespace strata::pipeline
