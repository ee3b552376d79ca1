// pipeline/region/region_select.cpp - which fragments a pass with a selection visits: found in the sorted columns of a tile, pixel by pixel
// (execution.md 7.1).
#include <algorithm>
#include <bit>
#include <utility>

#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

namespace {

using Finger = SortedFragments::Finger;

constexpr std::size_t pixels_ahead = 12;  // whose words are asked for: about as many as memory answers at once
constexpr std::uint32_t greatest_stencil = 255;

// The codes of a depth target in the form of sorted keys.
class KeyBound {
  public:
    KeyBound(const std::uint32_t* codes, DepthKey key) : codes_{codes}, is_float_key_{key == DepthKey::shader_z} {}
    [[nodiscard]] bool exists() const noexcept { return codes_ != nullptr; }
    [[nodiscard]] std::uint64_t of(std::size_t pixel) const noexcept {
        return is_float_key_ ? rasterizer::ordered_code(std::bit_cast<float>(codes_[pixel])) : codes_[pixel];
    }

  private:
    const std::uint32_t* codes_;
    bool is_float_key_;
};

// The bounds of a selection's window at a pixel: keys in [low, high).
struct KeyWindow {
    std::uint64_t least, end;
    KeyBound behind, from, at, before, up_to;
    std::uint64_t behind_codes, greatest;

    [[nodiscard]] std::uint64_t low(std::size_t p) const noexcept {
        std::uint64_t key = least;
        if (behind.exists()) key = std::max(key, std::min(behind.of(p) + behind_codes, greatest) + 1);
        if (from.exists()) key = std::max(key, from.of(p));
        if (at.exists()) key = std::max(key, at.of(p));
        return key;
    }
    [[nodiscard]] bool has_high() const noexcept { return end <= 0xffffffff || before.exists() || up_to.exists(); }
    [[nodiscard]] std::uint64_t high(std::size_t p) const noexcept {
        std::uint64_t key = end;
        if (before.exists()) key = std::min(key, before.of(p));
        if (up_to.exists()) key = std::min(key, up_to.of(p) + 1);
        return key;
    }
};

// The words of a window by place; in `own` if they stand in another order.
std::span<const std::uint64_t> in_order_of_arrival(std::span<const std::uint64_t> words,
                                                   std::vector<std::uint64_t>& own) {
    const auto place = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    if (std::ranges::is_sorted(words, {}, place)) return words;
    own.assign(words.begin(), words.end());
    std::ranges::sort(own, {}, place);
    return own;
}

// The codes that a depth test LESS compares with, in the order of keys: a binary32 that is negative or NaN lies before every
// stored code, or before none.
class StoredDepth {
  public:
    explicit StoredDepth(const TargetStorage& depth)
        : codes_{depth.depth(0)}, is_float_{depth.format() == Format::d32f} {}
    [[nodiscard]] std::uint32_t of(std::size_t pixel) const noexcept {
        return is_float_ && codes_[pixel] > 0x7f800000u ? 0 : codes_[pixel];
    }

  private:
    const std::uint32_t* codes_;
    bool is_float_;
};

// Calls visit(pixel, its words, the number of its window's first) wherever there is a fragment.
template <class Visit>
void for_each_column(SortedFragments& sorted, const KeyWindow& window, Visit&& visit) {
    for (std::size_t p = 0; p < sorted.pixels(); ++p) {
        sorted.prefetch(p + pixels_ahead, Finger::low);
        const auto words = sorted.of(p);
        if (words.empty()) continue;
        const std::uint64_t low = window.low(p);
        visit(p, words, low > 0 ? sorted.below(p, low, Finger::low) : 0);
    }
}

// How many of a column's fragments [first, last) arrived after `word`.
std::uint32_t arrived_after(std::span<const std::uint64_t> words, std::uint64_t word) {
    std::uint32_t later = 0;
    for (const std::uint64_t other : words)
        later += static_cast<std::uint32_t>(other) > static_cast<std::uint32_t>(word) ? 1u : 0u;
    return later;
}

}  // namespace

void Region::select(const PassState& state) {
    if (std::exchange(scratch_->selected.is_ready, false)) return;
    scratch_->selected.start();
    switch (state.selection.keeps) {
        case Keeps::nearest:
        case Keeps::last_two:
        case Keeps::previous:
            return scratch_->sorted.present().is_by_reference() ? select_nearest_stored(state) : select_nearest(state);
        case Keeps::window: return select_window(state);
        case Keeps::arrivals: return select_arrivals(state);
        case Keeps::ends: return select_ends(state);
        case Keeps::everything: return;
    }
}

