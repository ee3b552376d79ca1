// pipeline/fragments/stored_updates.cpp - columns sorted by a compared depth whose test looks at another, the stored one: the nearest behind a
// bound, and how many pass on the way to it (execution.md 7.1).
//
// Rule     From number i of a column on, f passes LESS if no earlier arrival g at i or behind has a stored code up to f's. So f passes
//          for every i from one behind the last such g up to f's own number: an interval. Intervals are summed once a column.
// Tests    tests/pipeline/fragments/sorted_fragments_test.cpp
#include <algorithm>

#include "pipeline/fragments/sorted_fragments.h"

namespace strata::pipeline {

namespace {

// The greatest of the numbers put down so far at places up to a given one: a Fenwick tree of prefix maxima.
class PrefixMaximum {
  public:
    PrefixMaximum(std::vector<std::uint32_t>& nodes, std::size_t size) : nodes_{nodes}, size_{size} {
        nodes_.assign(size + 1, 0);
    }
    void put(std::size_t place, std::uint32_t number) noexcept {
        for (std::size_t n = place + 1; n <= size_; n += n & (~n + 1)) nodes_[n] = std::max(nodes_[n], number);
    }
    [[nodiscard]] std::uint32_t up_to(std::size_t place) const noexcept {
        std::uint32_t greatest = 0;
        for (std::size_t n = place + 1; n > 0; n &= n - 1) greatest = std::max(greatest, nodes_[n]);
        return greatest;
    }

  private:
    std::vector<std::uint32_t>& nodes_;
    std::size_t size_;
};

// The rule itself, quicker than what follows for columns of few.
constexpr std::uint32_t few = 8;
template <class Passed>
void count_few(std::span<const std::uint64_t> stored, std::uint32_t surface, const Passed& passed) noexcept {
    const auto blocks = [](std::uint64_t g, std::uint64_t f) {  // words of (code, place)
        return g < f && static_cast<std::uint32_t>(g) < static_cast<std::uint32_t>(f);
    };
    for (std::size_t k = 0; k < stored.size(); ++k) {
        if (stored[k] >> 32 >= surface) continue;
        std::size_t from = stored.size();
        while (from > 0 && !blocks(stored[from - 1], stored[k])) --from;
        for (; from <= k; ++from) ++passed(from);
    }
}

void sort_if_needed(std::vector<std::uint64_t>& words) {
    if (!std::ranges::is_sorted(words)) std::ranges::sort(words);
}

}  // namespace

// What passes is first where intervals begin and end, and then their sum.
void SortedFragments::count_stored_updates(std::size_t number, std::uint32_t surface) {
    const std::span<const std::uint64_t> words = column(number);
    const auto size = static_cast<std::uint32_t>(words.size());
    Stored* const of_column = stored_.data() + begin_[number];
    const auto passed = [of_column](std::size_t k) -> std::uint32_t& { return of_column[k].passed; };
    std::uint64_t least = ~std::uint64_t{0};
    for (std::uint32_t k = size; k-- > 0;) {
        of_column[k].least = least = std::min(least, words[k]);
        of_column[k].passed = 0;
    }
    surfaces_[number] = surface;
    if (size <= few) return count_few(words, surface, passed);
    by_code_.clear();
    by_place_.clear();
    for (std::uint32_t k = 0; k < size; ++k) {
        if (words[k] >> 32 >= surface) continue;
        by_code_.push_back(words[k]);
        by_place_.push_back(words[k] << 32 | k);
    }
    sort_if_needed(by_code_);
    sort_if_needed(by_place_);
    PrefixMaximum behind{reach_, by_code_.size()};  // one more than the number of a fragment that has arrived
    for (const std::uint64_t word : by_place_) {
        const auto k = static_cast<std::uint32_t>(word);
        // Fragments of f's own code that arrived before it have lower words, and are in the tree already.
        const auto rank = static_cast<std::size_t>(std::ranges::lower_bound(by_code_, words[k]) - by_code_.begin());
        const std::uint32_t from = behind.up_to(rank);
        behind.put(rank, k + 1);
        if (from > k) continue;
        ++passed(from);
        if (k + 1 < size) --passed(k + 1);
    }
    for (std::uint32_t k = 1; k < size; ++k) passed(k) += passed(k - 1);
}

}  // namespace strata::pipeline
