// pipeline/vertices/vertex_light.cpp - lights the vertices of a mesh (vertex_light.h).
#include "pipeline/vertices/vertex_light.h"

#include <algorithm>
#include <utility>

#include "pipeline/lighting/light_registers.h"
#include "pipeline/vertices/matrix.h"

namespace strata::pipeline {

std::shared_ptr<const FrameLights> frame_lights(const Lighting* lighting, const View& view) {
    if (lighting == nullptr || lighting->lights.empty()) return nullptr;
    FrameLights lights{in_eye_space(*lighting, view.view), lighting->rule, {}};
    if (lights.rule == LightingRule::float22) lights.registers = light_registers(lights.lighting);
    return std::make_shared<const FrameLights>(std::move(lights));
}

VertexLight::VertexLight(std::shared_ptr<const FrameLights> lights, const View& view, const Matrix& model)
    : lights_{std::move(lights)},
      eye_{view.vertex_path, product(view.view, model), identity, product(view.view, model)} {
    const Matrix to_eye = product(view.view, model);
    const double sign = linear_determinant(to_eye) < 0 ? -1.0 : 1.0;
    std::ranges::transform(cofactors_of(to_eye), normal_.begin(),
                           [&](double c) { return static_cast<float>(sign * c); });
}

LitVertex VertexLight::operator()(const Vec3& position, float w, const Vec3& normal, const Rgba& front,
                                  const Rgba& back) const noexcept {
    const std::array<float, 4> at = w == 1.0f ? eye_(position) : eye_(position, w);
    const Three eye = w == 1.0f ? Three{at[0], at[1], at[2]} : Three{at[0] / at[3], at[1] / at[3], at[2] / at[3]};
    const auto& c = normal_;
    Three n{};
    for (std::size_t r = 0; r < 3; ++r) n[r] = (c[r] * normal.x + c[3 + r] * normal.y) + c[6 + r] * normal.z;
    n = lights_->rule == LightingRule::float22 ? unit_of_lighting(n) : unit_of(n);
    const LitFace lit = face(eye, n, front);
    if (!lights_->lighting.model.is_two_sided) return {lit, back == front ? lit : face(eye, n, back)};
    return {lit, face(eye, {-n[0], -n[1], -n[2]}, back)};
}

LitFace VertexLight::face(const Three& position, const Three& normal, const Rgba& color) const noexcept {
    if (lights_->rule == LightingRule::single)
        return light_face(lights_->lighting, position, normal, {color.r, color.g, color.b});
    const LitColors lit = light_vertex(lights_->registers, {position, normal, {color.r, color.g, color.b, 1.0f}, {}});
    return {{lit.primary[0], lit.primary[1], lit.primary[2]}, {lit.secondary[0], lit.secondary[1], lit.secondary[2]}};
}

}  // namespace strata::pipeline
