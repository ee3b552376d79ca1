// pipeline/selections/select_runs.cpp - which fragments passes visit that ask for the order of arrival: runs that arrive in the order of
// depth, what ends them and what lies behind; and arrivals by their number, which a stencil counts (execution.md 7.1).
#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/selections/key_windows.h"

namespace strata::pipeline {

namespace {

constexpr std::uint32_t full_stencil = 255;
constexpr std::uint32_t none = ~0u;

// The fragments [first, last) of a column in the order of arrival, up to the first that is no farther than one before it.
class RunWalk {
  public:
    RunWalk(SortedFragments& sorted, std::size_t pixel, std::uint32_t first, std::uint32_t last)
        : sorted_{sorted},
          column_{sorted.begin(pixel)},
          in_order_{sorted.is_in_order(pixel)},
          next_{first},
          last_{last} {}

    // The number of the next one in its column, `none` behind the last.
    [[nodiscard]] std::uint32_t next() {
        if (is_broken_ || (next_ >= last_ && skipped_ == none)) return none;
        if (in_order_) return next_++;
        const EarliestIndex& index = sorted_.earliest();
        const std::size_t from = column_ + next_, end = column_ + last_;
        const std::uint32_t behind = index.earliest(from, end);
        is_broken_ = skipped_ < behind;
        if (is_broken_) return number_of(index.first_before(column_ + first_skipped_, from, skipped_ + 1));
        const std::size_t at = index.first_before(from, end, behind + 1);
        if (at > from) {
            if (first_skipped_ == none) first_skipped_ = next_;
            skipped_ = std::min(skipped_, index.earliest(from, at));
        }
        next_ = number_of(at) + 1;
        return next_ - 1;
    }
    // Of the fragments that `next` has not returned, or as what breaks the run, the nearest; `none` if there is no such.
    [[nodiscard]] std::uint32_t nearest_left() const noexcept {
        return first_skipped_ != none ? first_skipped_ : next_ < last_ ? next_ : none;
    }
    // Whether what `next` returned last is not farther than one before it.
    [[nodiscard]] bool is_broken() const noexcept { return is_broken_; }

  private:
    [[nodiscard]] std::uint32_t number_of(std::size_t word) const noexcept {
        return static_cast<std::uint32_t>(word - column_);
    }

