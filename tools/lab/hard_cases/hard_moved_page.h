// tools/lab/hard_cases/hard_moved_page.h - what movements and a camera path did to a case, as tables and a sentence for
// people.
//
// Rule     The tables show depth_units, which every device runs: changes of all moves by one unit in the last place,
//          and flips along the path. The sentence sets the device that changes or flips least beside the one that does
//          so most, at one depth format, and names the rule in which the two differ: steps of planes, grid, depth path;
//          all its figures are those of the two rows.
// Tests    tests/tools/hard_cases/hard_page_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/lab/hard_cases/hard_sweep.h"

namespace strata::tools {

// Of the lines of one case; empty where none was moved.
[[nodiscard]] std::string moved_tables(const HardSweep& sweep, const std::vector<const nlohmann::ordered_json*>& lines);

// A row a case: changes, flips and verdicts of all algorithms and formats, by device.
[[nodiscard]] std::string moved_overview(const HardSweep& sweep, const Lines& lines);

}  // namespace strata::tools
