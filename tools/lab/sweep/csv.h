// tools/lab/sweep/csv.h - converts JSON lines to CSV rows.
//
// Rule     RFC 4180, with quotes only if a text needs them. A column is a JSON pointer; its title is the pointer
//          without the first slash and with dots for the others. A value that is missing or null is an empty field.
// Tests    tests/tools/lab/sweep/csv_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/sweep/sweep.h"

namespace strata::tools {

[[nodiscard]] std::string csv_field(const nlohmann::ordered_json& value);

// The header and one row per line.
[[nodiscard]] std::string csv_of_columns(const std::vector<std::string>& pointers, const Lines& lines);

}  // namespace strata::tools
