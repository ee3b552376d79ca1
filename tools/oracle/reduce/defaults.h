// tools/oracle/reduce/defaults.h - simplifications of a scene: each resets one property to its default.
#pragma once
#include <span>
#include <string_view>

#include "tools/oracle/pack/golden.h"

namespace strata::oracle {

struct Simplification {
    std::string_view name{};  // what is removed, as in "not needed: the light, textures"
    // Returns false if there is nothing to reset.
    bool (*make)(Golden& scene) = nullptr;
};

[[nodiscard]] std::span<const Simplification> simplifications();

}  // namespace strata::oracle
