// rasterizer/rules/hypotheses.h - lists the alternative values of every constant of the rules that is not certain, by
// name.
//
// Rule     A list has the given rules first ("as given"), then the rules with each alternative value of one constant
//          after the other. The subject is the kind of value that the constant can affect.
// Source   depth_hypothesis.h, interpolation_hypothesis.h.
// Tests    tests/rasterizer/rules/hypotheses_test.cpp
#pragma once
#include <string>
#include <vector>

#include "rasterizer/rules/rules.h"

namespace strata::rasterizer {

// The kind of fragment value that a constant can affect.
enum class HypothesisSubject : std::uint8_t {
    window_depth,   // depths that are written
    texture_depth,  // depths computed from r and q: replaced, or compared with a texel
    color,
    coordinates  // texture coordinates
};

struct NamedHypothesis {
    std::string name;  // "interpolant_bits=20"
    RasterRules rules;
    HypothesisSubject subject{};
};

// The alternatives of depth_hypothesis.h and of depth_rounding.
[[nodiscard]] std::vector<NamedHypothesis> depth_hypotheses(const RasterRules& rules);
[[nodiscard]] std::vector<NamedHypothesis> interpolation_hypotheses(const RasterRules& rules);

}  // namespace strata::rasterizer
