// pipeline/vertices/fog.h - OpenGL's fog: a fragment's colour is mixed with the fog's by its distance from the eye.
//
// Rule     The distance c is |z| of the vertex in eye space, interpolated. FogRule::single: f = (end - c) / (end -
//          start), exp(-density c) or exp(-(density c)^2), clamped to 0..1, then f C + (1 - f) Cf, all in binary32.
//          FogRule::bytes: NV2A's registers are set to the same formula, and fog_unit.h computes 8 bits. Alpha stays.
// Source   GL 2.1 3.10; pipeline/reference/fog-and-lighting.md 1 and 2.
// Tests    tests/pipeline/vertices/fog_test.cpp
#pragma once
#include <cstdint>

#include "rasterizer/base/vector.h"
#include "rasterizer/coverage/fragment_batch.h"

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

// Finite, two distances, no negative density, and a colour from 0 to 1.
[[nodiscard]] bool is_valid(const Fog& fog) noexcept;

// exp(-x) for x >= 0, to nearest but for values within 2^-20 of a unit from a tie.
[[nodiscard]] float exp_of_negative(double x) noexcept;

// f of a distance.
[[nodiscard]] float fog_factor(const Fog& fog, float distance) noexcept;

// NV2A's registers for this fog.
[[nodiscard]] FogRegisters fog_registers(const Fog& fog) noexcept;

// The value of a vertex that is interpolated.
[[nodiscard]] float vertex_fog(const Fog& fog, FogRule rule, float distance) noexcept;

// Mixes the colours of the batch with the fog by its interpolated values.
void mix_fog(const Fog& fog, FogRule rule, rasterizer::FragmentBatch& batch) noexcept;

}  // namespace strata::pipeline
