// pipeline/lighting/light_registers.cpp - fills NV2A's lighting registers (light_registers.h).
#include "pipeline/lighting/light_registers.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/base/log_exp.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {

namespace {

[[nodiscard]] Three three_of(const Vec3& v) noexcept { return {v.x, v.y, v.z}; }

// How far below 1 a cosine is whose power is this one.
[[nodiscard]] double below_one(float exponent, float value) noexcept {
    return 1.0 - double{power(value, 1.0f / exponent)};
}

[[nodiscard]] Three half_way(const Three& a, const Three& b) noexcept {
    const std::array<double, 3> sum{double{a[0]} + double{b[0]}, double{a[1]} + double{b[1]},
                                    double{a[2]} + double{b[2]}};
    const double length = std::sqrt((sum[0] * sum[0] + sum[1] * sum[1]) + sum[2] * sum[2]);
    if (!(length > 0.0)) return {};
    return {static_cast<float>(sum[0] / length), static_cast<float>(sum[1] / length),
            static_cast<float>(sum[2] / length)};
}

// With u = 1 - cosine and the edge U: x = 1 - u / U from 0 to 1, and x / (B x + 1 - B).
void set_spot(LightRegisters& light, const EyeLight& from) noexcept {
    const float exponent = from.light.exponent;
    double edge = 1.0 - double{from.cosine};
    if (exponent > 0.0f) edge = std::min(edge, below_one(exponent, 0.0625f));
    edge = std::max(edge, 0x1p-24);  // of a cone so narrow that its cosine is 1
    const double middle = double{power(static_cast<float>(1.0 - edge / 2.0), exponent)};
    for (std::size_t i = 0; i < 3; ++i) light.spot_direction[i] = static_cast<float>(-double{from.axis[i]} / edge);
    light.spot_direction[3] = static_cast<float>(1.0 - 1.0 / edge);
    light.spot_falloff = {0.0f, static_cast<float>(2.0 - 1.0 / middle), static_cast<float>(1.0 / middle - 1.0)};
}

[[nodiscard]] LightRegisters registers_of(const EyeLight& from, const LightModel& model) noexcept {
    LightRegisters light{.ambient = three_of(from.light.ambient), .diffuse = three_of(from.light.diffuse)};
    for (std::size_t c = 0; c < 3; ++c) light.specular[c] = from.light.specular[c] * model.specular[c];
    if (from.light.type == LightType::directional) {
        light.kind = LightKind::infinite;
        light.direction = from.toward;
        light.half_vector = half_way(from.toward, {0, 0, 1});
        return light;
    }
    light.kind = from.light.type == LightType::point ? LightKind::local : LightKind::spot;
    light.position = from.position;
    light.range = from.light.range;
    light.attenuation = three_of(from.light.attenuation);
    if (light.kind == LightKind::spot) set_spot(light, from);
    return light;
}

}  // namespace

// u = 1 - s: (D - u) / (D - B u), so that x = D - 1, y = B, z = D - B.
Three power_quotient(float exponent) noexcept {
    if (exponent == 0.0f) return {0, 1, 0};
    const double half = below_one(exponent, 0.5f), quarter = below_one(exponent, 0.25f);
    const double b = (6.0 * half - 4.0 * quarter) / (3.0 * half - quarter), d = half * (2.0 - b);
    return {static_cast<float>(d - 1.0), static_cast<float>(b), static_cast<float>(d - b)};
}

LightingRegisters light_registers(const EyeLighting& lighting) noexcept {
    const LightModel& model = lighting.model;
    LightingRegisters registers{.is_enabled = true,
                                .has_specular = true,
                                .separates_specular = model.separates_specular,
                                .has_local_eye = model.has_local_viewer,
                                .ambient = MaterialSource::vertex_diffuse,
                                .diffuse = MaterialSource::vertex_diffuse,
                                .scene_ambient = three_of(model.emission),
                                .material_emission = three_of(model.ambient),
                                .eye_direction = {0, 0, 1}};
    std::ranges::copy(power_quotient(model.shininess), registers.specular_params.begin());
    std::ranges::copy(power_quotient(model.shininess / 2), registers.specular_params.begin() + 3);
    for (std::size_t i = 0; i < std::min(lighting.lights.size(), most_lights); ++i)
        registers.light[i] = registers_of(lighting.lights[i], model);
    return registers;
}

}  // namespace strata::pipeline
