// tools/lab/invariance/invariance_summary.h - a summary of a sweep's lines: a sentence, the values that all cells
// share, and one row per cell.
//
// Rule     A row contains every knob whose value is not the same in all lines, so that all rows are different.
// Tests    tests/tools/lab/invariance/invariance_row_test.cpp
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/lab/sweep/sweep.h"
#include "tools/strata/table.h"

namespace strata::tools {

// "30,20" for degrees; empty for null.
[[nodiscard]] std::string orbit_text(const nlohmann::ordered_json& degrees);
// "3..20", "..20", "3..", "none"; empty for null.
[[nodiscard]] std::string safe_text(const nlohmann::ordered_json& bias);

// A choice of a cell: its title, and its value in a line; empty if the cell has none.
struct Knob {
    std::string title;
    std::function<std::string(const nlohmann::ordered_json& line)> text_of;
};
enum class Knobs : std::uint8_t { varying, alike };
// The knobs whose value is not the same in all lines, or those whose value is.
[[nodiscard]] std::vector<Knob> knobs_of(const Lines& lines, Knobs which);

// One row per cell with every knob that varies.
[[nodiscard]] Table summary_table(const Lines& lines);
// The knobs that do not vary.
[[nodiscard]] std::string same_everywhere(const Lines& lines);
// The result, as a sentence.
[[nodiscard]] std::string summary_text(const Lines& lines);

// All of these, with the first 50 rows of the table, and where the complete results and the page are.
[[nodiscard]] std::string summary(const Lines& lines, const std::string& folder);

}  // namespace strata::tools
