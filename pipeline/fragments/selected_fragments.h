// pipeline/fragments/selected_fragments.h - the fragments that a selection keeps of one pass, on their way to the program, and the counts of
// the others.
#pragma once
#include <cstdint>
#include <vector>

namespace strata::pipeline {

// The windows of columns: keys in [low, high).
struct WindowEnds {
    std::vector<std::uint64_t> low, high;  // no `high`: up to the end
};

// Several fragments of a pixel follow each other in the order of arrival, and a batch holds no pixel twice: so the
// first ones of all pixels go ahead, then all second ones.
struct SelectedFragments {
    struct One {
        std::uint32_t key, place, pixel;
    };
    std::vector<std::vector<One>> of_rank;      // pixels rise
    std::size_t ranks = 0, rank = 0, next = 0;  // in use; of the next batch, and its first fragment there
    WindowEnds windows;                         // of the occupied pixels
    bool is_routed = false;                     // of Keeps::arrivals: sample s takes what has rank s
    bool is_ready = false;                      // chosen for the present pass
    std::uint64_t inside = 0;                   // fragments in their pixel's window
    std::uint64_t passed = 0;                   // of these, the ones that pass the depth test, of Keeps::nearest
    std::uint64_t killed = 0;                   // of these, the ones that the stencil test of Keeps::previous kills

    void start() {
        for (auto& fragments : of_rank) fragments.clear();
        ranks = rank = next = 0;
        inside = passed = killed = 0;
        is_routed = false;
    }
    [[nodiscard]] std::uint64_t visited() const noexcept {
        std::uint64_t fragments = 0;
        for (const auto& of : of_rank) fragments += of.size();
        return fragments;
    }
    // A word of SortedFragments.
    [[gnu::always_inline]] inline void add(std::size_t pixel, std::uint64_t word, std::size_t at_rank) {
        if (at_rank >= ranks) {
            ranks = at_rank + 1;
            if (of_rank.size() < ranks) of_rank.resize(ranks);
        }
        of_rank[at_rank].push_back({static_cast<std::uint32_t>(word >> 32), static_cast<std::uint32_t>(word),
                                    static_cast<std::uint32_t>(pixel)});
    }
};

}  // namespace strata::pipeline
