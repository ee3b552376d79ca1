// tools/lab/cost/cost_report.h - what the rows of `strata cost` say to people: a table, the frontier, sentences.
//
// Rule     A point is on the frontier if no other point of the scene takes less or the same time and has less error,
//          nor the same error in less time; of equal points the first. Every sentence is made of its row's figures.
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

// Numbers of the points on the frontier, cheapest first.
[[nodiscard]] std::vector<std::size_t> frontier_of(const std::vector<CostPoint>& points);

// A row a choice: knob, value, share of pixels that differ from the default's picture, RMSE, and times in those of the
// default, where they differ by more than the noise of the rounds.
[[nodiscard]] Table choice_table(const std::vector<CostRow>& rows);
// What all rows together say.
[[nodiscard]] std::string found_sentence(const std::vector<CostRow>& rows);

// A sentence a row: what the knob changes, for how much time; what a link of the chain costs.
[[nodiscard]] std::vector<std::string> sentences_of(const std::vector<CostRow>& rows);

// Errors and times of all rows.
[[nodiscard]] std::string table_csv(const std::vector<CostRow>& rows);

// The rows of a scene that have a time in a column: "default", "literal" or "modelled".
[[nodiscard]] std::vector<CostPoint> points_of(const std::vector<CostRow>& rows, const std::string& scene,
                                               const std::string& column);

// Error over time on logarithmic axes, the frontier drawn and its points named. An error of 0 stands on the lowest
// line.
[[nodiscard]] std::string frontier_svg(const std::vector<CostPoint>& points, const std::string& title,
                                       const std::string& time_label);

}  // namespace strata::tools
