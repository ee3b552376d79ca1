// peeling/registry.h - all algorithms.
#pragma once
#include <string_view>
#include <vector>

#include "peeling/algorithms/algorithm.h"

namespace strata::peeling {

// Everitt's and Bavoil's, then Carr's and what they compare themselves with, at last the oracle.
[[nodiscard]] const std::vector<Algorithm>& algorithms();
[[nodiscard]] const Algorithm* find_algorithm(std::string_view name);  // null if there is none

// The first feature that the profile lacks for it.
[[nodiscard]] pipeline::Verdict refusal(const Algorithm& algorithm, const pipeline::DeviceProfile& profile);

}  // namespace strata::peeling
