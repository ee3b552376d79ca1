// peeling/programs/tie_order.cpp - sorts by depth and regroups fragments of equal key by tie policy (tie_order.h).
#include "peeling/programs/tie_order.h"

#include <algorithm>
#include <utility>

namespace strata::peeling {

namespace {

// Calls body(begin, end, group number) for every group of equal keys.
template <class Body>
std::size_t for_each_group(FragmentOrder& sorted, Body&& body) {
    std::size_t group = 0;
    for (auto begin = sorted.begin(); begin != sorted.end(); ++group) {
        const std::uint32_t key = depth_of(*begin);
        const auto end = std::find_if(begin, sorted.end(), [key](std::uint64_t e) { return depth_of(e) != key; });
        body(begin, end, group);
        begin = end;
    }
    return group;
}

}  // namespace

// Entries are (depth, submission index), so an insertion sort puts equal depths in submission order, as a stable sort
// would.
void sort_almost(std::uint32_t KeyedFragment::*code, std::span<const KeyedFragment> fragments,
                 const FragmentOrder& near_order, FragmentOrder& order) {
    order.clear();
    std::size_t steps = 8 * near_order.size();
    for (const std::uint64_t near : near_order) {
        const std::uint64_t entry =
            std::uint64_t{fragments[submission_index(near)].*code} << 32 | submission_index(near);
        order.push_back(entry);
        for (std::size_t i = order.size() - 1; i > 0 && order[i - 1] > entry; --i) {
            if (steps-- == 0) return sort_by(code, fragments, order);
            order[i] = std::exchange(order[i - 1], entry);
        }
    }
}

// peeling/reference/keys-and-counts.md 2.2.
void apply(TiePolicy policy, FragmentOrder& by_key) {
    const auto same_key = [](std::uint64_t a, std::uint64_t b) { return depth_of(a) == depth_of(b); };
    switch (policy) {
        case TiePolicy::none:
        case TiePolicy::first: break;
        case TiePolicy::last:
            for_each_group(by_key, [](auto begin, auto end, std::size_t) { std::reverse(begin, end); });
            break;
        case TiePolicy::unique:
        case TiePolicy::merged: by_key.erase(std::unique(by_key.begin(), by_key.end(), same_key), by_key.end()); break;
        case TiePolicy::first_then_last: {
            // Every pass takes one key from each end; a single key in the middle counts as near.
            const std::size_t groups = for_each_group(by_key, [](auto, auto, std::size_t) {});
            for_each_group(by_key, [&](auto begin, auto end, std::size_t group) {
                if (group >= (groups + 1) / 2) std::reverse(begin, end);
            });
            break;
        }
    }
}

}  // namespace strata::peeling
