// tools/strata/invariance/invariance_sweep.h - runs the cells of a sweep in order, keeps what was measured before,
// merges shards.
//
// Rule     results.jsonl and results.csv depend on the plan alone: not on threads, shards, interruptions or time.
//          What a cell took stands in timings.jsonl and nowhere else.
// Tests    tests/tools/invariance_test.cpp
#pragma once
#include "tools/strata/invariance/invariance_cell.h"
#include "tools/strata/invariance/invariance_journal.h"

namespace strata::tools {

// Cells in the plan's order, the folder of their results, and which of them are run here.
struct Sweep {
    std::vector<Cell> cells;
    std::string folder;
    Shard shard;
    bool images = true;
};

// Measures what is missing of the shard's cells. The exit status: 0, or 2 if every cell of the sweep was refused.
[[nodiscard]] int run_sweep(const Sweep& sweep, CellRunner& runner);

// Puts the files of `shards` shards together: results.jsonl, results.csv, timings.jsonl. InputError where one is not
// whole.
[[nodiscard]] int merge_shards(const Sweep& sweep, CellRunner& runner, std::size_t shards);

// The cells, one a line, and how long they would take: the first cell of each scene, size and algorithm is measured
// now.
void dry_run(const Sweep& sweep, CellRunner& runner);

}  // namespace strata::tools
