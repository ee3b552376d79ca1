// pipeline/region/region_selected.cpp - geometry passes that visit only the fragments that a selection keeps: only they
// go through the stages (pipeline/reference/execution.md 7.1). Literal execution never uses this path, which is tested
// against it.
#include <algorithm>

#include "pipeline/fragments/find_fragments.h"
#include "pipeline/frame/effects.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_source.h"
#include "pipeline/region/region_stages.h"
#include "pipeline/region/region_targets.h"
#include "pipeline/stages/alpha_test.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

namespace {

// True for a stencil test that every fragment counts down and that passes for one code, at every sample.
bool routes_submitted(const PassState& state) {
    constexpr auto decr = StencilOp::decr;
    const StencilFace& face = state.stencil.front;
    const StencilFace counts_down{
        .func = CompareFunc::equal, .ref = face.ref, .fail = decr, .depth_fail = decr, .pass = decr};
    return state.stencil.enabled && !state.stencil.two_sided && face == counts_down && face.ref > 0 &&
           state.sample_mask == 0xff && !state.alpha.enabled && state.depth_unit_count == 0 &&
           state.selection.outside == Outside::dies &&
           state.depth == DepthTest{.enabled = true, .func = CompareFunc::always, .write = true};
}

// True if the pass's tests are those that its KeptFragments requires.
bool has_tests_of_its_kind(const PassState& state, int samples) {
    constexpr DepthTest leaves_the_nearest{.enabled = true, .func = CompareFunc::less, .write = true};
    const bool is_plain = samples == 1 && (state.sample_mask & 1u) != 0 && !state.stencil.enabled;
    const bool is_untested = is_plain && !state.depth.enabled && !state.alpha.enabled && state.depth_unit_count == 0;
    switch (state.selection.keeps) {
        case KeptFragments::nearest:
            return is_plain && !state.ordered_rmw && state.depth == leaves_the_nearest &&
                   std::ranges::none_of(state.blend, &Blend::reads_target);
        case KeptFragments::group:
        case KeptFragments::ends: return is_untested && !state.ordered_rmw;
        case KeptFragments::interval: return state.selection.outside == Outside::dies || is_untested;
        case KeptFragments::submitted: return routes_submitted(state);
        case KeptFragments::everything: break;
    }
    return false;
}

// True if the bounds suit the key: ranges contain depths; channels contain values of stored codes, near which a program
// decides.
bool bounds_suit(const PassState& state, DepthKey key) {
    const FragmentSelection& selection = state.selection;
    const bool has_values = selection.near.channel >= 0 ||
                            std::ranges::any_of(selection.far, [](const KeyBound& far) { return far.channel >= 0; });
    const bool is_compared = selection.compared && (selection.near.exists() || selection.range.exists());
    const bool is_behind = !is_compared || (!selection.near.includes && state.needs.reference);
    return is_behind && (!selection.range.exists() || key == DepthKey::shader_z) &&
           (!has_values || (key == DepthKey::stored_code && selection.keeps == KeptFragments::interval));
}

}  // namespace

// Requires that the tile's fragments fit into memory and can be sorted.
bool FragmentSource::find_fragments(const PassState& state, const PreparedDraw& list) {
    const FragmentSelection& selection = state.selection;
    const bool is_plain_run = may_record(list) && !shared_.frame.loads_others() && !shared_.instruments.log_passes &&
                              shared_.frame.termination.rule != TerminationRule::ratio;
    const bool tests_codes = state.depth.enabled && selection.keeps != KeptFragments::interval;
    if (!is_plain_run || state.replaces_depth || !has_tests_of_its_kind(state, stages_.samples()) ||
        (tests_codes && shared_.frame.key != DepthKey::stored_code) || !bounds_suit(state, shared_.frame.key) ||
        !targets_.has_ordered_surface())
        return false;
    FragmentNeeds kept = pass_needs(state, needs_of_tile(list), shared_.frame.effects);
    kept.texcoord = state.needs.texcoord;
    kept.units = state.needs.units;
    kept.fog = state.needs.fog;
    kept.secondary = state.needs.secondary;
    if (!record(list, kept) || !sort_for(state)) return false;
    const bool has_order = selection.keeps == KeptFragments::ends || selection.keeps == KeptFragments::group ||
                           selection.outside == Outside::writes_alike;
    const bool is_float = std::ranges::any_of(
        state.color, [&](Target t) { return t.exists() && info(targets_.at(t).format()).type != ChannelType::unorm8; });
    if (has_order && is_float && state.needs.color && !shared_.scratch.fragments.has_plain_colors()) return false;
    shared_.scratch.waves.start();
    if (!find_kept(state)) return false;
    shared_.statistics.taken.reads_record = true;
    return true;
}

