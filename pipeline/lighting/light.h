// pipeline/lighting/light.h - the lights of a scene, the lighting model and what all its surfaces share, as plain
// values.
//
// Rule     OpenGL's fixed function: up to eight lights, each of an ambient, a diffuse and a specular colour. The own
//          colour of a surface is its ambient and its diffuse one. vertex_light.h computes colours.
// Source   GL 2.1 2.14.1; pipeline/reference/lighting.md.
// Tests    tests/pipeline/lighting/vertex_light_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "rasterizer/base/vector.h"

namespace strata::pipeline {

enum class LightingRule : std::uint8_t;  // pipeline/device/profile.h

using Three = std::array<float, 3>;  // of a vector or colour

inline constexpr std::size_t most_lights = 8;  // GL_MAX_LIGHTS of the fixed function

enum class LightType : std::uint8_t { directional, point, spot };

struct Light {
    LightType type = LightType::directional;
    // In the frame's colour space; at least 0, and not limited above.
    Vec3 ambient{0, 0, 0}, diffuse{1, 1, 1}, specular{1, 1, 1};
    // In world space; the direction is the one in which a directional light or a spot shines.
    Vec3 position{0, 0, 0}, direction{0, 0, -1};
    // Of points and spots: 1 / (x + y d + z d d) at the distance d, and the distance beyond which there is no light.
    Vec3 attenuation{1, 0, 0};
    float range = std::numeric_limits<float>::infinity();
    // Of spots: the half angle of the cone in degrees, above 0 and at most 90, and the power of the angle's cosine.
    float cutoff = 45, exponent = 0;
    friend bool operator==(const Light&, const Light&) = default;
};

// GL_LIGHT_MODEL, and the material of all surfaces but for their colour.
struct LightModel {
    Vec3 ambient{0.2f, 0.2f, 0.2f};
    bool has_local_viewer = false, is_two_sided = false, separates_specular = false;
    Vec3 specular{0, 0, 0}, emission{0, 0, 0};
    float shininess = 0;  // 0 to 128
    friend bool operator==(const LightModel&, const LightModel&) = default;
};

struct Lighting {
    std::vector<Light> lights{};  // none: no lighting
    LightModel model{};
    LightingRule rule{};  // the profile's
};

// The first fault, by the names of the fields: "lights[2].cutoff".
struct LightFault {
    std::string field, expected, found;
};
[[nodiscard]] std::optional<LightFault> fault_of(const std::vector<Light>& lights);
[[nodiscard]] std::optional<LightFault> fault_of(const LightModel& model);

}  // namespace strata::pipeline
