// tools/lab/sweep/leftovers.h - removes temporary files of killed runs.
//
// Rule     Only the holder of a shard's lock writes the shard's files, so temporary files of these names belong to a
//          dead run: results and timings in the folder, and in images/ the files that begin with a cell's number.
// Tests    tests/tools/sweep_lock_test.cpp
#pragma once
#include <string>

#include "tools/lab/sweep/shard.h"

namespace strata::tools {

void remove_leftovers(const std::string& folder, const Shard& shard);

}  // namespace strata::tools
