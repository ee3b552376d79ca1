// tools/lab/invariance/invariance_row.h - one measured cell as a line of results.jsonl and as a row of
// results.csv.
//
// Rule     A line has the cell's number, the description of the measurement, then the results, in a fixed order of
//          keys; a row has the columns of csv_header(). Numbers are written in the shortest form that reads back to the
//          same bits; nothing depends on time, threads or host.
// Tests    tests/tools/lab/invariance/invariance_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tools/lab/invariance/invariance_cell.h"
#include "tools/lab/sweep/sweep.h"

namespace strata::tools {

// The keys that are known before the cell is measured.
[[nodiscard]] nlohmann::ordered_json description(std::size_t number, const Cell& cell, const CellView& view);

// The complete line, without a line end.
[[nodiscard]] nlohmann::ordered_json to_line(std::size_t number, const Cell& cell, const CellResult& result);

// The content of results.csv for these lines.
[[nodiscard]] std::string csv_of(const Lines& lines);

[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string to_csv(const nlohmann::ordered_json& line);  // both with a line end

}  // namespace strata::tools