// Selects the sorted lists for this pass. There are two, because alternating passes may use two parts of a list.
bool FragmentSource::sort_for(const PassState& state) {
    SortRequest request{.key = shared_.frame.key,
                        .is_float = shared_.frame.key_request().format == DepthFormat::d32f,
                        .by_submission = state.selection.keeps == KeptFragments::submitted,
                        .primitives = {state.primitives.begin(), state.primitives.end()}};
    if (state.alpha.enabled && state.selection.keeps == KeptFragments::nearest) {
        request.alpha = state.alpha;
        const ChannelType type =
            state.color[0].exists() ? info(targets_.at(state.color[0]).format()).type : ChannelType::unorm8;
        request.eight_bit_alpha = is_eight_bit_alpha(shared_.profile().alpha_test, type);
    }
    RegionScratch& s = shared_.scratch;
    if (!s.sorted.is_of(request)) std::swap(s.sorted, s.other_sorted);
    if (s.sorted.is_of(request)) return s.sorted.is_sorted();
    const std::uint64_t taken = s.fragments.bytes() + s.other_sorted.bytes();
    return s.sorted.sort(s.fragments, request, shared_.elements(),
                         shared_.frame.replay.bytes - std::min(taken, shared_.frame.replay.bytes),
                         request.by_submission ? targets_.codes_of(targets_.opaque_depth()) : nullptr);
}

KeyIntervals FragmentSource::intervals_of(const FragmentSelection& s) const {
    const auto plane = [&](const KeyBound& bound) {
        if (!bound.exists()) return BoundPlane{};
        const TargetStorage& from = targets_.at(bound.target);
        const bool is_value = bound.channel >= 0;
        const auto contents = is_value                                  ? BoundPlane::Contents::values
                              : shared_.frame.key == DepthKey::shader_z ? BoundPlane::Contents::depths
                                                                        : BoundPlane::Contents::codes;
        const auto channel = static_cast<std::size_t>(is_value ? bound.channel : 0);
        return BoundPlane{from.texels(0).plane(channel).words, bound.includes, contents,
                          shared_.frame.key_request().format};
    };
    KeyIntervals intervals{.near = plane(s.near),
                           .far = {plane(s.far[0]), plane(s.far[1])},
                           .least = s.least,
                           .end = std::uint64_t{s.most} + 1};
    if (s.range.exists()) {
        intervals.range_near = targets_.at(s.range).texels(0).plane(0).words;
        const bool has_far = info(targets_.at(s.range).format()).channels > 1;
        intervals.range_far = has_far ? targets_.at(s.range).texels(0).plane(1).words : nullptr;
    }
    return intervals;
}

bool FragmentSource::find_kept(const PassState& state) {
    const FragmentSelection& selection = state.selection;
    RegionScratch& s = shared_.scratch;
    const KeyIntervals intervals = intervals_of(selection);
    const bool one_outside = selection.outside == Outside::writes_alike;
    const StoredCodes stored{targets_.codes_of(state.depth_target),
                             state.depth_target.exists() && targets_.at(state.depth_target).format() == Format::d32f};
    switch (selection.keeps) {
        case KeptFragments::nearest:
            if (selection.compared && selection.near.exists())
                find_nearest_behind(s.sorted, s.fragments, *selection.compared,
                                    {.far = intervals.far, .least = intervals.least, .end = intervals.end},
                                    targets_.codes_of(selection.near.target), stored, s.waves);
            else
                find_nearest(s.sorted, intervals, stored, s.waves);
            return true;
        case KeptFragments::group: find_groups(s.sorted, intervals, s.waves); return true;
        case KeptFragments::interval: return find_intervals(s.sorted, intervals, s.waves);
        case KeptFragments::ends:
            if (selection.compared && selection.range.exists())
                find_ends_compared(s.sorted, s.fragments, *selection.compared, intervals, one_outside, s.waves);
            else
                find_ends(s.sorted, intervals, one_outside, s.waves);
            return true;
        case KeptFragments::submitted: return waits_in_order(state) && (find_submitted(state), true);
        case KeptFragments::everything: break;
    }
    return false;
}

