// tools/lab/hardware_check/hardware_hypotheses.h - compares captures of NV2A with alternative values of the
// device profile's undetermined constants.
//
// Rule     A hypothesis is one value of an undetermined constant. It is scored on the captures of those suites that
//          depend on its subject (rasterizer::HypothesisSubject): captures of depth compare depths, all others colours.
//          There is one table per subject; its first row is the unmodified profile on the same captures.
// Tests    tests/tools/lab/hardware_check/hardware_check_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/hardware_check/hardware_report.h"

namespace strata::tools {

// Returns one text table per subject: equal captures, captures within the bound of their suite, differing pixels and
// the largest difference.
[[nodiscard]] std::string hypothesis_scores(const std::vector<Capture>& captures,
                                            const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
