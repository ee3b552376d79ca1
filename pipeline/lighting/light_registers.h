// pipeline/lighting/light_registers.h - NV2A's lighting registers for the lights of a scene.
//
// Rule     The surface's colour is that of the vertex, as ambient and as diffuse colour: the register of the scene's
//          ambient light has the emission, and that of the emission the model's ambient light. A power n of a cosine s
//          is the quotient of fog-and-lighting.md 5.3 that is 1, 1/2 and 1/4 where the power is; of squares that of
//          n / 2. A spot's falloff is 1 on its axis, the power in the middle, and 0 at the cutoff or where the power
//          is 1/16, whichever is nearer to the axis.
// Source   pipeline/reference/lighting.md 4. Assumed: which quotient a driver chose is not known.
// Tests    tests/pipeline/geforce3/light_registers_test.cpp
#pragma once
#include "pipeline/lighting/eye_lights.h"
#include "pipeline/lighting/lighting_unit.h"

namespace strata::pipeline {

[[nodiscard]] LightingRegisters light_registers(const EyeLighting& lighting) noexcept;

// (s + x) / (s y + z) instead of s^exponent.
[[nodiscard]] Three power_quotient(float exponent) noexcept;

}  // namespace strata::pipeline
