// pipeline/stages/mix_fog.h - mixes the colours of fragments with the fog's.
//
// Rule     c is the interpolated value of fog.h. FogRule::single: f = (end - c) / (end - start), exp(-density c) or
//          exp(-(density c)^2), clamped to 0..1, then f C + (1 - f) Cf, all in binary32. FogRule::bytes: f of
//          fog_unit.h, and one mix of 8-bit codes to nearest. Alpha stays.
// Source   GL 2.1 3.10; pipeline/reference/fog-and-lighting.md 1 and 2.
// Tests    tests/pipeline/stages/mix_fog_test.cpp
#pragma once
#include "pipeline/vertices/fog.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// exp(-x) for x >= 0, to nearest but for values within 2^-20 of a unit from a tie.
[[nodiscard]] float exp_of_negative(double x) noexcept;

// f of a distance, FogRule::single.
[[nodiscard]] float fog_factor(const Fog& fog, float distance) noexcept;

// Mixes the colours of the batch with the fog by its interpolated values.
void mix_fog(const Fog& fog, FogRule rule, rasterizer::FragmentBatch& batch) noexcept;

}  // namespace strata::pipeline