// True if sample s of every pixel with fragments waits for fragment first_submitted + s of its pixel.
bool FragmentSource::waits_in_order(const PassState& state) const {
    if (state.selection.far[0].target != targets_.opaque_depth()) return false;
    const SortedLists& sorted = shared_.scratch.sorted;
    for (int s = 0; s < stages_.samples(); ++s) {
        const std::uint32_t* const stored = targets_.at(state.stencil_target).stencil(s);
        const std::uint32_t expected =
            state.stencil.front.ref + state.selection.first_submitted + static_cast<std::uint32_t>(s);
        for (std::size_t p = 0; p < sorted.pixels(); ++p)
            if (sorted.count(p) > 0 && stored[p] != expected) return false;
    }
    return true;
}

void FragmentSource::find_submitted(const PassState& state) {
    const SortedLists& sorted = shared_.scratch.sorted;
    const std::uint32_t first = state.selection.first_submitted,
                        end = first + static_cast<std::uint32_t>(stages_.samples());
    for (std::size_t p = 0; p < sorted.pixels(); ++p)
        for (std::uint32_t k = first; k < std::min(sorted.count(p), end); ++k)
            shared_.scratch.waves.add(k - first, p, sorted.list(p)[k]);
}

// Fragments before the kept ones have counted the stencil down without passing any sample's test. Sample s then takes
// kept fragment s, which fails the tests of the other samples.
void FragmentSource::route_submitted(const PassState& state) {
    for (std::size_t s = 0; s < shared_.scratch.waves.waves(); ++s) {
        std::uint32_t* const stored = targets_.at(state.stencil_target).stencil_plane(static_cast<int>(s)).words;
        for (const std::uint32_t p : shared_.scratch.waves.wave(s).pixel) stored[p] = state.stencil.front.ref;
    }
}

// Sets the stencils of samples that waited in order to the values that all of a pixel's fragments leave.
void FragmentSource::finish_submitted(const PassState& state) {
    const SortedLists& sorted = shared_.scratch.sorted;
    for (int s = 0; s < stages_.samples(); ++s) {
        std::uint32_t* const stored = targets_.at(state.stencil_target).stencil_plane(s).words;
        const std::uint32_t before =
            state.stencil.front.ref + state.selection.first_submitted + static_cast<std::uint32_t>(s);
        for (std::size_t p = 0; p < sorted.pixels(); ++p)
            if (sorted.count(p) > 0) stored[p] = before - std::min(before, sorted.count(p));
    }
}

// Computes the window positions of a batch's elements from their indices. A tile has at most 2^14 pixels in rows of up
// to 2^7, so the reciprocal's error, below 2^-21 per pixel, adds up to less than one pixel's share of a row.
void FragmentSource::find_positions(FragmentBatch& batch) const {
    const auto width = static_cast<std::uint32_t>(shared_.rect().width()),
               x0 = static_cast<std::uint32_t>(shared_.rect().x0);
    const std::uint32_t reciprocal = ((1u << 21) + width - 1) / width,
                        y0 = static_cast<std::uint32_t>(shared_.rect().y0),
                        pixels = static_cast<std::uint32_t>(shared_.pixels());
    const auto set = [&](std::size_t i, std::uint32_t pixel) {
        const std::uint32_t row = pixel * reciprocal >> 21;
        batch.x[i] = static_cast<std::uint16_t>(x0 + pixel - row * width);
        batch.y[i] = static_cast<std::uint16_t>(y0 + row);
    };
    const auto count = static_cast<std::size_t>(batch.count);
    if (shared_.samples == 1)
        for (std::size_t i = 0; i < count; ++i) set(i, batch.pixel[i]);
    else
        for (std::size_t i = 0; i < count; ++i) set(i, batch.pixel[i] % pixels);
}

// Stored codes are the keys, so they need not be fetched.
FragmentBatch* FragmentSource::next_visit(const PassState& state) {
    const FragmentWaves::Part part = shared_.scratch.waves.next();
    if (part.pixel.empty()) return nullptr;
    FragmentBatch& batch = shared_.scratch.recorded;
    batch.count = static_cast<int>(part.pixel.size());
    batch.material = 0;
    Lanes<std::uint32_t> indices;
    const bool is_code = shared_.frame.key == DepthKey::stored_code;
    for (std::size_t i = 0; i < part.pixel.size(); ++i) {
        batch.pixel[i] = part.pixel[i];
        indices[i] = index_of(part.entry[i]);
        if (is_code) batch.code[i] = key_of(part.entry[i]);
    }
    find_positions(batch);
    FragmentNeeds needs = pass_needs(state, {}, shared_.frame.effects);
    needs.code &= !is_code;
    shared_.scratch.fragments.fetch({indices.data(), part.pixel.size()}, needs, batch);
    wave_ = part.wave;
    return &batch;
}

std::uint64_t FragmentSource::recorded() const noexcept { return shared_.scratch.fragments.size(); }

}  // namespace strata::pipeline
