// pipeline/lighting/light.cpp - what lights and a lighting model may not be (light.h).
#include "pipeline/lighting/light.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace strata::pipeline {

namespace {

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_zero(const Vec3& v) { return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f; }
std::string text_of(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", double{value});
    return text.data();
}
std::string text_of(const Vec3& v) { return text_of(v.x) + "," + text_of(v.y) + "," + text_of(v.z); }

// Bounded, so that no product of a light's and a surface's colour overflows.
constexpr float greatest_color = 1e9f;

bool is_color(const Vec3& v) {
    return std::ranges::all_of(components(v), [](float c) { return c >= 0.0f && c <= greatest_color; });
}

using Fault = std::optional<LightFault>;

Fault of_vector(bool is_right, const char* field, const char* expected, const Vec3& found) {
    return is_right ? std::nullopt : Fault{{field, expected, text_of(found)}};
}
Fault of_number(bool is_right, const char* field, const char* expected, float found) {
    return is_right ? std::nullopt : Fault{{field, expected, text_of(found)}};
}
Fault of_color(const char* field, const Vec3& found) {
    return of_vector(is_color(found), field, "three numbers from 0 to 1e9", found);
}

Fault fault_of_attenuation(const Light& light) {
    const Vec3& a = light.attenuation;
    const bool is_right = is_finite(a) && std::ranges::all_of(components(a), [](float k) { return k >= 0.0f; });
    return of_vector(is_right && !is_zero(a), "attenuation", "three numbers of at least 0, not all 0", a);
}

Fault fault_of_spot(const Light& light) {
    if (auto fault = of_number(light.cutoff > 0.0f && light.cutoff <= 90.0f, "cutoff",
                               "an angle above 0 and of at most 90 degrees", light.cutoff))
        return fault;
    return of_number(light.exponent >= 0.0f && light.exponent <= 128.0f, "exponent", "a number from 0 to 128",
                     light.exponent);
}

Fault fault_of_light(const Light& light) {
    for (const auto& [field, color] : {std::pair{"ambient", &light.ambient}, std::pair{"diffuse", &light.diffuse},
                                       std::pair{"specular", &light.specular}})
        if (auto fault = of_color(field, *color)) return fault;
    if (light.type != LightType::point)
        if (auto fault = of_vector(is_finite(light.direction) && !is_zero(light.direction), "direction",
                                   "a finite direction that is not 0,0,0", light.direction))
            return fault;
    if (light.type == LightType::directional) return std::nullopt;
    if (auto fault = of_vector(is_finite(light.position), "position", "a finite place", light.position)) return fault;
    if (auto fault = fault_of_attenuation(light)) return fault;
    if (auto fault = of_number(light.range > 0.0f, "range", "a distance above 0", light.range)) return fault;
    return light.type == LightType::spot ? fault_of_spot(light) : std::nullopt;
}

}  // namespace

std::optional<LightFault> fault_of(const std::vector<Light>& lights) {
    if (lights.size() > most_lights)
        return LightFault{"lights", "at most " + std::to_string(most_lights), std::to_string(lights.size())};
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (auto fault = fault_of_light(lights[i])) {
            fault->field = "lights[" + std::to_string(i) + "]." + fault->field;
            return fault;
        }
    return std::nullopt;
}

std::optional<LightFault> fault_of(const LightModel& model) {
    for (const auto& [field, color] : {std::pair{"ambient", &model.ambient}, std::pair{"specular", &model.specular},
                                       std::pair{"emission", &model.emission}})
        if (auto fault = of_color(field, *color)) return fault;
    return of_number(model.shininess >= 0.0f && model.shininess <= 128.0f, "shininess", "a number from 0 to 128",
                     model.shininess);
}

}  // namespace strata::pipeline
