// pipeline/selections/repeat_pass.cpp - a pass that finds what the pass before found: its words are put where that one's are remembered from
// (execution.md 7.1).
#include <algorithm>

#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"

namespace strata::pipeline {

namespace {

FragmentSelection without_targets(FragmentSelection selection) {
    selection.behind = {};
    return selection;
}

// Calls `visit` with every plane that the pass writes: the depth and the words of its colour.
template <class Visit>
void for_each_plane(TargetStorage& depth, TargetStorage& color, const Visit& visit) {
    visit(depth.depth_plane(0).words);
    const Texels texels = color.texels(0);
    for (std::size_t word = 0; word < texels.words(); ++word) visit(texels.plane(word).words);
}

}  // namespace

// Nothing but `behind` bounds its windows, and it writes all of a colour and a depth. By the keys themselves nothing lies behind itself.
bool Region::may_repeat(const PassState& state) const {
    const FragmentSelection& s = state.selection;
    return s.behind.exists() && scratch_->sorted.present().is_compared() && state.primitives.empty() &&
           without_targets(s) ==
               FragmentSelection{
                   .keeps = Keeps::nearest, .outside = s.outside, .compared = s.compared, .repeats = true} &&
           state.color[0].exists() && state.blend[0].write_mask == 0xf &&
           std::ranges::count_if(state.color, &Target::exists) == 1;
}

bool Region::is_repeated(const PassState& state) {
    if (!may_repeat(state)) return false;
    RepeatedPass& last = scratch_->repeated;
    const std::uint32_t *const behind = codes_of(state.selection.behind), *const stored = codes_of(state.depth_target);
    if (scratch_->selected.is_remembered && last.selection == without_targets(state.selection) &&
        last.color_format == at(state.color[0]).format() && last.is_of(behind, stored))
        return true;
    last.begin(behind, stored, rect_.area());
    return false;
}

void Region::remember(const PassState& state) {
    if (!may_repeat(state)) return;
    RepeatedPass& last = scratch_->repeated;
    SelectedFragments& selected = scratch_->selected;
    last.selection = without_targets(state.selection);
    last.color_format = at(state.color[0]).format();
    last.left.clear();
    const auto kept = selected.kept();
    for_each_plane(at(state.depth_target), at(state.color[0]), [&](const Word* words) {
        for (const std::uint32_t pixel : kept) last.left.push_back(words[pixel]);
    });
    selected.is_remembered = true;
}

// Answers how many fragments pass.
std::uint64_t Region::repeat(const PassState& state) {
    const RepeatedPass& last = scratch_->repeated;
    const std::uint32_t* next = last.left.data();
    const auto kept = scratch_->selected.kept();
    for_each_plane(at(state.depth_target), at(state.color[0]), [&](Word* words) {
        for (const std::uint32_t pixel : kept) words[pixel] = *next++;
    });
    return kept.size();
}

}  // namespace strata::pipeline
