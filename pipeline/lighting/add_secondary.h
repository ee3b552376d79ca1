// pipeline/lighting/add_secondary.h - adds the secondary colours of fragments to their colours (GL_COLOR_SUM).
//
// Rule     r g b: the sum, at most 1; alpha stays. LightingRule::single: one addition in binary32. float22: both are
//          codes, and so is the sum, at most 255.
// Source   GL 2.1 3.9; pipeline/reference/lighting.md 5.
// Tests    tests/pipeline/stages/add_secondary_test.cpp
#pragma once
#include <algorithm>

#include "pipeline/device/profile.h"
#include "pipeline/formats/unorm8.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

inline void add_secondary(LightingRule rule, rasterizer::FragmentBatch& batch) noexcept {
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            float& color = batch.color[c][i];
            const float secondary = batch.secondary[c][i];
            if (rule == LightingRule::single)
                color = std::min(color + secondary, 1.0f);
            else
                color = unorm8_value(std::min<std::uint32_t>(to_unorm8(color) + to_unorm8(secondary), 255u));
        }
}

}  // namespace strata::pipeline
