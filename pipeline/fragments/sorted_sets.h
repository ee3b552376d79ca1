// pipeline/fragments/sorted_sets.h - the two sortings of a store that passes in turn ask for: of two parts of a list, or by two keys.
#pragma once
#include <algorithm>
#include <array>

#include "pipeline/fragments/sorted_fragments.h"

namespace strata::pipeline {

class SortedSets {
  public:
    // The one that the present pass visits.
    [[nodiscard]] SortedFragments& present() noexcept { return sets_[present_]; }
    [[nodiscard]] const SortedFragments& present() const noexcept { return sets_[present_]; }
    void forget() noexcept {
        for (SortedFragments& set : sets_) set.forget();
    }
    // Makes a set that serves the present one; false if none does.
    [[nodiscard]] bool find(const SortRequest& request) noexcept {
        for (std::size_t s = 0; s < sets_.size(); ++s)
            if (sets_[s].serves(request)) {
                present_ = s;
                return true;
            }
        return false;
    }
    // True if this request may still be sorted, in the set that was not present last. It becomes the present one.
    [[nodiscard]] bool may_sort(const SortRequest& request) noexcept {
        if (!std::ranges::all_of(sets_, [&](const SortedFragments& set) { return set.may_sort(request); }))
            return false;
        if (sets_[present_].bytes() > 0) present_ = 1 - present_;
        return true;
    }
    // Memory that the other set takes.
    [[nodiscard]] std::uint64_t bytes_of_other() const noexcept { return sets_[1 - present_].bytes(); }

  private:
    std::array<SortedFragments, 2> sets_;
    std::size_t present_ = 0;
};

}  // namespace strata::pipeline
