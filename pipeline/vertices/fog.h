// pipeline/vertices/fog.h - OpenGL's fog as a state, and what a vertex contributes to it.
//
// Rule     The fog coordinate is |z| of the vertex in eye space, interpolated. Under FogRule::bytes NV2A's registers
//          are set to the same formula, and fog_unit.h says what is interpolated. stages/mix_fog.h mixes colours.
// Source   GL 2.1 3.10; pipeline/reference/fog-and-lighting.md 1 and 2.6.
// Tests    tests/pipeline/stages/mix_fog_test.cpp
#pragma once
#include <cstdint>
#include <optional>

#include "rasterizer/base/vector.h"

namespace strata::pipeline {

enum class FogRule : std::uint8_t;  // pipeline/device/profile.h
struct FogRegisters;                // fog_unit.h

enum class FogMode : std::uint8_t { linear, exp, exp2 };

struct Fog {
    FogMode mode = FogMode::linear;
    float start = 0.0f, end = 1.0f;  // of linear; not equal
    float density = 1.0f;            // of exp and exp2, at least 0
    Rgba color{0, 0, 0, 1};          // in the frame's colour space; its alpha is not used
    friend bool operator==(const Fog&, const Fog&) = default;
};

// The first field that is not what it must be: finite, two distances, no negative density, a colour from 0 to 1.
struct FogFault {
    const char *field, *expected;
    float found;
};
[[nodiscard]] std::optional<FogFault> fault_of(const Fog& fog) noexcept;

// NV2A's registers for this fog.
[[nodiscard]] FogRegisters fog_registers(const Fog& fog) noexcept;

// The value of a vertex that is interpolated.
[[nodiscard]] float vertex_fog(const Fog& fog, FogRule rule, float distance) noexcept;

}  // namespace strata::pipeline
