// pipeline/selections/select_columns.cpp - which fragments a pass with a selection visits: found in the sorted columns of a tile, pixel by pixel
// (execution.md 7.1).
#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "pipeline/frame/effects.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/selections/key_windows.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

namespace {

using Cursor = SortedFragments::Cursor;
using Numbers = FragmentStore::Numbers;

constexpr std::uint32_t greatest_stencil = 255;

// The words of a window by place; in `own` if they stand in another order.
std::span<const std::uint64_t> in_order_of_arrival(std::span<const std::uint64_t> words,
                                                   std::vector<std::uint64_t>& own) {
    const auto place = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    if (std::ranges::is_sorted(words, {}, place)) return words;
    own.assign(words.begin(), words.end());
    std::ranges::sort(own, {}, place);
    return own;
}

}  // namespace

void Region::select(const PassState& state) {
    if (std::exchange(scratch_->selected.is_ready, false)) return;
    scratch_->selected.start(scratch_->sorted.present().occupied().size());
    if (scratch_->sorted.present().is_compared())
        return state.selection.keeps == Keeps::ends ? select_ends_compared(state) : select_nearest_compared(state);
    switch (state.selection.keeps) {
        case Keeps::nearest:
            if (!select_layer(state)) select_nearest(state);
            return;
        case Keeps::last_two:
        case Keeps::previous: return select_nearest(state);
        case Keeps::window: return select_window(state);
        case Keeps::arrivals: return select_arrivals(state);
        case Keeps::ends: return select_ends(state);
        case Keeps::run: return select_run(state);
        case Keeps::nearest_after: return select_nearest_after(state);
        case Keeps::last_run: return select_last_run(state);
        case Keeps::everything: return;
    }
}

// Where the depth of what a depth test LESS keeps is put, which needs no test then: it passes. Null where a stencil has a say, or where
// what is stored is not what is compared (depth.md 2.9).
std::uint32_t* Region::depth_of_kept(const PassState& state) {
    if (state.stencil.enabled || wraps_depths()) return nullptr;
    depth_ = DepthOutcome::passes;
    return at(state.depth_target).depth_plane(0).words;
}

// Updates of a pixel form a chain (SortedFragments::passing), whose last is the nearest. Where a stencil counts them,
// the visited one counts itself.
void Region::select_nearest(const PassState& state) {
    const Keeps keeps = state.selection.keeps;
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    const KeyWindow window =
        window_of(state.selection, frame_, [&](Target t) -> const TargetStorage& { return storage(t); });
    const StoredDepth stored = stored_depth(state);
    const bool counts = keeps != Keeps::nearest || state.stencil.enabled;  // updates
    for_each_column(sorted, window, &stored, selected.windows, [&](const WindowColumn& column) {
        const auto& [number, p, words, first, end, tested, low] = column;
        if (!counts) {
            if (first < tested) selected.add(p, words[first], 0);
            return;
        }
        const std::uint32_t updates = sorted.passing(p, first, tested);
        if (keeps == Keeps::previous) {
            select_previous(state, p, {first, tested, end}, updates);
            return;
        }
        if (updates == 0) return;
        if (state.stencil.enabled) count_up(state, p, updates - 1);
        const bool has_two = keeps == Keeps::last_two && updates > 1;
        if (has_two) selected.add(p, words[sorted.update(p, first, tested, updates - 1)], 0);
        selected.add(p, words[first], has_two ? 1 : 0);
    });
}

StoredDepth Region::stored_depth(const PassState& state) const {
    return {codes_of(state.depth_target), storage(state.depth_target).format() == Format::d32f};
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
    if (made == 0) return;
    const std::uint32_t kept = sorted.update(pixel, part.first, part.last, made);
    at(state.stencil_target).stencil_plane(0).words[pixel] = 2;  // before it is visited
    selected.add(pixel, sorted.of(pixel)[kept], 0);
}

void Region::select_window(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted.present();
    SelectedFragments& selected = scratch_->selected;
    selected.start(sorted.occupied().size());
    if (select_taken_layer(state)) return;
    const KeyWindow window =
        window_of(state.selection, frame_, [&](Target t) -> const TargetStorage& { return storage(t); });
    std::vector<std::uint64_t> in_order;
    std::uint64_t inside = 0;
    for_each_column(sorted, window, nullptr, selected.windows, [&](const WindowColumn& column) {
        const auto& [number, p, words, first, last, tested, low] = column;
        inside += last - first;
        if (last == first) return;
        const auto kept = in_order_of_arrival(words.subspan(first, last - first), in_order);
        for (std::size_t rank = 0; rank < kept.size(); ++rank) selected.add(p, kept[rank], rank);
    });
    selected.inside = inside;
}

