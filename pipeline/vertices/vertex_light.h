// pipeline/vertices/vertex_light.h - the colours that a scene's lights give the vertices of a mesh, by the profile's
// rule.
//
// Rule     The normal in eye space is the cofactors of view * model times the normal, negated for a mirrored model, in
//          binary32, divided by its length. A back face has the opposite normal if the model is two-sided.
//          LightingRule::single computes open_gl_light.h, float22 NV2A's unit (lighting/lighting_unit.h).
// Source   GL 2.1 2.11.3 with normalisation, 2.14.1; pipeline/reference/lighting.md 2.
// Tests    tests/pipeline/lighting/vertex_light_test.cpp
#pragma once
#include <memory>

#include "pipeline/device/profile.h"
#include "pipeline/lighting/lighting_unit.h"
#include "pipeline/lighting/open_gl_light.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/vertex_transform.h"

namespace strata::pipeline {

struct LitVertex {
    LitFace front, back;
};

// The lights of a frame, which all its meshes share.
struct FrameLights {
    EyeLighting lighting{};
    LightingRule rule{};
    LightingRegisters registers{};  // of LightingRule::float22
};

// Null without lights (null, or an empty list).
[[nodiscard]] std::shared_ptr<const FrameLights> frame_lights(const Lighting* lighting, const View& view);

// The lights of a frame for the vertices of a mesh with this model matrix.
class VertexLight {
  public:
    VertexLight(std::shared_ptr<const FrameLights> lights, const View& view, const Matrix& model);

    // The colours of both faces are the material's times the vertex'.
    [[nodiscard]] LitVertex operator()(const Vec3& position, float w, const Vec3& normal, const Rgba& front,
                                       const Rgba& back) const noexcept;

  private:
    [[nodiscard]] LitFace face(const Three& position, const Three& normal, const Rgba& color) const noexcept;

    std::shared_ptr<const FrameLights> lights_;
    VertexTransform eye_;
    std::array<float, 9> normal_{};
};

}  // namespace strata::pipeline
