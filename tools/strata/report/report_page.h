// tools/strata/report/report_page.h - the page itself: style, script and data in one file that needs nothing else.
#pragma once
#include <string>

#include "tools/strata/report/report_data.h"

namespace strata::tools {

[[nodiscard]] std::string report_page(const ReportData& data);

// The page of a command's run in a file; of a frame of more than 256x256 pixels its middle.
void write_report(RunOptions& options, const std::string& path);

// JSON that no "</script>" within a name can end.
[[nodiscard]] std::string script_safe(const nlohmann::ordered_json& document);

}  // namespace strata::tools