    SortedFragments& sorted_;
    std::size_t column_;
    bool in_order_, is_broken_ = false;
    std::uint32_t next_, last_;
    std::uint32_t first_skipped_ = none;  // nearer than what has been returned last, and not returned
    std::uint32_t skipped_ = none;        // the least place of those
};

// Whether a depth test GREATER passes.
bool is_greater(std::uint32_t code, std::uint32_t stored, bool is_float) noexcept {
    return is_float ? std::bit_cast<float>(code) > std::bit_cast<float>(stored) : code > stored;
}

}  // namespace

// The stencil counts to 128, and is inverted by the first that the test fails: either ends the pass at this pixel.
void Region::select_run(const PassState& state) {
    constexpr std::uint32_t ended = 128;
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const KeyWindow window =
        window_of(state.selection, frame_, [&](Target t) -> const TargetStorage& { return storage(t); });
    const std::uint32_t* const counts = storage(state.stencil_target).stencil(0);
    const std::uint32_t* const depths = storage(state.depth_target).depth(0);
    const bool is_float = storage(state.depth_target).format() == Format::d32f;
    for_each_column(sorted, window, nullptr, selected.windows, [&](const WindowColumn& column) {
        const auto& [number, p, words, first, end, tested, low] = column;
        std::uint32_t count = counts[p], depth = depths[p];
        RunWalk walk{sorted, p, first, end};
        for (std::size_t rank = 0; count < ended; ++rank) {
            const std::uint32_t at = walk.next();
            if (at == none) break;
            selected.add(p, words[at], rank);
            const auto code = static_cast<std::uint32_t>(words[at] >> 32);
            count = is_greater(code, depth, is_float) ? count + 1 : ended;
            depth = code;
        }
    });
}

namespace {

// The numbers, rising, of a window's first arrivals. A run holds them in order of depth; else they are looked for one by one.
void take_first_arrivals(SortedFragments& sorted, std::size_t pixel, std::uint32_t first, std::uint32_t last,
                         std::size_t arrivals, std::vector<std::uint32_t>& taken) {
    taken.clear();
    RunWalk walk{sorted, pixel, first, last};
    while (taken.size() < arrivals && !walk.is_broken()) taken.push_back(walk.next());
    if (!walk.is_broken()) return;
    const auto words = sorted.of(pixel);
    taken.resize(last - first);
    std::iota(taken.begin(), taken.end(), first);
    const auto place = [&](std::uint32_t k) { return static_cast<std::uint32_t>(words[k]); };
    std::ranges::nth_element(taken, taken.begin() + static_cast<std::ptrdiff_t>(arrivals), {}, place);
    taken.resize(arrivals);
    std::ranges::sort(taken);
}

// The first number from `first` on that `taken`, rising, does not hold.
std::uint32_t first_without(std::span<const std::uint32_t> taken, std::uint32_t first) noexcept {
    for (const std::uint32_t number : taken) first += number == first ? 1 : 0;
    return first;
}

}  // namespace

// The first arrivals fill the stencil up, and die of it. Of the others the nearest stays, and is visited when it is full.
void Region::select_nearest_after(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const KeyWindow window =
        window_of(state.selection, frame_, [&](Target t) -> const TargetStorage& { return storage(t); });
    const StoredDepth stored{codes_of(state.depth_target), storage(state.depth_target).format() == Format::d32f};
    std::uint32_t* const counts = at(state.stencil_target).stencil_plane(0).words;
    std::vector<std::uint32_t> dead;
    for_each_column(sorted, window, &stored, selected.windows, [&](const WindowColumn& column) {
        const auto& [number, p, words, first, end, tested, low] = column;
        const std::uint32_t dying = std::min(full_stencil - counts[p], end - first);
        counts[p] += dying;
        if (dying == end - first) return;
        take_first_arrivals(sorted, p, first, end, dying, dead);
        const std::uint32_t nearest = first_without(dead, first);
        if (nearest >= tested) return;
        selected.add(p, words[nearest], 0);
    });
}

namespace {

// Of a window that begins with its first arrival: the last fragment of its run, what breaks it, and the nearest of what is left.
void take_end_of_run(SortedFragments& sorted, std::size_t pixel, std::uint32_t first, std::uint32_t last,
                     std::vector<std::uint64_t>& kept) {
    RunWalk walk{sorted, pixel, first, last};
    std::uint32_t end = first, at = walk.next();
    while (at != none && !walk.is_broken()) end = std::exchange(at, walk.next());
    const auto words = sorted.of(pixel);
    if (end != first) kept.push_back(words[end]);
    if (at == none) return;
    kept.push_back(words[at]);
    if (walk.nearest_left() != at) kept.push_back(words[walk.nearest_left()]);
}

}  // namespace

// Registers depend on the last two updates, and behind them, in the window between the two, on the run's last fragment, on what
// breaks the run and on the nearest that arrives later. All that lie at the bound are composited.
void Region::select_last_run(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const KeyWindow window =
        window_of(state.selection, frame_, [&](Target t) -> const TargetStorage& { return storage(t); });
    std::vector<std::uint64_t> kept;
    for_each_column(sorted, window, nullptr, selected.windows, [&](const WindowColumn& column) {
        const auto& [number, p, words, first, end, tested, low] = column;
        kept.clear();
        for (std::uint32_t k = first; k-- > 0 && words[k] >> 32 == low - 1;) kept.push_back(words[k]);
        if (const std::uint32_t updates = sorted.passing(p, first, end); updates > 0) {
            const std::uint32_t previous = updates > 1 ? sorted.update(p, first, end, updates - 1) : end;
            if (updates > 1) kept.push_back(words[previous]);
            kept.push_back(words[first]);
            take_end_of_run(sorted, p, first, previous, kept);
        }
        std::ranges::sort(kept, {}, [](std::uint64_t word) { return static_cast<std::uint32_t>(word); });
        for (std::size_t rank = 0; rank < kept.size(); ++rank) selected.add(p, kept[rank], rank);
    });
}

// Decrements every sample's stencil by a number of fragments of its pixel, down to 0.
template <class FragmentsAt>
void Region::count_down(const PassState& state, const FragmentsAt& fragments_at) {
    TargetStorage& stencil = at(state.stencil_target);
    for (const std::uint32_t p : scratch_->sorted.present().occupied()) {
        const auto fragments = static_cast<std::uint32_t>(fragments_at(p));
        for (int sample = 0; fragments > 0 && sample < pass_samples_; ++sample) {
            std::uint32_t& stored = stencil.stencil_plane(sample).words[p];
            stored -= std::min(stored, fragments);
        }
    }
}

// Those before have counted the stencil down by the time that the kept ones come, and met no sample's test. Where sample s
// waits for kept arrival s, that one goes through its sample alone: it fails the tests of the others.
void Region::select_arrivals(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const std::size_t past = state.selection.first_arrival;
    for (const std::uint32_t p : sorted.occupied()) {
        const auto words = sorted.of(p);
        const std::size_t last = std::min(words.size(), past + samples_of_pass());
        for (std::size_t k = past; k < last; ++k) selected.add(p, words[k], k - past);
    }
    selected.is_routed = waits_in_order(state);
    if (!selected.is_routed)
        return count_down(state, [&](std::size_t p) { return std::min(sorted.of(p).size(), past); });
    for (std::size_t rank = 0; rank < selected.ranks; ++rank) {
        std::uint32_t* const stored = at(state.stencil_target).stencil_plane(static_cast<int>(rank)).words;
        const SelectedFragments::Rank& kept = selected.of_rank[rank];
        for (std::size_t k = 0; k < kept.count; ++k) stored[kept.pixel[k]] = state.stencil.front.ref;
    }
}

// Whether sample s of every pixel with fragments takes arrival number first_arrival + s.
bool Region::waits_in_order(const PassState& state) {
    const SortedFragments& sorted = scratch_->sorted.present();
    for (std::size_t s = 0; s < samples_of_pass(); ++s) {
        const std::uint32_t* const stored = at(state.stencil_target).stencil_plane(static_cast<int>(s)).words;
        const std::size_t expected = state.stencil.front.ref + state.selection.first_arrival + s;
        if (!std::ranges::all_of(sorted.occupied(), [&](std::uint32_t p) { return stored[p] == expected; }))
            return false;
    }
    return true;
}

// What all of a pixel's fragments leave of stencils that waited in order.
void Region::finish_waiting(const PassState& state) {
    const SortedFragments& sorted = scratch_->sorted.present();
    for (std::size_t s = 0; s < samples_of_pass(); ++s) {
        std::uint32_t* const stored = at(state.stencil_target).stencil_plane(static_cast<int>(s)).words;
        const std::size_t before = state.stencil.front.ref + state.selection.first_arrival + s;
        for (const std::uint32_t p : sorted.occupied())
            stored[p] = static_cast<std::uint32_t>(before - std::min(before, sorted.of(p).size()));
    }
}

// What the other arrivals leave of the stencil; and what has passed without a visit.
void Region::finish_selected(const PassState& state, Drawn& drawn) {
    remember(state);
    drawn.passed.own_ += scratch_->selected.done;
    if (state.selection.outside == Outside::nothing_new || state.selection.outside == Outside::one_value)
        drawn.passed.own_ = scratch_->sorted.present().size();  // what lies outside passes, too
    if (state.selection.keeps != Keeps::arrivals) return;
    if (scratch_->selected.is_routed) return finish_waiting(state);
    const SortedFragments& sorted = scratch_->sorted.present();
    count_down(state, [&](std::size_t p) {
        const std::size_t done = state.selection.first_arrival + samples_of_pass();
        return sorted.of(p).size() - std::min(sorted.of(p).size(), done);
    });
}

}  // namespace strata::pipeline
