// tools/oracle/rules/distinguish_rules.h - tests whether a scene distinguishes mistakes that give equal pictures of
// another scene.
//
// Tests    tests/tools/oracle/rules/distinguish_rules_test.cpp
#pragma once
#include <vector>

#include "tools/oracle/rules/rule.h"

namespace strata::oracle::verdict {

class SceneFragments;

// True if the rules have the same meaning in any scene, so they name no instances or materials.
[[nodiscard]] bool is_of_any_scene(const std::vector<Rule>& rules) noexcept;

// True if 8-bit ports with each of these mistakes, and a right one, all differ from each other by more than rounding.
[[nodiscard]] bool distinguishes(const SceneFragments& scene, const std::vector<std::vector<Rule>>& all);

}  // namespace strata::oracle::verdict
