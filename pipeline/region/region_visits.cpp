// pipeline/region/region_visits.cpp - geometry passes that visit only what decides: the fragments that a selection keeps go through the
// stages, and no others (execution.md 7.1). Literal execution never takes this way: it is what this one is tested against.
#include <algorithm>
#include <stdexcept>

#include "pipeline/fragments/find_visits.h"
#include "pipeline/frame/effects.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/stages/alpha_test.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

namespace {

// A stencil test that every fragment counts down, and that lets one code through, at every sample.
bool routes_arrivals(const PassState& state) {
    constexpr auto decr = StencilOp::decr;
    const StencilFace& face = state.stencil.front;
    const StencilFace counts_down{
        .func = CompareFunc::equal, .ref = face.ref, .fail = decr, .depth_fail = decr, .pass = decr};
    return state.stencil.enabled && !state.stencil.two_sided && face == counts_down && face.ref > 0 &&
           state.saturates_by_design && state.sample_mask == 0xff && !state.alpha.enabled &&
           state.depth_unit_count == 0 && state.selection.outside == Outside::dies &&
           state.depth == DepthTest{.enabled = true, .func = CompareFunc::always, .write = true};
}

// Whether the pass's tests are those of what it keeps.
bool has_tests_of_its_kind(const PassState& state, int samples) {
    constexpr DepthTest leaves_the_nearest{.enabled = true, .func = CompareFunc::less, .write = true};
    const bool is_plain = samples == 1 && (state.sample_mask & 1u) != 0 && !state.stencil.enabled;
    const bool is_untested = is_plain && !state.depth.enabled && !state.alpha.enabled && state.depth_unit_count == 0;
    switch (state.selection.keeps) {
        case Keeps::nearest:
            return is_plain && !state.ordered_rmw && state.depth == leaves_the_nearest &&
                   std::ranges::none_of(state.blend, &Blend::enabled);
        case Keeps::ends: return is_untested && !state.ordered_rmw;
        case Keeps::window: return state.selection.outside == Outside::dies || is_untested;
        case Keeps::arrivals: return routes_arrivals(state);
        case Keeps::everything: break;
    }
    return false;
}

// Ranges hold depths; channels hold values of stored codes, near which a program decides.
bool bounds_suit(const PassState& state, DepthKey key) {
    const FragmentSelection& selection = state.selection;
    const bool has_values = selection.near.channel >= 0 ||
                            std::ranges::any_of(selection.far, [](const KeyBound& far) { return far.channel >= 0; });
    const bool is_compared = selection.compared && (selection.near.exists() || selection.range.exists());
    const bool is_behind = !is_compared || (!selection.near.includes && state.needs.reference);
    return is_behind && (!selection.range.exists() || key == DepthKey::shader_z) &&
           (!has_values || (key == DepthKey::stored_code && selection.keeps == Keeps::window));
}

}  // namespace

bool Region::has_ordered_surface() const {
    const TargetStorage& surface = storage(opaque_depth_);
    const auto is_beyond = [format = depth_format(surface.format())](std::uint32_t code) {
        return rasterizer::is_beyond_range(code, format);
    };
    return !wraps_depths() || std::none_of(surface.depth(0), surface.depth(0) + rect_.area(), is_beyond);
}

// Of a tile whose fragments fit into memory, and are sortable.
bool Region::find_visits(const PassState& state, const PreparedDraw& list) {
    const FragmentSelection& selection = state.selection;
    const bool is_plain_run =
        may_record(list) && !instruments_.log_passes && frame_.termination.rule != TerminationRule::ratio;
    const bool tests_codes = state.depth.enabled && selection.keeps != Keeps::window;
    if (!is_plain_run || state.replaces_depth || !has_tests_of_its_kind(state, pass_samples_) ||
        (tests_codes && frame_.key != DepthKey::stored_code) || !bounds_suit(state, frame_.key) ||
        !has_ordered_surface())
        return false;
    FragmentNeeds kept = pass_needs(state, needs_of_tile(list), frame_.effects);
    kept.texcoord = state.needs.texcoord;
    kept.units = state.needs.units;
    if (!record(list, kept) || !sort_for(state)) return false;
    const bool has_order = selection.keeps == Keeps::ends || selection.outside == Outside::writes_alike;
    const bool is_float = std::ranges::any_of(
        state.color, [&](Target t) { return t.exists() && info(at(t).format()).type != ChannelType::unorm8; });
    if (has_order && is_float && state.needs.color && !scratch_->fragments.has_plain_colors()) return false;
    scratch_->visits.start();
    return find_kept(state);
}

