#include "peeling/programs/tie_order.h"

#include <algorithm>

namespace strata::peeling {
namespace {

// Calls body(begin, end, group number) for every run of equal keys.
template <class Body>
std::size_t for_each_group(std::vector<KeyedFragment>& sorted, Body&& body) {
    std::size_t group = 0;
    for (auto begin = sorted.begin(); begin != sorted.end(); ++group) {
        const auto end = std::find_if(begin, sorted.end(), [&](const KeyedFragment& f) { return f.key != begin->key; });
        body(begin, end, group);
        begin = end;
    }
    return group;
}

}  // namespace

std::vector<KeyedFragment> in_policy_order(std::span<const KeyedFragment> fragments, TiePolicy policy) {
    std::vector<KeyedFragment> sorted(fragments.begin(), fragments.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const KeyedFragment& a, const KeyedFragment& b) { return a.key < b.key; });
    const auto same_key = [](const KeyedFragment& a, const KeyedFragment& b) { return a.key == b.key; };
    switch (policy) {
        case TiePolicy::none:
        case TiePolicy::first: break;
        case TiePolicy::last:
            for_each_group(sorted, [](auto begin, auto end, std::size_t) { std::reverse(begin, end); });
            break;
        case TiePolicy::unique:
        case TiePolicy::merged: sorted.erase(std::unique(sorted.begin(), sorted.end(), same_key), sorted.end()); break;
        case TiePolicy::first_then_last: {
            // Every peel takes one key from each end; a single key in the middle counts as near.
            const std::size_t groups = for_each_group(sorted, [](auto, auto, std::size_t) {});
            for_each_group(sorted, [&](auto begin, auto end, std::size_t group) {
                if (group >= (groups + 1) / 2) std::reverse(begin, end);
            });
            break;
        }
    }
    return sorted;
}

}  // namespace strata::peeling
