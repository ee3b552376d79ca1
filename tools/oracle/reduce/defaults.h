// tools/oracle/reduce/defaults.h - simpler states of a scene: each takes one thing back to its default.
#pragma once
#include <span>
#include <string_view>

#include "tools/oracle/pack/golden.h"

namespace strata::oracle {

struct Simplification {
    std::string_view name{};  // what goes, as in "not needed: the light, textures"
    // False: the scene has nothing of the kind.
    bool (*make)(Golden& scene) = nullptr;
};

[[nodiscard]] std::span<const Simplification> simplifications();

}  // namespace strata::oracle
