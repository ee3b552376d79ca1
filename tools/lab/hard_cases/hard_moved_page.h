// tools/lab/hard_cases/hard_moved_page.h - reports stability and flicker of a case as tables and a sentence.
//
// Rule     The tables are of depth_units, which every device runs: changes of all moves by one unit in the last place,
//          and flips along the path. The sentence compares the devices that change or flip least and most, at one depth
//          format, and states the rule in which the two differ: steps of planes, grid, depth path. All its numbers are
//          those of the two rows.
// Tests    tests/tools/hard_cases/hard_page_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/hard_cases/hard_sweep.h"

namespace strata::tools {

// For the lines of one case; empty if none has movements.
[[nodiscard]] std::string moved_tables(const HardSweep& sweep, const std::vector<const nlohmann::ordered_json*>& lines);

// One row per case: changes, flips and verdicts of all algorithms and formats, by device.
[[nodiscard]] std::string moved_overview(const HardSweep& sweep, const Lines& lines);

}  // namespace strata::tools
