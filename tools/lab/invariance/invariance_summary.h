// tools/lab/invariance/invariance_summary.h - what the lines of a sweep say to people: a sentence, what all cells
// share, and a row a cell.
//
// Rule     A row and a label name every knob whose value is not the same in all lines, so that no two are alike.
// Tests    tests/tools/invariance_row_test.cpp
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/lab/sweep/journal.h"
#include "tools/strata/table.h"

namespace strata::tools {

// "30,20" of degrees; empty for null.
[[nodiscard]] std::string orbit_text(const nlohmann::ordered_json& degrees);
// "3..20", "..20", "3..", "none"; empty for null.
[[nodiscard]] std::string safe_text(const nlohmann::ordered_json& bias);

// One of the choices that make a cell: its title, and its value in a line; empty where the cell has none.
struct Knob {
    std::string title;
    std::function<std::string(const nlohmann::ordered_json& line)> text_of;
};
enum class Knobs : std::uint8_t { varying, alike };
// Those whose value is not the same in all lines, or those whose value is.
[[nodiscard]] std::vector<Knob> knobs_of(const Lines& lines, Knobs which);
// "cell 3, size 64x48, remedy bias:4".
[[nodiscard]] std::string label_of(const nlohmann::ordered_json& line, const std::vector<Knob>& knobs);

// For people: a row a cell with every knob that varies; the knobs that do not; what was found, as a sentence.
[[nodiscard]] Table summary_table(const Lines& lines);
[[nodiscard]] std::string same_everywhere(const Lines& lines);
[[nodiscard]] std::string found_sentence(const Lines& lines);

// All of these, the table of the first 50 lines, and where all of them and the page about them are.
[[nodiscard]] std::string summary(const Lines& lines, const std::string& folder);

}  // namespace strata::tools
