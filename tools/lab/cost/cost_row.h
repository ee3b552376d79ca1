// tools/lab/cost/cost_row.h - writes a cell as a line of results.jsonl and of timings.jsonl.
//
// Rule     scenes/reference/reports.md 10.2. Times are only in timings.jsonl.
// Tests    tests/tools/lab/cost/cost_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tools/lab/sweep/sweep.h"

namespace strata::tools {

struct CostScene;   // tools/lab/cost/cost_run.h
struct CostCell;    // tools/lab/cost/cost_plan.h
struct CostResult;  // tools/lab/cost/cost_run.h
struct CostTimes;

[[nodiscard]] nlohmann::ordered_json cost_description(std::size_t number, const CostScene& scene, const CostCell& cell);
[[nodiscard]] nlohmann::ordered_json cost_line(std::size_t number, const CostScene& scene, const CostCell& cell,
                                               const CostResult& result);
[[nodiscard]] nlohmann::ordered_json cost_timing(std::size_t number, const CostTimes& times);

// Errors and counts of all cells; null is an empty field.
[[nodiscard]] std::string cost_csv(const Lines& lines);

}  // namespace strata::tools
