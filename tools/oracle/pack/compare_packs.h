// tools/oracle/pack/compare_packs.h - how a candidate differs from a pack: the end, and the first pass that went
// another way.
//
// Rule     Each algorithm that the candidate has anything of is compared: its picture, its layers, and every target of
//          every pass. The first pass that differs beyond the tolerance is named; a table has them all.
// Tests    tests/tools/oracle/pack_pictures_test.cpp
#pragma once
#include "tools/oracle/compare.h"
#include "tools/oracle/pack/pack_pictures.h"

namespace strata::oracle {

// All targets of a pass that both have.
struct ComparedPass {
    int number = 0;
    std::string kind{};
    std::vector<TargetReport> targets{};
};

struct PassDifference {
    int number = 0, iteration = 0;
    std::string kind{};
    Comparison comparison{};
};

struct PackComparison {
    std::string algorithm{};
    bool is_there = true;  // false: the candidate has nothing of it
    std::optional<Comparison> picture{}, layers{};
    std::vector<ComparedPass> passes{};
    std::optional<PassDifference> first{};  // the first pass that differs
    std::vector<std::string> missing{};     // "picture", "pass 3": what the candidate has not
    bool equal = true, accepted = true;     // of what was compared
};

[[nodiscard]] std::vector<PackComparison> compare_packs(const std::vector<PackPictures>& reference,
                                                        const std::vector<PackPictures>& candidate,
                                                        const Tolerances& tolerances = {});

[[nodiscard]] std::string to_text(const std::vector<PackComparison>& comparisons);
[[nodiscard]] std::string to_json(const std::vector<PackComparison>& comparisons);
// Three test cases an algorithm: picture, layers and passes. What the candidate has not is skipped.
[[nodiscard]] std::string to_junit(const std::vector<PackComparison>& comparisons);

}  // namespace strata::oracle