namespace {

template <class CodesOf>
KeyWindow window_of(const FragmentSelection& s, const Frame& frame, const CodesOf& codes_of) {
    const auto bound = [&](Target t) { return KeyBound{codes_of(t), frame.key}; };
    // Codes that are raised are stored ones, and stop at the greatest; binary32 keys are not raised.
    const std::uint64_t greatest =
        frame.key == DepthKey::shader_z ? ~0u : rasterizer::max_code(frame.key_request().format);
    return {s.least,     std::uint64_t{s.most} + 1, bound(s.behind), bound(s.from),
            bound(s.at), bound(s.before),           bound(s.up_to),  s.behind_codes,
            greatest};
}

}  // namespace

// Updates of a pixel form a chain (SortedFragments::passing), whose last is the nearest. Where a stencil counts them,
// the visited one counts itself.
void Region::select_nearest(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const KeyWindow window = window_of(state.selection, frame_, [&](Target t) { return codes_of(t); });
    const StoredDepth stored{at(state.depth_target)};
    for_each_column(sorted, window, [&](std::size_t p, std::span<const std::uint64_t> words, std::uint32_t first) {
        std::uint32_t end = static_cast<std::uint32_t>(words.size());
        if (window.has_high()) end = std::max(first, sorted.below(p, window.high(p), Finger::high));
        const std::uint32_t last = std::min(end, sorted.below(p, stored.of(p), Finger::surface));
        selected.inside += end - first;
        const std::uint32_t updates = sorted.passing(p, first, last);
        if (state.selection.keeps == Keeps::previous) {
            select_previous(state, p, {first, last, end}, updates);
            return;
        }
        if (updates == 0) return;
        selected.passed += updates;
        if (state.stencil.enabled) count_up(state, p, updates - 1);
        const bool has_two = state.selection.keeps == Keeps::last_two && updates > 1;
        if (has_two) selected.add(p, words[sorted.update(p, first, last, updates - 1)], 0);
        selected.add(p, words[first], has_two ? 1 : 0);
    });
}

// Increments a pixel's stencil up to 255, and reports the first increment that it does not take.
void Region::count_up(const PassState& state, std::size_t pixel, std::uint32_t by) {
    std::uint32_t& stored = at(state.stencil_target).stencil_plane(0).words[pixel];
    if (stored + by > greatest_stencil) report_saturation(static_cast<std::uint32_t>(pixel));
    stored = std::min(stored + by, greatest_stencil);
}

// Every update but the last decrements the stencil, which is 1 then and kills whatever comes. Of more than 255 updates the
// stencil has missed some, and ends as many early.
void Region::select_previous(const PassState& state, std::size_t pixel, const ColumnPart& part, std::uint32_t updates) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const std::uint32_t made = std::max(std::min(updates, greatest_stencil), 1u) - 1;
    if (made == 0) {
        selected.killed += part.end - part.first;
        return;
    }
    const auto words = sorted.of(pixel);
    const std::uint64_t word = words[sorted.update(pixel, part.first, part.last, made)];
    selected.killed += arrived_after(words.subspan(part.first, part.end - part.first), word);
    selected.passed += made;
    at(state.stencil_target).stencil_plane(0).words[pixel] = 2;  // before it is visited
    selected.add(pixel, word, 0);
}

// The window bounds the depth that is compared, and the test looks at the one that is stored.
void Region::select_nearest_stored(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const KeyWindow window = window_of(state.selection, frame_, [&](Target t) { return codes_of(t); });
    const StoredDepth stored{at(state.depth_target)};
    for_each_column(sorted, window, [&](std::size_t p, std::span<const std::uint64_t> words, std::uint32_t first) {
        selected.inside += words.size() - first;
        const SortedFragments::Passing found = sorted.passing_stored(p, first, stored.of(p));
        if (found.passed == 0) return;
        selected.passed += found.passed;
        selected.add(p, found.word, 0);
    });
}

// A window of one key is followed to its end.
void Region::select_window(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    selected.start();
    const KeyWindow window = window_of(state.selection, frame_, [&](Target t) { return codes_of(t); });
    std::vector<std::uint64_t> in_order;
    for_each_column(sorted, window, [&](std::size_t p, std::span<const std::uint64_t> words, std::uint32_t first) {
        std::uint32_t last = first;
        if (window.at.exists())
            while (last < words.size() && words[last] >> 32 == window.low(p)) ++last;
        else
            last = std::max(first, sorted.below(p, window.high(p), Finger::high));
        selected.inside += last - first;
        const auto kept = in_order_of_arrival(words.subspan(first, last - first), in_order);
        for (std::size_t rank = 0; rank < kept.size(); ++rank) selected.add(p, kept[rank], rank);
    });
}

