// tools/lab/cost/cost_row.h - writes a cell as a line of results.jsonl and of timings.jsonl, and combines both into a
// row of the report.
//
// Rule     scenes/reference/reports.md 10.2. Times are only in timings.jsonl. Of several timings of a cell the last is
//          used: an interrupted sweep may have measured it twice.
// Tests    tests/tools/cost_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/bench/spread.h"
#include "tools/lab/sweep/journal.h"

namespace strata::tools {

struct CostScene;   // tools/lab/cost/cost_run.h
struct CostCell;    // tools/lab/cost/cost_plan.h
struct CostResult;  // tools/lab/cost/cost_run.h
struct CostTimes;

// All keys of a complete line.
[[nodiscard]] std::vector<std::string> cost_keys();
[[nodiscard]] nlohmann::ordered_json cost_description(std::size_t number, const CostScene& scene, const CostCell& cell);
[[nodiscard]] nlohmann::ordered_json cost_line(std::size_t number, const CostScene& scene, const CostCell& cell,
                                               const CostResult& result);
[[nodiscard]] nlohmann::ordered_json cost_timing(std::size_t number, const CostTimes& times);

// Errors and counts of all cells; null is an empty field.
[[nodiscard]] std::string cost_csv(const Lines& lines);

// A cell in the report. Times are ratios to the cheapest cell of the scene in the same column.
struct CostRow {
    std::string scene, knob, value, opened, refusal;
    double rmse = 0, from_default = 0;
    std::optional<Spread> usual, literal;  // usual: in the default way of running
    std::optional<double> modelled;
    [[nodiscard]] bool is_chain() const { return knob == "chain" || knob == "alone"; }
};
[[nodiscard]] std::vector<CostRow> cost_rows(const Lines& lines, const Lines& timings);

}  // namespace strata::tools
