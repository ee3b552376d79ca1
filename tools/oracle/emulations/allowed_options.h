// tools/oracle/emulations/allowed_options.h - legitimate options of a correct run, as changes that a diagnosis tries
// before all mistakes.
//
// Rule     First choices that a correct port may make silently: another rounding in blending, accumulators of other
//          formats with the same image format, another built-in or user profile. Then options that a user has to set
//          and that change the image: fewer passes, an epsilon, passes that compute other depths than the first, a
//          transparent background.
// Tests    tests/tools/oracle/emulations/allowed_options_test.cpp
#pragma once
#include <span>
#include <vector>

#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

// `right`: the caller's correct run of the algorithm. `more`: profiles in addition to the built-in ones.
[[nodiscard]] std::vector<Mistake> allowed_options(const peeling::Algorithm& algorithm, const RightRun& right,
                                                   std::span<const pipeline::DeviceProfile> more = {});

}  // namespace strata::oracle
