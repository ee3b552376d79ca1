// tools/oracle/reduce/defaults.h - simplifications of a scene: each resets one property to its default.
//
// Rule     Properties of the scene are listed here; options are those of the table of options (tools/request), without
//          the two conventions that the view is written in.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/oracle/pack/golden.h"

namespace strata::oracle {

struct Simplification {
    std::string name{};  // what is removed, as in "not needed: the light, textures, --scissor"
    // Returns false if there is nothing to reset.
    std::function<bool(Golden& scene)> make{};
};

[[nodiscard]] std::vector<Simplification> simplifications();

}  // namespace strata::oracle
