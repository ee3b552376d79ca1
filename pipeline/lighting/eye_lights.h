// pipeline/lighting/eye_lights.h - the lights of a scene in eye space.
//
// Rule     Positions by the view matrix, directions by its upper 3 x 3, in binary64 from left to right; directions
//          are divided by their length; each is rounded once to binary32. A spot's cosine is a series in binary64,
//          rounded once.
// Source   GL 2.1 2.14.1: lights are transformed when they are specified; pipeline/reference/lighting.md 2.
// Tests    tests/pipeline/lighting/vertex_light_test.cpp
#pragma once
#include "pipeline/lighting/light.h"

namespace strata::pipeline {

struct EyeLight {
    Light light{};
    Three toward{};    // of a directional light: the unit vector to it
    Three position{};  // of points and spots
    Three axis{};      // of a spot: the unit vector in which it shines
    float cosine = 0;  // of a spot's cutoff
};

struct EyeLighting {
    std::vector<EyeLight> lights{};
    LightModel model{};
};

[[nodiscard]] EyeLighting in_eye_space(const Lighting& lighting, const Matrix& view);

}  // namespace strata::pipeline
