// pipeline/stages/mix_fog.cpp - the factor of OpenGL's fog and the mix (mix_fog.h). The C library's exp differs between
// computers, so that this one is our own.
#include "pipeline/stages/mix_fog.h"

#include <algorithm>

#include "pipeline/device/profile.h"
#include "pipeline/formats/unorm8.h"
#include "pipeline/lighting/fog_unit.h"
#include "rasterizer/chip/truncated_weights.h"

namespace strata::pipeline {

namespace {

constexpr double log2_of_e = 0x1.71547652b82fep+0;
// ln 2 in two parts; the first has 32 bits, so that its product with a small integer is exact.
constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;

void mix_single(const Fog& fog, rasterizer::FragmentBatch& batch) noexcept {
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        const float f = fog_factor(fog, batch.fog[i]), rest = 1.0f - f;
        for (std::size_t c = 0; c < 3; ++c) batch.color[c][i] = f * batch.color[c][i] + rest * fog.color[c];
    }
}

// As the final combiner does: A B + (1 - A) C, rounded once.
void mix_bytes(const Fog& fog, rasterizer::FragmentBatch& batch) noexcept {
    const FogRegisters registers = fog_registers(fog);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        const auto f = static_cast<std::uint32_t>(fog_factor(registers, batch.fog[i]));
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t sum = f * to_unorm8(batch.color[c][i]) + (255 - f) * to_unorm8(fog.color[c]);
            batch.color[c][i] = unorm8_value((sum + 127) / 255);
        }
    }
}

}  // namespace

// x = n ln 2 + r with |r| <= ln 2 / 2; exp(-r) by its series, whose 14th term is below 2^-55.
float exp_of_negative(double x) noexcept {
    if (!(x < 110.0)) return 0.0f;
    const auto n = static_cast<int>(x * log2_of_e + 0.5);
    const double r = (x - n * ln2_high) - n * ln2_low;
    double series = 1.0;
    for (int k = 14; k > 0; --k) series = 1.0 - series * (r / k);
    return static_cast<float>(series * rasterizer::power_of_two(-n));
}

float fog_factor(const Fog& fog, float distance) noexcept {
    float f = 0.0f;
    switch (fog.mode) {
        case FogMode::linear: f = (fog.end - distance) / (fog.end - fog.start); break;
        case FogMode::exp: f = exp_of_negative(double{fog.density * distance}); break;
        case FogMode::exp2: {
            const double product = double{fog.density * distance};
            f = exp_of_negative(product * product);
            break;
        }
    }
    return std::min(std::max(f, 0.0f), 1.0f);
}

void mix_fog(const Fog& fog, FogRule rule, rasterizer::FragmentBatch& batch) noexcept {
    if (rule == FogRule::bytes)
        mix_bytes(fog, batch);
    else
        mix_single(fog, batch);
}

}  // namespace strata::pipeline
