// tools/lab/hardware_check/hardware_page.h - what a hardware check found as a page of --report.
//
// Rule     The outcome in a sentence, the table of suites, a picture of every difference (those beyond their bound
//          first, with the chip's picture before it), then the pictures that are not equal and why.
// Tests    tests/tools/hardware_check_test.cpp, tests/browser/plain_pages.py
#pragma once
#include <vector>

#include "tools/lab/hardware_check/hardware_report.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

[[nodiscard]] PlainPage page_of(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
