// tools/strata/report/report_page.h - assembles the report page: style, script and data in one self-contained file.
#pragma once
#include <string>

#include "tools/strata/report/report_data.h"

namespace strata::tools {

[[nodiscard]] std::string report_page(const ReportData& data);

// Writes the page of a command to a file; of a frame over 256 x 256 pixels it shows the middle.
void write_report(RunOptions& options, const std::string& path);

// JSON in which "</script>" within a name is escaped, so it cannot end the script element.
[[nodiscard]] std::string script_safe(const nlohmann::ordered_json& document);

}  // namespace strata::tools
