// pipeline/vertices/fog.cpp - what fog may not be, and NV2A's registers for it (fog.h).
#include "pipeline/vertices/fog.h"

#include <cmath>

#include "pipeline/device/profile.h"
#include "pipeline/lighting/fog_unit.h"

namespace strata::pipeline {

std::optional<FogFault> fault_of(const Fog& fog) noexcept {
    constexpr const char *distance = "a finite distance", *share = "a number from 0 to 1";
    if (!std::isfinite(fog.start)) return FogFault{"start", distance, fog.start};
    if (!std::isfinite(fog.end)) return FogFault{"end", distance, fog.end};
    if (fog.start == fog.end) return FogFault{"end", "another distance than start", fog.end};
    if (!std::isfinite(fog.density) || !(fog.density >= 0.0f))
        return FogFault{"density", "a finite number of at least 0", fog.density};
    for (std::size_t c = 0; c < 3; ++c)
        if (!(fog.color[c] >= 0.0f && fog.color[c] <= 1.0f)) return FogFault{"color", share, fog.color[c]};
    return std::nullopt;
}

// Eight octaves are ln 256, and the exponential functions halve v (fog-and-lighting.md 2.2).
FogRegisters fog_registers(const Fog& fog) noexcept {
    constexpr float ln_256 = 0x1.62e430p+2f, root_of_ln_256 = 0x1.2d6abep+1f;
    switch (fog.mode) {
        case FogMode::linear: break;
        case FogMode::exp: return {FogFunction::exp, 1.5f, -fog.density / (2.0f * ln_256), fog.color};
        case FogMode::exp2: return {FogFunction::exp2, 1.5f, -fog.density / (2.0f * root_of_ln_256), fog.color};
    }
    const float multiplier = -1.0f / (fog.end - fog.start);
    return {FogFunction::linear, 1.0f - fog.end * multiplier, multiplier, fog.color};
}

float vertex_fog(const Fog& fog, FogRule rule, float distance) noexcept {
    return rule == FogRule::bytes ? vertex_fog(fog_registers(fog), distance) : distance;
}

}  // namespace strata::pipeline
