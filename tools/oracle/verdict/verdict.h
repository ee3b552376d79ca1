// tools/oracle/verdict/verdict.h - is a picture of a scene right, and if not, which fragments did it composite
// otherwise?
//
// Rule     A picture is right if the right structure reaches every pixel under one hypothesis about rounding. Definite
//          hypotheses (one rounding and one format an end, attributes off by units in the last place at most) come
//          first. If none holds, a loose one has to tell the picture in fewer bits than the closest definite one with
//          its wrong pixels (pricing.h). Else the picture is wrong: what explains all of it is a finding, whatever
//          explains a part of it is a lead. Findings that look the same here are all told; none is preferred.
// Tests    tests/tools/oracle/verdict/verdict_test.cpp
#pragma once
#include <string>

#include "tools/oracle/verdict/account.h"
#include "tools/oracle/verdict/rules.h"

namespace strata::oracle::verdict {

struct Verdict {
    bool is_right = false;
    int width = 0;  // of the picture
    SceneFacts facts{};
    Checked right{};                      // the right structure's account that is the closest
    std::vector<Checked> explanations{};  // of a wrong picture
    std::vector<Lead> leads{};            // where nothing explains all of it
    // Kinds of mistakes in the structure that the picture does not tell from what is found: of a right one, those that
    // would look right, too.
    std::vector<Rule> alike{};
    std::size_t kinds = 0;    // of which so many were tried
    bool is_stopped = false;  // the search ended before all was tried
    std::string telling{};    // a command whose scene shows the explanations apart, if one is known

    // A right port may leave every pixel by rounding of more than two codes, but not all was tried that may tell the
    // picture more closely.
    [[nodiscard]] bool is_undecided() const noexcept { return !is_right && explanations.empty() && right.is_whole(); }
};

class SceneFragments;
class Colors;

// Of a search, in layers that are listed or composited (work.h): some 15 million of them take a second. Whether a
// picture is right takes no part of it.
struct SearchLimits {
    std::uint64_t mistakes = 60'000'000;   // of a wrong picture
    std::uint64_t narrower = 450'000'000;  // what tells in fewer bits what a right port may leave
    std::uint64_t leads = 30'000'000;
    std::uint64_t of_fragment = 4;  // and for each fragment of the scene
};

// Asks the scene for what else may cover its edges where it has to.
[[nodiscard]] Verdict judge(SceneFragments& scene, const Colors& candidate, const SearchLimits& limits = {});

}  // namespace strata::oracle::verdict