// The sorting that this pass looks into: one of two, for passes in turn may ask for two parts of a list.
bool Region::sort_for(const PassState& state) {
    SortRequest request{.key = frame_.key,
                        .is_float = frame_.key_request().format == DepthFormat::d32f,
                        .by_arrival = state.selection.keeps == Keeps::arrivals,
                        .primitives = {state.primitives.begin(), state.primitives.end()}};
    if (state.alpha.enabled && state.selection.keeps == Keeps::nearest) {
        request.alpha = state.alpha;
        const ChannelType type = state.color[0].exists() ? info(at(state.color[0]).format()).type : ChannelType::unorm8;
        request.eight_bit_alpha = is_eight_bit_alpha(profile().alpha_test, type);
    }
    RegionScratch& s = *scratch_;
    if (!s.sorted.is_of(request)) std::swap(s.sorted, s.other_sorted);
    if (s.sorted.is_of(request)) return s.sorted.is_sorted();
    const std::uint64_t taken = s.fragments.bytes() + s.other_sorted.bytes();
    return s.sorted.sort(s.fragments, request, rect_.area(), frame_.replay.bytes - std::min(taken, frame_.replay.bytes),
                         request.by_arrival ? codes_of(opaque_depth_) : nullptr);
}

Windows Region::windows_of(const FragmentSelection& s) const {
    const auto plane = [&](const KeyBound& bound) {
        if (!bound.exists()) return BoundPlane{};
        const TargetStorage& from = storage(bound.target);
        const bool is_value = bound.channel >= 0;
        const auto holds = is_value                           ? BoundPlane::Holds::values
                           : frame_.key == DepthKey::shader_z ? BoundPlane::Holds::depths
                                                              : BoundPlane::Holds::codes;
        const auto channel = static_cast<std::size_t>(is_value ? bound.channel : 0);
        return BoundPlane{from.texels(0).plane(channel).words, bound.includes, holds, frame_.key_request().format};
    };
    Windows windows{.near = plane(s.near),
                    .far = {plane(s.far[0]), plane(s.far[1])},
                    .least = s.least,
                    .end = std::uint64_t{s.most} + 1};
    if (s.range.exists()) {
        windows.range_near = storage(s.range).texels(0).plane(0).words;
        windows.range_far = storage(s.range).texels(0).plane(1).words;
    }
    return windows;
}

bool Region::find_kept(const PassState& state) {
    const FragmentSelection& selection = state.selection;
    RegionScratch& s = *scratch_;
    const Windows windows = windows_of(selection);
    const bool one_outside = selection.outside == Outside::writes_alike;
    const StoredCodes stored{codes_of(state.depth_target),
                             state.depth_target.exists() && storage(state.depth_target).format() == Format::d32f};
    switch (selection.keeps) {
        case Keeps::nearest:
            if (selection.compared && selection.near.exists())
                find_nearest_behind(s.sorted, s.fragments, *selection.compared,
                                    {.far = windows.far, .least = windows.least, .end = windows.end},
                                    codes_of(selection.near.target), stored, s.visits);
            else
                find_nearest(s.sorted, windows, stored, s.visits);
            return true;
        case Keeps::window: return find_windows(s.sorted, windows, s.visits);
        case Keeps::ends:
            if (selection.compared && selection.range.exists())
                find_ends_compared(s.sorted, s.fragments, *selection.compared, windows, one_outside, s.visits);
            else
                find_ends(s.sorted, windows, one_outside, s.visits);
            return true;
        case Keeps::arrivals: return waits_in_order(state) && (find_arrivals(state), true);
        case Keeps::everything: break;
    }
    return false;
}

