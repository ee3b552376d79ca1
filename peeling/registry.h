// peeling/registry.h - all algorithms.
#pragma once
#include <functional>
#include <string_view>
#include <vector>

#include "peeling/algorithms/algorithm.h"

namespace strata::peeling {

// In the order of Everitt's and Bavoil's algorithms, Carr's and those he compares them with, then the oracle.
[[nodiscard]] const std::vector<Algorithm>& algorithms();
[[nodiscard]] const Algorithm* find_algorithm(std::string_view name);  // null if there is none

// The first feature required by the algorithm that the profile lacks.
[[nodiscard]] std::optional<pipeline::Refusal> refusal(const Algorithm& algorithm,
                                                       const pipeline::DeviceProfile& profile);

// The function that is executed for every region: the algorithm's resolve if it applies, else its passes. `algorithm`
// must outlive it.
[[nodiscard]] std::function<void(pipeline::Region&)> body_of(const Algorithm& algorithm, const ListingInputs& inputs);

}  // namespace strata::peeling
