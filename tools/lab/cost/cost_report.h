// tools/lab/cost/cost_report.h - reports the rows of `strata cost` as a table, the frontier and sentences.
//
// Rule     A point is on the frontier if no other point of the scene has less error in the same or less time, or the
//          same error in less time; of equal points the first is on it. Every sentence contains only values of its row.
// Tests    tests/tools/cost_report_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/cost/cost_row.h"
#include "tools/strata/table.h"

namespace strata::tools {

struct CostPoint {
    double time = 0, error = 0;
    std::string name;
};

// Indices of the points on the frontier, cheapest first.
[[nodiscard]] std::vector<std::size_t> frontier_of(const std::vector<CostPoint>& points);

// One row per choice: knob, value, share of pixels that differ from the default's image, RMSE, and the ratio of times
// to the default's if they differ by more than the noise of the rounds.
[[nodiscard]] Table choice_table(const std::vector<CostRow>& rows);
// A summary of all rows.
[[nodiscard]] std::string summary_text(const std::vector<CostRow>& rows);

// One sentence per row: the change in error and time, or the cost of a link of the chain.
[[nodiscard]] std::vector<std::string> descriptions_of(const std::vector<CostRow>& rows);

// Errors and times of all rows, as CSV.
[[nodiscard]] std::string table_csv(const std::vector<CostRow>& rows);

// The rows of a scene that have a time in the column "default", "literal" or "modelled".
[[nodiscard]] std::vector<CostPoint> points_of(const std::vector<CostRow>& rows, const std::string& scene,
                                               const std::string& column);

// Error over time on logarithmic axes, with the frontier and the names of its points. An error of 0 is drawn on the
// lowest line.
[[nodiscard]] std::string frontier_svg(const std::vector<CostPoint>& points, const std::string& title,
                                       const std::string& time_label);

}  // namespace strata::tools
