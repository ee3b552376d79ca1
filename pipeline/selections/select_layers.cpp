// pipeline/selections/select_layers.cpp - which fragments a pass of a peel visits where the lists of layers say it: one a pixel, found before
// its first pass (execution.md 7.1).
#include "pipeline/fragments/layer_lists.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"

namespace strata::pipeline {

namespace {

// Whether windows are bounded by constants and by `behind` alone, whose codes are those of keys.
bool is_of_a_peel(const FragmentSelection& s) {
    const bool has_codes = !s.compared || (s.compared->compares_codes() && s.compared->epsilon.ulps == 0);
    const FragmentSelection peel{.keeps = Keeps::nearest,
                                 .outside = s.outside,
                                 .behind = s.behind,
                                 .least = s.least,
                                 .most = s.most,
                                 .keys_suffice = s.keys_suffice,
                                 .compared = s.compared,
                                 .repeats = s.repeats};
    return has_codes && s == peel;
}

// Whether a window is the key that one target holds.
bool is_of_one_key(const FragmentSelection& s) {
    return s == FragmentSelection{.keeps = Keeps::window, .outside = s.outside, .at = s.at} && s.at.exists();
}

}  // namespace

// A first pass begins the lists; a later one must be where they are: its bound is what the pass before left, and its test that of the first.
bool Region::select_layer(const PassState& state) {
    const FragmentSelection& selection = state.selection;
    if (state.stencil.enabled || wraps_depths() || !is_of_a_peel(selection)) return false;
    SortedSets& sets = scratch_->sorted;
    LayerLists& lists = sets.layers();
    const LayerLists::Peel peel{selection.least, std::uint64_t{selection.most} + 1, codes_of(state.depth_target),
                                storage(state.depth_target).format() == Format::d32f};
    if (selection.behind.exists()) {
        if (!lists.is_of(peel) || !lists.is_left(codes_of(selection.behind))) return false;
    } else {
        const std::uint64_t taken = store().used_bytes() + sets.present().bytes() + sets.bytes_of_other();
        if (!lists.begin(sets.present(), peel, frame_.replay.bytes - std::min(taken, frame_.replay.bytes)))
            return false;
    }
    lists.advance(depth_of_kept(state));
    SelectedFragments& selected = scratch_->selected;
    const bool is_done = selection.keys_suffice && std::ranges::none_of(state.color, &Target::exists);
    if (is_done)
        count_visits(selected.done = lists.layer().pixel.size());
    else
        selected.lend(lists.layer());
    return true;
}

// The fragments of the layer that the pass before has found, which is all that a window of that key holds.
bool Region::select_taken_layer(const PassState& state) {
    const LayerLists& lists = scratch_->sorted.layers();
    if (!is_of_one_key(state.selection) || lists.has_any_at_surface() || !lists.is_left(codes_of(state.selection.at)))
        return false;
    SelectedFragments& selected = scratch_->selected;
    selected.lend(lists.layer());
    for (const LayerLists::Tied& tied : lists.tied()) selected.add(tied.pixel, tied.word, tied.rank);
    selected.inside = lists.layer().pixel.size() + lists.tied().size();
    return true;
}

}  // namespace strata::pipeline