// Whether sample s of every pixel with fragments takes arrival number first_arrival + s.
bool Region::waits_in_order(const PassState& state) const {
    if (state.selection.far[0].target != opaque_depth_) return false;
    const SortedColumns& sorted = scratch_->sorted;
    for (int s = 0; s < pass_samples_; ++s) {
        const std::uint32_t* const stored = storage(state.stencil_target).stencil(s);
        const std::uint32_t expected =
            state.stencil.front.ref + state.selection.first_arrival + static_cast<std::uint32_t>(s);
        for (std::size_t p = 0; p < sorted.pixels(); ++p)
            if (sorted.count(p) > 0 && stored[p] != expected) return false;
    }
    return true;
}

void Region::find_arrivals(const PassState& state) {
    const SortedColumns& sorted = scratch_->sorted;
    const std::uint32_t first = state.selection.first_arrival, end = first + static_cast<std::uint32_t>(pass_samples_);
    for (std::size_t p = 0; p < sorted.pixels(); ++p)
        for (std::uint32_t k = first; k < std::min(sorted.count(p), end); ++k)
            scratch_->visits.add(k - first, p, sorted.column(p)[k]);
}

// Those that come before have counted the stencil down by the time that the kept ones come, and met no sample's test. Sample s takes kept
// arrival s, which fails the tests of the others.
void Region::route_arrivals(const PassState& state) {
    for (std::size_t s = 0; s < scratch_->visits.waves(); ++s) {
        std::uint32_t* const stored = at(state.stencil_target).stencil_plane(static_cast<int>(s)).words;
        for (const std::uint32_t p : scratch_->visits.wave(s).pixel) stored[p] = state.stencil.front.ref;
    }
}

// What all of a pixel's fragments leave of stencils that waited in order.
void Region::finish_arrivals(const PassState& state) {
    const SortedColumns& sorted = scratch_->sorted;
    for (int s = 0; s < pass_samples_; ++s) {
        std::uint32_t* const stored = at(state.stencil_target).stencil_plane(s).words;
        const std::uint32_t before =
            state.stencil.front.ref + state.selection.first_arrival + static_cast<std::uint32_t>(s);
        for (std::size_t p = 0; p < sorted.pixels(); ++p)
            if (sorted.count(p) > 0) stored[p] = before - std::min(before, sorted.count(p));
    }
}

// Where the pixels of a batch lie in the window. A tile has at most 2^14 pixels in rows of up to 2^7, so that the reciprocal's
// error, below 2^-21 a pixel, is less than one part of a row.
void Region::find_positions(FragmentBatch& batch) const {
    const auto width = static_cast<std::uint32_t>(rect_.width()), x0 = static_cast<std::uint32_t>(rect_.x0);
    const std::uint32_t reciprocal = ((1u << 21) + width - 1) / width, y0 = static_cast<std::uint32_t>(rect_.y0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        const std::uint32_t row = batch.pixel[i] * reciprocal >> 21;
        batch.x[i] = static_cast<std::uint16_t>(x0 + batch.pixel[i] - row * width);
        batch.y[i] = static_cast<std::uint16_t>(y0 + row);
    }
}

// Stored codes are keys, which need no fetching.
FragmentBatch* Region::next_visit(const PassState& state) {
    const Visits::Part part = scratch_->visits.next();
    if (part.pixel.empty()) return nullptr;
    FragmentBatch& batch = scratch_->recorded;
    batch.count = static_cast<int>(part.pixel.size());
    batch.material = 0;
    Lanes<std::uint32_t> places;
    const bool is_code = frame_.key == DepthKey::stored_code;
    for (std::size_t i = 0; i < part.pixel.size(); ++i) {
        batch.pixel[i] = part.pixel[i];
        places[i] = place_of(part.word[i]);
        if (is_code) batch.code[i] = key_of(part.word[i]);
    }
    find_positions(batch);
    FragmentNeeds needs = pass_needs(state, {}, frame_.effects);
    needs.code &= !is_code;
    scratch_->fragments.fetch({places.data(), part.pixel.size()}, needs, batch);
    wave_ = part.wave;
    return &batch;
}

std::uint64_t Region::recorded() const noexcept { return scratch_->fragments.size(); }

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
