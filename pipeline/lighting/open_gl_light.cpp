// pipeline/lighting/open_gl_light.cpp - the terms and sums of OpenGL's light (open_gl_light.h).
#include "pipeline/lighting/open_gl_light.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/base/log_exp.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {

namespace {

[[nodiscard]] float dot_of(const Three& a, const Three& b) noexcept {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

[[nodiscard]] Three divided_by(const Three& v, float length) noexcept {
    return length > 0.0f ? Three{v[0] / length, v[1] / length, v[2] / length} : Three{};
}

// 0 for a number that is not above 0, NaN among them.
[[nodiscard]] float at_least_zero(float v) noexcept { return v > 0.0f ? v : 0.0f; }

[[nodiscard]] Three in_range(const Three& c) noexcept {
    Three clamped{};
    for (std::size_t i = 0; i < 3; ++i) clamped[i] = std::min(at_least_zero(c[i]), 1.0f);
    return clamped;
}

// What reaches a vertex: the unit vector to the light, and a factor of all of its colours.
struct Reaching {
    Three toward{};
    float factor = 0.0f;
};

[[nodiscard]] Reaching reaching(const EyeLight& from, const Three& position) noexcept {
    if (from.light.type == LightType::directional) return {from.toward, 1.0f};
    const Three to{from.position[0] - position[0], from.position[1] - position[1], from.position[2] - position[2]};
    const float squared = dot_of(to, to), distance = std::sqrt(squared);
    if (!(distance > 0.0f) || distance > from.light.range) return {};
    const Vec3& k = from.light.attenuation;
    Reaching reached{divided_by(to, distance)};
    reached.factor = std::min(1.0f / ((k.x + k.y * distance) + k.z * squared), std::numeric_limits<float>::max());
    if (from.light.type == LightType::point) return reached;
    const float cosine = -dot_of(reached.toward, from.axis);
    reached.factor *= cosine >= from.cosine ? power(at_least_zero(cosine), from.light.exponent) : 0.0f;
    return reached;
}

// The power of the cosine between the normal and the vector half way between the light and the eye.
[[nodiscard]] float highlight(const LightModel& model, const Three& position, const Three& normal,
                              const Three& toward) noexcept {
    const Three eye = model.has_local_viewer ? unit_of({-position[0], -position[1], -position[2]}) : Three{0, 0, 1};
    const Three half = unit_of({toward[0] + eye[0], toward[1] + eye[1], toward[2] + eye[2]});
    return power(at_least_zero(dot_of(normal, half)), model.shininess);
}

}  // namespace

Three unit_of(const Three& v) noexcept { return divided_by(v, std::sqrt(dot_of(v, v))); }

LitFace light_face(const EyeLighting& lighting, const Three& position, const Three& normal,
                   const Three& color) noexcept {
    const LightModel& model = lighting.model;
    const bool shines = model.specular != Vec3{};  // else its terms are zeros
    LitFace sum;
    for (std::size_t c = 0; c < 3; ++c) sum.primary[c] = model.emission[c] + model.ambient[c] * color[c];
    for (const EyeLight& from : lighting.lights) {
        const Reaching reached = reaching(from, position);
        const float cosine = at_least_zero(dot_of(normal, reached.toward));
        const float power = shines && cosine > 0.0f ? highlight(model, position, normal, reached.toward) : 0.0f;
        for (std::size_t c = 0; c < 3; ++c) {
            const Light& light = from.light;
            const float diffuse = light.ambient[c] * color[c] + cosine * (light.diffuse[c] * color[c]);
            const float specular = power * (light.specular[c] * model.specular[c]);
            if (model.separates_specular) {
                sum.primary[c] += reached.factor * diffuse;
                sum.secondary[c] += reached.factor * specular;
            } else {
                sum.primary[c] += reached.factor * (diffuse + specular);
            }
        }
    }
    return {in_range(sum.primary), in_range(sum.secondary)};
}

}  // namespace strata::pipeline
