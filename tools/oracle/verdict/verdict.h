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
    std::size_t kinds = 0;  // of which so many were tried
    std::string telling{};  // a command whose scene shows the explanations apart, if one is known
};

class SceneFragments;
class Colors;

// Asks the scene for what else may cover its edges where it has to.
[[nodiscard]] Verdict judge(SceneFragments& scene, const Colors& candidate);

}  // namespace strata::oracle::verdict
