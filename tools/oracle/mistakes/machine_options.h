// tools/oracle/mistakes/machine_options.h - what a caller may have asked of a right machine, as changes that a
// diagnosis tries before all mistakes.
//
// Rule     First what a right port may do without a word: another rounding of its blends, accumulators of other formats
//          below the same picture, another of the built-in profiles or of the user's. Then what a user has to ask for,
//          and what leaves another picture than the one that was meant: fewer passes, an epsilon, a background that
//          lets light through.
// Tests    tests/tools/oracle/mistakes/machine_options_test.cpp
#pragma once
#include <span>
#include <vector>

#include "tools/oracle/mistakes/catalogue.h"

namespace strata::oracle {

// `right`: of the algorithm's run as the caller knows it. `more`: profiles beside the built-in ones.
[[nodiscard]] std::vector<Mistake> machine_options(const peeling::Algorithm& algorithm, const RightRun& right,
                                                   std::span<const pipeline::DeviceProfile> more = {});

}  // namespace strata::oracle
