// tools/lab/hardware_check/hardware_page.h - writes the result of a hardware check as a page, for --report.
//
// Rule     The outcome in one sentence, the table of suites, an image of every difference (those outside their bound
//          first, after the chip's capture), then the pictures that are not equal with the reason.
// Tests    tests/tools/hardware_check_test.cpp, tests/browser/plain_pages.py
#pragma once
#include <vector>

#include "tools/lab/hardware_check/hardware_report.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

[[nodiscard]] PlainPage page_of(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
