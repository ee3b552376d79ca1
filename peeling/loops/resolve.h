// peeling/loops/resolve.h - the results of peeling loops, computed at once from a tile's recorded fragments: dual
// peeling, and peeling front to back.
//
// Rule     The result equals that of the passes, ties included: the same codes, queries and trace. If it does not
//          apply, a resolve returns false without having counted anything, and the passes are executed.
// Source   peeling/reference/algorithms.md 0.7.
// Tests    tests/peeling/execution/execution_test.cpp, dense_meshes_test.cpp: comparison with literal execution
#pragma once
#include "pipeline/region/region.h"

namespace strata::peeling {

[[nodiscard]] bool dual_resolve(pipeline::Region& region);
[[nodiscard]] bool front_to_back_resolve(pipeline::Region& region);

}  // namespace strata::peeling
