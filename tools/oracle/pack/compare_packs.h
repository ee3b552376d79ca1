// tools/oracle/pack/compare_packs.h - compares a candidate with a pack: the final image, and the first pass that
// differs.
//
// Rule     Each algorithm of which the candidate has any file is compared: its image, its layers, and every target of
//          every pass. The first pass that differs beyond the tolerance is reported; a table lists all.
// Tests    tests/tools/oracle/pack/pack_pictures_test.cpp
#pragma once
#include "tools/oracle/compare/compare.h"
#include "tools/oracle/pack/pack_pictures.h"

namespace strata::oracle {

// The targets of a pass that both have.
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
    bool is_there = true;  // false: the candidate has no file of it
    std::optional<Comparison> picture{}, layers{};
    std::vector<ComparedPass> passes{};
    std::optional<PassDifference> first{};  // the first pass that differs
    std::vector<std::string> missing{};     // "picture", "pass 3": parts missing from the candidate
    bool equal = true, accepted = true;     // of the parts that were compared
};

[[nodiscard]] std::vector<PackComparison> compare_packs(const std::vector<PackPictures>& reference,
                                                        const std::vector<PackPictures>& candidate,
                                                        const Tolerances& tolerances = {});

[[nodiscard]] std::string to_text(const std::vector<PackComparison>& comparisons);
[[nodiscard]] std::string to_json(const std::vector<PackComparison>& comparisons);
// Three test cases per algorithm: picture, layers and passes. Parts missing from the candidate are skipped.
[[nodiscard]] std::string to_junit(const std::vector<PackComparison>& comparisons);

}  // namespace strata::oracle
