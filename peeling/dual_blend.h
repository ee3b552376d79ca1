// peeling/dual_blend.h - how dual peeling blends on the fly under MAX: what its passes and its closed form share.
// Bavoil and Myers 2008, "Blending on the Fly"; algorithms.md 5.
#pragma once
#include "peeling/programs.h"

namespace strata::peeling {
inline namespace strict {

// `front` has alpha = 1 - transmittance; `color` is straight.
inline void blend_under(const pipeline::ColorLanes& front, const pipeline::ColorLanes& color, pipeline::ColorLanes& out,
                        std::size_t count) noexcept {
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count; ++i)
            out[c][i] = front[c][i] + (1.0f - front[3][i]) * (color[3][i] * color[c][i]);
    for (std::size_t i = 0; i < count; ++i) out[3][i] = 1.0f - (1.0f - front[3][i]) * (1.0f - color[3][i]);
}

}  // namespace strict

// Publishes front over back, alpha 1.
void publish_front_and_back(pipeline::Region& region, pipeline::Target front, pipeline::Target back);

}  // namespace strata::peeling
