// pipeline/selections/selected_pass.cpp - geometry passes that visit only what decides: the fragments that a selection keeps go through
// the stages, and nothing else (execution.md 7.1). Literal execution never takes this way: it is
// what this one is tested against.
#include <algorithm>
#include <stdexcept>

#include "pipeline/frame/effects.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/stages/alpha_test.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

namespace {

constexpr DepthTest leaves_the_nearest{.enabled = true, .func = CompareFunc::less, .write = true};

// A stencil test that every fragment counts down, and that lets one code through, at every sample.
bool routes_arrivals(const PassState& state) {
    constexpr auto decr = StencilOp::decr;
    const StencilFace& face = state.stencil.front;
    const StencilFace counts_down{
        .func = CompareFunc::equal, .ref = face.ref, .fail = decr, .depth_fail = decr, .pass = decr};
    return state.stencil.enabled && !state.stencil.two_sided && face == counts_down && face.ref > 0 &&
           state.saturates_by_design && state.sample_mask == 0xff && state.selection.outside == Outside::discarded &&
           state.depth == DepthTest{.enabled = true, .func = CompareFunc::always, .write = true};
}

bool has_stencil(const PassState& state, const StencilFace& face) {
    return state.stencil.enabled && !state.stencil.two_sided && state.stencil.front == face &&
           !state.saturates_by_design;
}

// Whether the pass's tests are those of what it keeps.
bool has_tests_of_its_kind(const PassState& state, int samples) {
    constexpr StencilFace counts_updates{.func = CompareFunc::always, .ref = 0, .pass = StencilOp::incr};
    constexpr StencilFace counts_back{.func = CompareFunc::less, .ref = 1, .pass = StencilOp::decr};
    constexpr StencilFace counts_in_order{
        .func = CompareFunc::greater, .ref = 128, .depth_fail = StencilOp::invert, .pass = StencilOp::incr};
    constexpr StencilFace counts_first{.func = CompareFunc::equal, .ref = 255, .fail = StencilOp::incr};
    constexpr DepthTest leaves_the_last{.enabled = true, .func = CompareFunc::greater, .write = true};
    if (state.selection.keeps == Keeps::arrivals) return routes_arrivals(state);
    if (samples != 1) return false;
    const bool is_blended = std::ranges::any_of(state.blend, &Blend::enabled);
    switch (state.selection.keeps) {
        case Keeps::nearest:
            return state.depth == leaves_the_nearest && !is_blended &&
                   (!state.stencil.enabled || has_stencil(state, counts_updates));
        case Keeps::last_two: return state.depth == leaves_the_nearest && !state.stencil.enabled;
        case Keeps::previous:
            return state.depth == leaves_the_nearest && !is_blended && has_stencil(state, counts_back);
        case Keeps::window: return state.selection.outside == Outside::discarded;
        case Keeps::run: return state.depth == leaves_the_last && has_stencil(state, counts_in_order);
        case Keeps::nearest_after:
            return state.depth == leaves_the_nearest && !is_blended && has_stencil(state, counts_first);
        case Keeps::last_run: return state.ordered_rmw && !state.depth.enabled && !state.stencil.enabled;
        case Keeps::ends: return !state.depth.enabled && !state.stencil.enabled;
        case Keeps::arrivals:
        case Keeps::everything: break;
    }
    return false;
}

// Stages that no selection knows.
bool has_foreign_stages(const PassState& state) {
    const bool is_killed_by_alpha = state.selection.outside == Outside::alpha_test;
    const bool is_killed_by_unit = state.selection.outside == Outside::depth_unit;
    const bool is_ordered = state.ordered_rmw && state.selection.keeps != Keeps::last_run;
    return state.replaces_depth || is_ordered || (state.sample_mask & 1u) == 0 ||
           state.alpha.enabled != is_killed_by_alpha || state.depth_unit_count != (is_killed_by_unit ? 1 : 0);
}

// Whether selections of this kind look at stored codes alone: where they know what a depth test leaves, or what registers hold.
bool wants_stored_codes(const PassState& state) {
    const FragmentSelection& s = state.selection;
    return (state.depth.enabled && s.keeps != Keeps::window) || s.keeps == Keeps::last_run ||
           s.behind_value.target.exists() || s.before_value.target.exists();
}

}  // namespace

// A tile under replay whose fragments fit into memory, and are sortable. They are captured here without a stage behind
// MASK, if no pass has captured them yet.
bool Region::may_select(const PassState& state, const PreparedDraw& list) {
    const FragmentSelection& selection = state.selection;
    const bool is_plain_run = extent_ == Extent::tile && frame_.effects == Effects::needed &&
                              instruments_.once_more == Effect::none && !instruments_.log_passes &&
                              frame_.replay.bytes > 0 && &list == frame_.repeated() &&
                              frame_.termination.rule != TerminationRule::ratio;
    if (!is_plain_run || has_foreign_stages(state) || !has_tests_of_its_kind(state, pass_samples_) ||
        (wants_stored_codes(state) && frame_.key != DepthKey::stored_code) || !has_ordered_surface())
        return false;
    rasterizer::FragmentNeeds kept = pass_needs(state, needs_of_tile(list), frame_.effects);
    kept.texcoord = state.needs.texcoord;
    kept.units = state.needs.units;
    if (!store().serves(kept)) {
        if (!store().may_start()) return false;
        capture_unseen(list, kept | frame_.replay.needs);
        if (!store().serves(kept)) return false;
    }
    if (!sort_for(state)) return false;
    SortedFragments& sorted = scratch_->sorted.present();
    const Target own =
        selection.keeps == Keeps::last_run ? state.color[1] : state.color[0];  // not blended with colours
    const bool blends_all = selection.keeps == Keeps::ends || selection.keeps == Keeps::last_run;
    const bool has_order = blends_all && std::ranges::any_of(state.color, [&](Target t) {
                               return t.exists() && info(at(t).format()).type != ChannelType::unorm8 && t != own;
                           });
    if (has_order && !sorted.has_plain_colors(store())) return false;
    // Where a window holds most of the fragments, it is cheaper to visit all of them in a row.
    scratch_->selected.is_ready = selection.keeps == Keeps::window;
    if (!scratch_->selected.is_ready) return true;
    select_window(state);
    return instruments_.check_selections || 2 * scratch_->selected.inside <= sorted.size();
}

