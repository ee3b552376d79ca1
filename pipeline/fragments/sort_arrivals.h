// pipeline/fragments/sort_arrivals.h - words of (key, arrival) that stand in the order of arrival, sorted.
//
// Rule     Geometry comes as a run, from near to far or from far to near, and a few fragments behind it: of what is drawn last. A falling
//          run is turned round, and a short rest is merged into the run; only what is neither is sorted as if it were random.
// Numbers  Keys above, arrivals below, 32 bits each; no two words are equal.
// Tests    tests/pipeline/fragments/sort_arrivals_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace strata::pipeline {

enum class ColumnArrival : std::uint8_t { near_to_far, far_to_near, mixed };

// Merges the sorted words from number `run` on, few of them, into the sorted ones before.
inline void merge_rest(std::span<std::uint64_t> words, std::size_t run) noexcept {
    std::array<std::uint64_t, 32> rest;
    std::size_t left = words.size() - run, from = run;
    std::copy(words.begin() + static_cast<std::ptrdiff_t>(run), words.end(), rest.begin());
    while (left > 0) {
        const bool is_of_run = from > 0 && words[from - 1] > rest[left - 1];
        words[from + left - 1] = is_of_run ? words[from - 1] : rest[left - 1];
        from -= is_of_run ? 1 : 0;
        left -= is_of_run ? 0 : 1;
    }
}

// Returns how the words stood. Falling, equal keys would stand in reverse: such a run ends there.
inline ColumnArrival sort_arrivals(std::span<std::uint64_t> words) {
    constexpr std::size_t longest_rest = 32;
    const std::size_t size = words.size();
    const auto key = [&](std::size_t k) { return words[k] >> 32; };
    std::size_t run = std::min<std::size_t>(size, 1);
    const bool falls = size > 1 && key(1) < key(0);
    if (falls)
        while (run < size && key(run) < key(run - 1)) ++run;
    else
        while (run < size && words[run - 1] < words[run]) ++run;
    if (run < size && (size - run > longest_rest || size - run > run)) {
        std::ranges::sort(words);
        return ColumnArrival::mixed;
    }
    if (falls) std::ranges::reverse(words.first(run));
    if (run == size) return falls ? ColumnArrival::far_to_near : ColumnArrival::near_to_far;
    std::ranges::sort(words.subspan(run));
    merge_rest(words, run);
    return ColumnArrival::mixed;
}

}  // namespace strata::pipeline
