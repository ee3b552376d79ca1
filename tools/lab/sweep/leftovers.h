// tools/lab/sweep/leftovers.h - temporary files that a killed run has left.
//
// Rule     The holder of a shard's lock is the only one that writes the shard's files, so temporaries of these names
//          are a dead run's: results and timings in the folder, and in images/ the files that begin with a cell's
//          number.
// Tests    tests/tools/sweep_lock_test.cpp
#pragma once
#include <string>

#include "tools/lab/sweep/shard.h"

namespace strata::tools {

void remove_leftovers(const std::string& folder, const Shard& shard);

}  // namespace strata::tools
