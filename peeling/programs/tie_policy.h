// peeling/programs/tie_policy.h - which fragments of equal key are composited, and in which order. keys-and-counts.md 2.2.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "peeling/programs/fragment_lists.h"

namespace strata::peeling {

enum class TiePolicy : std::uint8_t {
    none,             // no order at all
    first,            // all, the first arrival in front
    last,             // all, the last arrival in front
    unique,           // the first arrival only
    merged,           // one layer a key, a component-wise mixture
    first_then_last,  // FIRST in the front half of the keys, LAST in the back half (dual_independent)
};

[[nodiscard]] std::string_view name(TiePolicy policy) noexcept;

// A pixel's visible fragments, given in submission order, in the order that `policy` composites them, nearest first; `unique`
// and `merged` keep one a key.
[[nodiscard]] std::vector<KeyedFragment> in_policy_order(std::span<const KeyedFragment> fragments, TiePolicy policy);

}  // namespace strata::peeling
