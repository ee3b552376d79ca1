// tools/lab/hardware_check/hardware_hypotheses.h - scores alternatives for a profile's undetermined constants on the
// captures.
//
// Rule     A hypothesis is scored on the captures that its subject can affect: depth values of depth pictures, colours
//          of the others, of the relevant suites. There is one table per subject; its first row is the profile "as
//          given" on the same captures.
// Tests    tests/tools/hardware_check_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/hardware_check/hardware_report.h"

namespace strata::tools {

[[nodiscard]] std::string hypothesis_scores(const std::vector<Capture>& captures,
                                            const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
