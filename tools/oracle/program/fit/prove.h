// tools/oracle/program/fit/prove.h - proves a program on the whole picture.
//
// Rule     A program explains a picture if, under one emulated rounding, at most 2 pixels or 0.2 % of the covered ones
//          are beyond what rounding explains, the residual has no mean and no slope, and it costs less than 1.5 bits
//          per covered pixel and 0.6 of what the right program costs. Pixels that it explains with its threshold on a
//          transmittance moved by two steps are not counted, up to 5 % of the covered ones. It explains a part if it
//          repairs more than 60 % of the wrong pixels, breaks fewer than 10 % of the right ones and costs less than
//          0.55.
// Tests    tests/tools/oracle/program/found_test.cpp
#pragma once
#include <algorithm>

#include "tools/oracle/program/fit/score.h"

namespace strata::oracle::program {

class FitSample;

struct Proof {
    Program program{};
    Fitness fitness{};
    bool is_whole = false, is_part = false;
    std::uint64_t open = 0;  // of the pixels beyond, those where a rounded transmittance decides (properties.h)
    bool is_equal = true;    // predicts the same picture as the first that is told
    double cost = 0;         // bits with the price of the words
    // The order in which equal explanations are told: plain words first, unless they leave more pixels wrong.
    [[nodiscard]] double rank() const {
        return price(program) + std::min(2.0 * static_cast<double>(fitness.beyond), 5.0);
    }
};

// `given`: the lists of the right program, of the same pixels, if they are others; `own`: the program's fitness, if it
// is known.
[[nodiscard]] Proof prove(const Lists& lists, const Program& program, const Fitness& right,
                          const Lists* given = nullptr, const Fitness* own = nullptr);
// Moves the thresholds of a program's last edit to where the whole picture costs least.
void place_thresholds(const Lists& lists, const FitSample& sample, Program& program, const PortRounding& rounding);
// Programs whose last edit has another property in a condition, which selects the same fragments of the sample.
[[nodiscard]] std::vector<Program> equal_programs(const FitSample& sample, const Program& program);
// A program with the lists on which it runs.
struct ProgramOn {
    const Lists& lists;
    const Program& program;
};
// True if both predict the same picture, to a code of the candidate. Their lists have the same pixels.
[[nodiscard]] bool predict_alike(const ProgramOn& a, const ProgramOn& b);

}  // namespace strata::oracle::program
