// pipeline/lighting/open_gl_light.h - OpenGL's light of a vertex in binary32.
//
// Rule     Every operation is rounded; sums of three from left to right; a power is log_exp.h's. A vertex at a light's
//          place gets nothing of it. A quotient beyond the largest number is that number. Colours are clamped to 0..1,
//          NaN to 0.
// Source   GL 2.1 2.14.1, equations 2.1 to 2.5, and 2.14.6; pipeline/reference/lighting.md 3.
// Tests    tests/pipeline/lighting/vertex_light_test.cpp
#pragma once
#include "pipeline/lighting/eye_lights.h"

namespace strata::pipeline {

// r g b of a face, each from 0 to 1. The secondary colour is 0 unless the model separates specular light.
struct LitFace {
    Three primary{}, secondary{};
};

// A vertex in eye space with a normal of length 1 or 0, and the face's own colour.
[[nodiscard]] LitFace light_face(const EyeLighting& lighting, const Three& position, const Three& normal,
                                 const Three& color) noexcept;

// v divided by its length in binary32; 0 if that is not above 0.
[[nodiscard]] Three unit_of(const Three& v) noexcept;

}  // namespace strata::pipeline
