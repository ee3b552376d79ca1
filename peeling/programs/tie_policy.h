// peeling/programs/tie_policy.h - which fragments of equal key are composited, and in which order. keys-and-counts.md 2.2.
// Tests: tests/peeling/audit/audit_test.cpp
#pragma once
#include <algorithm>
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

// A pixel's fragments in an order: each as its depth, above, and its place in submission order, below. Ascending numbers are
// nearest first, and the first arrival first.
using FragmentOrder = std::vector<std::uint64_t>;
[[nodiscard]] constexpr std::uint32_t place_of(std::uint64_t entry) noexcept {
    return static_cast<std::uint32_t>(entry);
}
[[nodiscard]] constexpr std::uint32_t depth_of(std::uint64_t entry) noexcept {
    return static_cast<std::uint32_t>(entry >> 32);
}

// Fills `order` with all of a pixel's fragments, given in submission order, by the depth that `code` names.
inline void sort_by(std::uint32_t KeyedFragment::*code, std::span<const KeyedFragment> fragments,
                    FragmentOrder& order) {
    order.clear();
    for (std::size_t i = 0; i < fragments.size(); ++i)
        order.push_back(std::uint64_t{fragments[i].*code} << 32 | static_cast<std::uint32_t>(i));
    std::sort(order.begin(), order.end());
}

// The same for a depth by which `near_order` is almost in order already: a few steps a fragment, or a sort from scratch.
void sort_almost(std::uint32_t KeyedFragment::*code, std::span<const KeyedFragment> fragments,
                 const FragmentOrder& near_order, FragmentOrder& order);

// Turns the order by key into that in which `policy` composites, nearest first; `unique` and `merged` keep one fragment a key.
void apply(TiePolicy policy, FragmentOrder& by_key);

}  // namespace strata::peeling
