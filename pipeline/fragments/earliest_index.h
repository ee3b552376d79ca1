// pipeline/fragments/earliest_index.h - which fragment of a piece of sorted columns arrived first: blocks of sixteen words with their least
// place, blocks of sixteen such blocks, and so on.
//
// Rule     Words are SortedFragments', in one piece for all columns; a column is a range of their numbers. Blocks may span columns:
//          only those that lie within a range are asked for its least place.
// Numbers  1/15 of a word's 4 bytes beside each word. No place is ~0.
// Tests    tests/pipeline/fragments/sorted_fragments_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace strata::pipeline {

class EarliestIndex {
  public:
    [[nodiscard]] bool is_built() const noexcept { return words_.data() != nullptr; }
    void forget() noexcept { words_ = {}; }
    void build(std::span<const std::uint64_t> words) {
        words_ = words;
        levels_.clear();
        for (std::size_t size = words.size(); size > fan_out; size = levels_.back().size()) {
            std::vector<std::uint32_t> blocks((size + fan_out - 1) / fan_out, ~0u);
            const std::size_t below = levels_.size();
            for (std::size_t k = 0; k < size; ++k) blocks[k / fan_out] = std::min(blocks[k / fan_out], least(below, k));
            levels_.push_back(std::move(blocks));
        }
    }

    // The least place of [first, last); ~0 if it is empty.
    [[nodiscard]] std::uint32_t earliest(std::size_t first, std::size_t last) const noexcept {
        std::uint32_t place = ~0u;
        for (std::size_t level = 0; first < last; ++level, first /= fan_out, last /= fan_out) {
            const bool is_short = last - first <= 2 * fan_out || level == levels_.size();
            while (first < last && (is_short || first % fan_out != 0)) place = std::min(place, least(level, first++));
            while (first < last && last % fan_out != 0) place = std::min(place, least(level, --last));
        }
        return place;
    }
    // The first of [first, last) whose place is below `place`; `last` if there is none.
    [[nodiscard]] std::size_t first_before(std::size_t first, std::size_t last, std::uint32_t place) const noexcept {
        std::size_t level = 0, at = first;
        for (std::size_t begin = first; begin < last; begin = at << (shift * level)) {
            if (least(level, at) < place) {
                if (level == 0) return at;
                --level, at *= fan_out;
                continue;
            }
            ++at;
            while (at % fan_out == 0 && level < levels_.size()) ++level, at /= fan_out;
        }
        return last;
    }

  private:
    static constexpr std::size_t fan_out = 16, shift = 4;

    [[nodiscard]] std::uint32_t least(std::size_t level, std::size_t at) const noexcept {
        return level == 0 ? static_cast<std::uint32_t>(words_[at]) : levels_[level - 1][at];
    }

    std::span<const std::uint64_t> words_;
    std::vector<std::vector<std::uint32_t>> levels_;
};

}  // namespace strata::pipeline
