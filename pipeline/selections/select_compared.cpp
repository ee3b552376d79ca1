// pipeline/selections/select_compared.cpp - which fragments peels visit that compare another depth than a key: not rounded, within an
// epsilon, or another path's (execution.md 7.1).
#include <algorithm>
#include <array>
#include <bit>

#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/selections/key_windows.h"

namespace strata::pipeline {

namespace {

// What ends the parts of a column between `near` and `far`: numbers [first, near_end) are those of the near end, [far_begin, last) those
// of the far one.
struct Parts {
    std::uint32_t first = 0, near_end = 0, far_begin = 0, last = 0;
};

Parts parts_of(SortedFragments& sorted, std::size_t column, const DepthCompare& compare, double near, double far) {
    if (!(near <= far)) return {};
    const std::array found{sorted.first_compared(column, 0, [&](double own) { return !compare.exceeds(near, own); }),
                           sorted.first_compared(column, 1, [&](double own) { return compare.exceeds(own, near); }),
                           sorted.first_compared(column, 2, [&](double own) { return !compare.exceeds(far, own); }),
                           sorted.first_compared(column, 3, [&](double own) { return compare.exceeds(own, far); })};
    const std::uint32_t last = std::max(found[0], found[3]), near_end = std::clamp(found[1], found[0], last);
    return {found[0], near_end, std::clamp(found[2], near_end, last), last};
}

}  // namespace

// The window bounds the depth that is compared, and the test looks at the one that is stored.
void Region::select_nearest_compared(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const DepthCompare compare = sorted.compare();
    const std::uint32_t* const peeled = state.selection.behind.exists() ? codes_of(state.selection.behind) : nullptr;
    const StoredDepth stored = stored_depth(state);
    std::uint32_t* const depth = depth_of_kept(state);
    std::uint32_t* const same_up_to = may_repeat(state) ? scratch_->repeated.behind_most.data() : nullptr;
    constexpr double before_all = -1.0;
    selected.open(0);
    SelectedFragments::Filling kept = selected.of_rank[0].filling();
    std::size_t number = 0;
    for (const std::uint32_t p : sorted.occupied()) {
        const double bound = peeled == nullptr ? before_all : compare.bound(peeled[p]);
        const SortedFragments::Passing found = sorted.passing_behind(number++, bound, stored.of(p));
        if (same_up_to != nullptr) same_up_to[p] = found.inside > 0 ? peeled[p] : ~0u;
        kept.add_if(found.passed > 0, p, found.word);
    }
    selected.of_rank[0].count = kept.count;
    for (std::size_t k = 0; depth != nullptr && k < kept.count; ++k) depth[kept.pixel[k]] = kept.key[k];
}

// All of either end, in the order of arrival, and between them the least and the greatest key.
void Region::select_ends_compared(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const Texels range = at(state.selection.range).texels(0);
    const std::uint32_t *const near = range.plane(0).words, *const far = range.plane(1).words;
    std::vector<std::uint64_t> kept;
    for (std::size_t column = 0; column < sorted.occupied().size(); ++column) {
        const std::uint32_t p = sorted.occupied()[column];
        const auto words = sorted.column(column);
        const auto [first, near_end, far_begin, last] =
            parts_of(sorted, column, *state.selection.compared, double{-std::bit_cast<float>(near[p])},
                     double{std::bit_cast<float>(far[p])});
        kept.assign(words.begin() + first, words.begin() + near_end);
        kept.insert(kept.end(), words.begin() + far_begin, words.begin() + last);
        if (near_end < far_begin) {
            const auto [least, greatest] = sorted.extremes(column, near_end, far_begin);
            kept.push_back(least);
            if (least != greatest) kept.push_back(greatest);
        }
        // Only where all of the window is its near end does the value of those outside come from outside.
        if (state.selection.outside == Outside::one_value && near_end == last && last - first < words.size())
            kept.push_back(words[first > 0 ? 0 : last]);
        std::ranges::sort(kept, {}, [](std::uint64_t word) { return static_cast<std::uint32_t>(word); });
        for (std::size_t rank = 0; rank < kept.size(); ++rank) selected.add(p, kept[rank], rank);
    }
}

}  // namespace strata::pipeline
