// tools/lab/hardware_check/hardware_hypotheses.h - which of a profile's open constants the captures favour.
//
// Rule     A hypothesis is scored on the captures that its subject can change: words of depth pictures, colours of the
//          others, of the suites that can tell. A table a subject, "as given" on the same captures first.
// Tests    tests/tools/hardware_check_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/hardware_check/hardware_report.h"

namespace strata::tools {

[[nodiscard]] std::string hypothesis_scores(const std::vector<Capture>& captures,
                                            const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
