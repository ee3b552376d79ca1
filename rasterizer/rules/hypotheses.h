// rasterizer/rules/hypotheses.h - every constant of the rules that is not known for certain, with its other values, by
// name.
//
// Rule     A list holds the given rules first ("as given"), then the rules with each other value of one constant after
//          the other. The subject is what the constant can change at all.
// Source   depth_hypothesis.h, interpolation_hypothesis.h.
// Tests    tests/rasterizer/rules/hypotheses_test.cpp
#pragma once
#include <string>
#include <vector>

#include "rasterizer/rules/rules.h"

namespace strata::rasterizer {

// Which of a fragment's values a constant can change at all.
enum class Subject : std::uint8_t {
    window_depth,   // depths that are written
    texture_depth,  // depths made of r and q: replaced, or compared with a texel
    color,
    coordinates  // of textures
};

struct NamedHypothesis {
    std::string name;  // "interpolant_bits=20"
    RasterRules rules;
    Subject subject{};
};

// The alternatives of depth_hypothesis.h, and of depth_rounding.
[[nodiscard]] std::vector<NamedHypothesis> depth_hypotheses(const RasterRules& rules);
[[nodiscard]] std::vector<NamedHypothesis> interpolation_hypotheses(const RasterRules& rules);

}  // namespace strata::rasterizer
