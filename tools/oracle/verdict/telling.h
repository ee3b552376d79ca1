// tools/oracle/verdict/telling.h - whether a scene tells structures apart that look the same on another one.
//
// Tests    tests/tools/oracle/verdict/telling_test.cpp
#pragma once
#include <vector>

#include "tools/oracle/verdict/rule.h"

namespace strata::oracle::verdict {

class SceneFragments;

// Whether a rule means the same on any scene: not one of a scene's own instances or materials.
[[nodiscard]] bool is_of_any_scene(const std::vector<Rule>& rules) noexcept;

// Whether an 8-bit port that goes by one of them differs from one that goes by any other, and from a right one, beyond
// rounding.
[[nodiscard]] bool tells_apart(const SceneFragments& scene, const std::vector<std::vector<Rule>>& all);

}  // namespace strata::oracle::verdict
