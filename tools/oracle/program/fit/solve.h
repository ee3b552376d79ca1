// tools/oracle/program/fit/solve.h - solves single pixels: which edit of which fragment gives the colour that is seen?
// And learns which property the edited fragments have in common.
//
// Rule     Every fragment of every sampled pixel is edited alone, by every entry that acts on one fragment. It is a hit
//          if the prediction is within 1.5 + 0.12 layers codes, and visible if it moves by more than that + 1.5.
//          Positive examples are the hits of wrong pixels that have exactly one; negative ones are the other fragments
//          there, and those of right pixels where the edit is visible. Conditions are joined as by FOIL: the one with
//          the most gain is added, up to three, until 98 % of the selected examples are positive.
// Source   J. R. Quinlan, 1990, Learning logical definitions from relations.
// Tests    tests/tools/oracle/program/found_test.cpp
#pragma once
#include <vector>

#include "tools/oracle/program/fit/sample.h"

namespace strata::oracle::program {

// An entry with a value of its parameter.
struct Variation {
    const StepEntry* entry = nullptr;
    std::vector<double> parameters{};
};
// All entries with all candidates of their parameters.
[[nodiscard]] std::vector<Variation> variations();

struct Solved {
    Variation variation{};
    std::vector<std::size_t> hits{};    // positive examples: fragments of the sample
    std::vector<std::size_t> spared{};  // negative examples
    double saved = 0;                   // by the variation without a condition
};

// For each variation, in their order. Those that do not act on one fragment have no examples.
[[nodiscard]] std::vector<Solved> solve(const FitSample& sample);
// Thresholds of a property that separate the values of a sample.
[[nodiscard]] std::vector<Condition> conditions_of(const FragmentProperty& property, std::vector<double> values);
[[nodiscard]] std::vector<Condition> learn(const FitSample& sample, const Solved& solved);

}  // namespace strata::oracle::program
