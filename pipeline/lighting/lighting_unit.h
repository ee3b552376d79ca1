// pipeline/lighting/lighting_unit.h - NV2A's lighting of a vertex by the fixed pipeline: the primary and the secondary
// colour from its normal, its colours and up to eight lights.
//
// Rule     Constants are rounded to 22-bit floats; terms are added in the order emission and scene ambient, then each
//          light's ambient, diffuse and specular. Distances and directions of local lights are of the 32-bit unit and
//          then rounded. The specular term is a quotient of two polynomials instead of a power.
// Source   pipeline/reference/fog-and-lighting.md 5, from captures; the last bit of the specular term is open.
// Tests    tests/pipeline/geforce3/lighting_test.cpp; tests/tools/lab/hardware_check/suites_test.cpp: captures
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/lighting/light.h"

namespace strata::pipeline {

// Where a colour of the material comes from. `constant`: it is contained in the lights' colours.
enum class MaterialSource : std::uint8_t { constant, vertex_diffuse, vertex_specular };

enum class LightKind : std::uint8_t { off, infinite, local, spot };

struct LightRegisters {
    LightKind kind = LightKind::off;
    // Multiplied by the material's colours, unless those come from the vertex.
    Three ambient{}, diffuse{}, specular{};
    // Of infinite lights: unit vectors toward the light, and half way to the eye.
    Three direction{}, half_vector{};
    // Of local lights and spots, in eye space.
    Three position{};
    float range = 1e30f;
    Three attenuation{1, 0, 0};  // factors of 1, the distance, and its square
    // The cosine from the spot's axis is x . (x, y, z) + w of its direction, and its polynomial the falloff.
    std::array<float, 4> spot_direction{};
    Three spot_falloff{};
};

struct LightingRegisters {
    bool is_enabled = false;
    // SPECULAR_ENABLE, and LIGHT_CONTROL's three flags.
    bool has_specular = false, separates_specular = false, has_local_eye = false, has_specular_alpha = false;
    MaterialSource emission{}, ambient{}, diffuse{}, specular{};
    Three scene_ambient{}, material_emission{};
    Three eye_direction{};  // toward the eye, where it is not local
    float material_alpha = 1.0f;
    std::array<float, 6> specular_params{};
    std::array<LightRegisters, 8> light{};
};

struct UnlitVertex {
    Three position{}, normal{};  // in eye space
    std::array<float, 4> diffuse{}, specular{};
};

// r g b a as k / 255.
struct LitColors {
    std::array<float, 4> primary{}, secondary{};
};

// The vector divided by its length as the unit does it, rounded to 22 bits; 0 stays.
[[nodiscard]] Three unit_of_lighting(const Three& v) noexcept;

[[nodiscard]] LitColors light_vertex(const LightingRegisters& registers, const UnlitVertex& vertex) noexcept;

}  // namespace strata::pipeline
