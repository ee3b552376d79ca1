// tools/lab/cost/cost_table.h - ranks the rows of `strata cost` in one table, best first.
//
// Rule     Rows are ordered by RMSE from the sorted picture, then by RMSE from the exact picture, then by time. The
//          first error is the choice's own; the second also has what the device rounds. Rows of the chain have no
//          sorted picture and no time; they and refused rows stand last, in the order of the plan.
// Tests    tests/tools/lab/cost/cost_table_test.cpp
#pragma once
#include <string>

#include "tools/lab/sweep/sweep.h"
#include "tools/strata/table.h"

namespace strata::tools {

// `timings[i]` is the timing of `lines[i]`.
[[nodiscard]] Table ranked_table(const Lines& lines, const Lines& timings);

// Three lines for each scene: the exact algorithm and the approximate one that rank first, and the quickest row.
[[nodiscard]] std::string best_rows(const Lines& lines, const Lines& timings);

}  // namespace strata::tools
