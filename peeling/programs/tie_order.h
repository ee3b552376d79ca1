// peeling/programs/tie_order.h - sorts a pixel's fragments into the order in which a tie policy composites them.
// peeling/reference/keys-and-counts.md 2.2. Tests: tests/peeling/audit/audit_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "peeling/programs/fragment_lists.h"
#include "peeling/programs/tie_policy.h"

namespace strata::peeling {

// A pixel's fragments in an order: each entry is its depth in the high half and its submission index in the low half.
// Ascending entries are nearest first, and the first submitted first.
using FragmentOrder = std::vector<std::uint64_t>;
[[nodiscard]] constexpr std::uint32_t submission_index(std::uint64_t entry) noexcept {
    return static_cast<std::uint32_t>(entry);
}
[[nodiscard]] constexpr std::uint32_t depth_of(std::uint64_t entry) noexcept {
    return static_cast<std::uint32_t>(entry >> 32);
}

// Fills `order` with all of a pixel's fragments, given in submission order, sorted by the depth member `code`.
inline void sort_by(std::uint32_t KeyedFragment::*code, std::span<const KeyedFragment> fragments,
                    FragmentOrder& order) {
    order.clear();
    for (std::size_t i = 0; i < fragments.size(); ++i)
        order.push_back(std::uint64_t{fragments[i].*code} << 32 | static_cast<std::uint32_t>(i));
    std::sort(order.begin(), order.end());
}

// As sort_by, for a depth by which `near_order` is almost sorted: an insertion sort that falls back to sort_by after
// more than 8 steps per fragment.
void sort_almost(std::uint32_t KeyedFragment::*code, std::span<const KeyedFragment> fragments,
                 const FragmentOrder& near_order, FragmentOrder& order);

// Converts the order by key into that of `policy`, nearest first; `unique` and `merged` keep one fragment per key.
void apply(TiePolicy policy, FragmentOrder& by_key);

}  // namespace strata::peeling