// Those before have counted the stencil down by the time that the kept ones come, and met no sample's test.
void Region::select_arrivals(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const std::size_t past = state.selection.first_arrival;
    for (std::size_t p = 0; p < sorted.pixels(); ++p) {
        const auto words = sorted.of(p);
        const std::size_t last = std::min(words.size(), past + samples_of_pass());
        for (std::size_t k = past; k < last; ++k) selected.add(p, words[k], k - past);
        selected.inside += last > past ? last - past : 0;
    }
    count_down(state, [&](std::size_t p) { return std::min(sorted.of(p).size(), past); });
}

// Decrements every sample's stencil by a number of fragments of its pixel, down to 0.
template <class FragmentsAt>
void Region::count_down(const PassState& state, const FragmentsAt& fragments_at) {
    TargetStorage& stencil = at(state.stencil_target);
    for (std::size_t p = 0; p < scratch_->sorted.present().pixels(); ++p) {
        const auto fragments = static_cast<std::uint32_t>(fragments_at(p));
        for (int sample = 0; fragments > 0 && sample < pass_samples_; ++sample) {
            std::uint32_t& stored = stencil.stencil_plane(sample).words[p];
            stored -= std::min(stored, fragments);
        }
    }
}

// Ends are taken by the columns' own keys: where a bound was flushed as a denormal, they are still the ones that decide.
void Region::select_ends(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const FragmentSelection& selection = state.selection;
    const KeyBound before{codes_of(selection.before), frame_.key};
    const auto range = selection.range.exists() ? at(selection.range).texels(0) : Texels{};
    for (std::size_t p = 0; p < sorted.pixels(); ++p) {
        sorted.prefetch(p + pixels_ahead, Finger::low);
        sorted.prefetch(p + pixels_ahead, Finger::high);
        const auto words = sorted.of(p);
        if (words.empty()) continue;
        const auto size = static_cast<std::uint32_t>(words.size());
        std::uint32_t first = 0, last = sorted.below(p, before.of(p), Finger::surface);
        if (selection.range.exists()) {
            const float near = -std::bit_cast<float>(range.plane(0).words[p]);
            const float far = std::bit_cast<float>(range.plane(1).words[p]);
            first = near <= far ? sorted.below(p, rasterizer::ordered_code(near), Finger::low) : last;
            if (near <= far)
                last = std::min(last, sorted.below(p, std::uint64_t{rasterizer::ordered_code(far)} + 1, Finger::high));
        }
        last = std::max(first, last);
        selected.inside += last - first;
        std::size_t rank = 0;
        const auto add = [&](std::uint32_t k) { selected.add(p, words[k], rank++); };
        const auto key = [&](std::uint32_t k) { return words[k] >> 32; };
        std::uint32_t near_end = first, far_begin = last;
        while (near_end < last && key(near_end) == key(first)) add(near_end++);
        while (far_begin > near_end && key(far_begin - 1) == key(last - 1)) --far_begin;
        if (near_end < far_begin) add(near_end);
        if (near_end + 1 < far_begin) add(far_begin - 1);
        for (std::uint32_t k = far_begin; k < last; ++k) add(k);
        // Only where the window writes nothing but its first key does the value of those outside come from outside.
        if (selection.outside == Outside::one_value && near_end == last && last - first < size)
            add(first > 0 ? 0 : last);
    }
}

// Keys that are stored codes need no fetching. Pixels rise within a rank, so their rows do.
FragmentBatch* Region::next_selected(const PassState& state) {
    SelectedFragments& selected = scratch_->selected;
    while (selected.rank < selected.ranks && selected.next == selected.of_rank[selected.rank].size())
        ++selected.rank, selected.next = 0;
    if (selected.rank == selected.ranks) return nullptr;
    const auto& all = selected.of_rank[selected.rank];
    const std::size_t count = std::min<std::size_t>(all.size() - selected.next, batch_capacity);
    FragmentBatch& batch = scratch_->recalled;
    Lanes<std::uint32_t>& places = scratch_->depth_stored;
    const auto width = static_cast<std::uint32_t>(rect_.width());
    std::uint32_t row = all[selected.next].pixel / width;
    for (std::size_t i = 0; i < count; ++i) {
        const SelectedFragments::One& one = all[selected.next + i];
        while (one.pixel >= (row + 1) * width) ++row;
        batch.pixel[i] = one.pixel;
        batch.x[i] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(rect_.x0) + one.pixel - row * width);
        batch.y[i] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(rect_.y0) + row);
        batch.code[i] = one.key;
        places[i] = one.place;
    }
    if (state.selection.by_reference && !scratch_->sorted.present().is_by_reference())
        std::copy_n(batch.code.begin(), count, batch.reference_code.begin());
    selected.next += count;
    batch.count = static_cast<int>(count);
    batch.material = 0;
    FragmentNeeds fetched = state.needs;
    fetched.code = frame_.key == DepthKey::shader_z;  // else the key is the code
    store().fetch({places.data(), count}, fetched, batch);
    return &batch;
}

}  // namespace strata::pipeline
