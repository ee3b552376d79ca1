// peeling/loops/dual_resolve.h - the loop of dual peeling, computed at once from a tile's record.
//
// Rule     It leaves what the passes would leave, ties included: the same codes, queries and trace. Where it does not
//          apply it returns false, has counted nothing, and the passes run.
// Source   algorithms.md 0.7.
// Tests    tests/peeling/execution_test.cpp, sequences_test.cpp: against literal execution
#pragma once
#include "pipeline/region/region.h"

namespace strata::peeling {

[[nodiscard]] bool dual_resolve(pipeline::Region& region);

}  // namespace strata::peeling