// The samples that the present batch is drawn to.
std::uint8_t Region::samples_of_selected(const PassState& state) const noexcept {
    const SelectedFragments& selected = scratch_->selected;
    return selected.is_routed ? static_cast<std::uint8_t>(1u << selected.rank) : state.sample_mask;
}

// Where the pixels of a batch lie in the window. A tile has at most 2^14 pixels in rows of up to 2^7, so that the reciprocal's
// error, below 2^-21 a pixel, is less than one part of a row.
void Region::find_positions(FragmentBatch& batch, std::size_t count) const {
    const auto width = static_cast<std::uint32_t>(rect_.width()), x0 = static_cast<std::uint32_t>(rect_.x0);
    const std::uint32_t reciprocal = ((1u << 21) + width - 1) / width, y0 = static_cast<std::uint32_t>(rect_.y0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t row = batch.pixel[i] * reciprocal >> 21;
        batch.x[i] = static_cast<std::uint16_t>(x0 + batch.pixel[i] - row * width);
        batch.y[i] = static_cast<std::uint16_t>(y0 + row);
    }
}

namespace {

// The depths that ordered codes stand for, which is exact but for -0. True if there is a 0.
bool put_depths(const Lanes<std::uint32_t>& code, std::size_t count, Lanes<float>& z) noexcept {
    constexpr std::uint32_t zero = rasterizer::ordered_code(0.0f);
    std::uint32_t has_zero = 0;
    for (std::size_t i = 0; i < count; ++i) {
        z[i] = std::bit_cast<float>(select(mask(code[i] >= zero), code[i] ^ zero, ~code[i]));
        has_zero |= mask(code[i] == zero);
    }
    return has_zero != 0;
}

}  // namespace

// Keys that are stored codes or depths need no fetching. No program that selects looks at a primitive's number: the trace does.
FragmentBatch* Region::next_selected(const PassState& state) {
    SelectedFragments& selected = scratch_->selected;
    while (selected.rank < selected.ranks && selected.next == selected.of_rank[selected.rank].count)
        ++selected.rank, selected.next = 0;
    if (selected.rank == selected.ranks) return nullptr;
    const SelectedFragments::Rank& all = selected.of_rank[selected.rank];
    const std::size_t count = std::min<std::size_t>(all.count - selected.next, batch_capacity);
    FragmentBatch& batch = scratch_->recalled;
    const auto [key, place, pixel] = all.part(selected.next, count);
    std::ranges::copy(pixel, batch.pixel.begin());
    std::ranges::copy(key, batch.code.begin());
    find_positions(batch, count);
    const bool is_compared = scratch_->sorted.present().is_compared();
    const bool is_reference_key = state.selection.compared && !is_compared;
    if (is_reference_key) std::copy_n(batch.code.begin(), count, batch.reference_code.begin());
    // It lies behind: so does the farthest there is.
    const bool is_known_behind = is_compared && state.selection.keeps == Keeps::nearest;
    if (is_known_behind) {
        std::fill_n(batch.reference_code.begin(), count, state.selection.compared->farthest_code());
        std::fill_n(batch.reference_z.begin(), count, std::numeric_limits<double>::infinity());
    }
    selected.next += count;
    batch.count = static_cast<int>(count);
    batch.material = 0;
    FragmentNeeds fetched = state.needs;
    if (frame_.key == DepthKey::shader_z && fetched.shader_z)
        fetched.shader_z = put_depths(batch.code, count, batch.shader_z);
    const bool has_ends = state.selection.keeps == Keeps::ends;
    fetched.color &= !(has_ends && state.selection.keys_suffice && SelectedFragments::is_inner_end(selected.rank));
    fetched.reference &= !is_reference_key && !is_known_behind;  // of a comparison of codes, which are the keys
    fetched.code =
        frame_.key == DepthKey::shader_z && pass_needs(state, {}, frame_.effects).code;  // else the key is it
    store().fetch(place, fetched, frame_.trace ? Numbers::yes : Numbers::no, batch);
    if (!frame_.trace) std::fill_n(batch.primitive.begin(), count, ~0u);
    return &batch;
}

}  // namespace strata::pipeline
