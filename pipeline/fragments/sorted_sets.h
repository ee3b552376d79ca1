// pipeline/fragments/sorted_sets.h - the two sortings of a store that passes in turn ask for: of two parts of a list, or by two keys.
#pragma once
#include <algorithm>
#include <array>

#include "pipeline/fragments/ends_course.h"
#include "pipeline/fragments/layer_lists.h"
#include "pipeline/fragments/sorted_fragments.h"

namespace strata::pipeline {

class SortedSets {
  public:
    // The one that the present pass visits.
    [[nodiscard]] SortedFragments& present() noexcept { return sets_[present_].fragments; }
    [[nodiscard]] const SortedFragments& present() const noexcept { return sets_[present_].fragments; }
    // Its fragments by layers.
    [[nodiscard]] LayerLists& layers() noexcept { return sets_[present_].layers; }
    [[nodiscard]] EndsCourse& ends_course() noexcept { return sets_[present_].ends_course; }
    void forget() noexcept {
        for (Set& set : sets_) set.fragments.forget();
    }
    // Makes a set that serves the present one; false if none does.
    [[nodiscard]] bool find(const SortRequest& request) noexcept {
        for (std::size_t s = 0; s < sets_.size(); ++s)
            if (sets_[s].fragments.serves(request)) {
                present_ = s;
                return true;
            }
        return false;
    }
    // True if this request may still be sorted, in the set that was not present last. It becomes the present one.
    [[nodiscard]] bool may_sort(const SortRequest& request) noexcept {
        if (!std::ranges::all_of(sets_, [&](const Set& set) { return set.fragments.may_sort(request); })) return false;
        if (sets_[present_].bytes() > 0) present_ = 1 - present_;
        layers().forget();
        ends_course().forget();
        return true;
    }
    // Memory that the other set takes.
    [[nodiscard]] std::uint64_t bytes_of_other() const noexcept { return sets_[1 - present_].bytes(); }

  private:
    struct Set {
        SortedFragments fragments;
        LayerLists layers;  // of these fragments
        EndsCourse ends_course;
        [[nodiscard]] std::uint64_t bytes() const noexcept {
            return fragments.bytes() == 0 ? 0 : fragments.bytes() + layers.bytes();
        }
    };
    std::array<Set, 2> sets_;
    std::size_t present_ = 0;
};

}  // namespace strata::pipeline
