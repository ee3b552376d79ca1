// peeling/programs/tie_order.h - a pixel's fragments in the order in which a tie policy composites them. algorithms.md 0.
#pragma once
#include <span>
#include <vector>

#include "peeling/programs/fragment_lists.h"
#include "peeling/programs/tie_policy.h"

namespace strata::peeling {

// A pixel's visible fragments, given in submission order, in the order that `policy` composites them, nearest first; `unique`
// and `merged` keep one a key.
[[nodiscard]] std::vector<KeyedFragment> in_policy_order(std::span<const KeyedFragment> fragments, TiePolicy policy);

}  // namespace strata::peeling