bool Region::has_ordered_surface() const {
    const TargetStorage& surface = storage(opaque_depth_);
    const auto is_beyond = [format = depth_format(surface.format())](std::uint32_t code) {
        return rasterizer::is_beyond_range(code, format);
    };
    return !wraps_depths() || std::none_of(surface.depth(0), surface.depth(0) + rect_.area(), is_beyond);
}

// Whether what is compared is not the key itself: where codes are compared, and every fragment's is its stored one, one sorting serves
// both. A first pass, which compares nothing, finds the same in either.
bool Region::is_compared_apart(const FragmentSelection& selection) const {
    if (!selection.compared) return false;
    const bool is_of_codes = selection.keeps == Keeps::nearest && selection.compared->compares_codes();
    return !is_of_codes || scratch_->store.has_references_apart();
}

// The sorting that this pass looks into.
bool Region::sort_for(const PassState& state) {
    const FragmentSelection& selection = state.selection;
    SortRequest request{.key = frame_.key,
                        .is_float = frame_.key_request().format == DepthFormat::d32f,
                        .by_arrival = selection.keeps == Keeps::arrivals,
                        .primitives = {state.primitives.begin(), state.primitives.end()}};
    if (state.alpha.enabled) {
        request.alpha = state.alpha;
        const ChannelType type = state.color[0].exists() ? info(at(state.color[0]).format()).type : ChannelType::unorm8;
        request.eight_bit_alpha = is_eight_bit_alpha(profile().alpha_test, type);
    }
    if (is_compared_apart(selection)) request.compared = *selection.compared;
    if (!request.compared) return find_or_sort(state, request);
    if (selection.keeps == Keeps::ends)
        return selection.range.exists() && frame_.key == DepthKey::shader_z && find_or_sort(state, request);
    const bool is_bounded = selection.before.exists() || selection.also_before.exists() || selection.up_to.exists() ||
                            selection.most != ~0u;
    return selection.keeps == Keeps::nearest && !state.stencil.enabled && !is_bounded &&
           frame_.key == DepthKey::stored_code && find_or_sort(state, request);
}

bool Region::find_or_sort(const PassState& state, const SortRequest& request) {
    SortedSets& sets = scratch_->sorted;
    if (sets.find(request)) return true;
    if (!sets.may_sort(request)) return false;
    store().recall_only(store().needs());
    const std::uint64_t others = std::min(sets.bytes_of_other(), frame_.replay.bytes);
    return sets.present().sort(store(), request, rect_.area(), frame_.replay.bytes - others,
                               codes_of(state.selection.before));
}

// As the first draw of a list does, but for the pass: that follows.
void Region::capture_unseen(const PreparedDraw& list, const FragmentNeeds& kept) {
    FragmentNeeds needs = kept;
    const MaterialNeeds& materials = needs_of_tile(list);
    needs.color |= materials.color;
    needs.texcoord |= materials.texcoord && needs.color;
    if (needs.color) needs.units |= materials.shadow;
    store().start(kept, frame_.replay.bytes);
    scratch_->sorted.forget();
    auto sink = [&](FragmentBatch& batch) {
        Outputs& out = start_batch(batch);
        shade(list, batch, out);
        store().append(batch, out.alive);
    };
    rasterize(list, needs, {}, rasterizer::BatchSink{sink});
    store().finish();
}

Region::Snapshot Region::snapshot() { return {storages_, scratch_->trace.size()}; }

void Region::restore(Snapshot& from) {
    std::swap(storages_, from.targets);
    scratch_->trace.shorten(from.traced);
}

void Region::require_equal(const Snapshot& selected, Count selected_passed, Count passed) {
    const auto require = [](bool holds, const char* what) {
        if (!holds)
            throw std::logic_error(std::string{"pass state: what a pass promises differs from its program in "} + what);
    };
    require((selected_passed.own_ > 0) == (passed.own_ > 0), "what it answers a query");
    for (std::size_t t = 0; t < storages_.size(); ++t)
        for (int channel = 0; channel < std::max(1, info(storages_[t].format()).channels); ++channel)
            for (int sample = 0; sample < storages_[t].samples(); ++sample)
                for (std::size_t p = 0; p < storages_[t].pixels(); ++p)
                    require(storages_[t].code(p, channel, sample) == selected.targets[t].code(p, channel, sample),
                            "what it leaves in a target");
}

}  // namespace strata::pipeline
