// pipeline/region/region_rows.cpp - geometry passes that need no batches: the rasterizer's rows are written directly to
// the targets, if that gives the same bits. Literal execution never uses this path, which is tested against it.
#include <algorithm>

#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_source.h"
#include "pipeline/region/region_stages.h"
#include "pipeline/region/region_targets.h"
#include "pipeline/stages/sum_rows.h"
#include "rasterizer/walk/rows.h"

namespace strata::pipeline {

namespace {

// A row reads and writes whole vectors: the words after a target's last pixel make room for the last vector.
static_assert(rasterizer::row_padding <= spare_words);

// Literal execution, --effects all and a timed effect use batches.
[[nodiscard]] bool may_leave_batches(const RegionShared& shared) {
    return !shared.is_frame() && shared.frame.effects == Effects::needed &&
           shared.instruments.once_more == Effect::none;
}

}  // namespace

bool FragmentSource::may_walk_rows(const PreparedDraw& list) const {
    // The geometries of all samples have one state.
    return may_leave_batches(shared_) && row_walk_suits(list.geometry, shared_.frame.key_request(), shared_.rect());
}

// True if no stage is needed between the rasterizer and the tests of this pass. Depth rows support more cases than
// other rows, which also require may_walk_rows.
bool FragmentSource::draws_rows(const PassState& state, const PreparedDraw& list) {
    if (!may_leave_batches(shared_) || !depth_rows_suit(list.geometry, shared_.frame.key_request(), shared_.rect()))
        return false;
    const bool is_plain = !state.alpha.enabled && !state.stencil.enabled && state.depth_unit_count == 0 &&
                          (state.sample_mask & 1u) != 0 && state.primitives.empty() && !state.needs.reference &&
                          !state.replaces_depth && std::ranges::none_of(state.reads, &Target::exists) &&
                          std::ranges::none_of(state.textures, &Target::exists) && !needs_of_tile(list).color;
    const bool is_recorded = shared_.frame.replay.bytes > 0 && shared_.scratch.fragments.serves(state.needs);
    return is_plain && !is_recorded;
}

// LESS with a write is the only depth pass that rows implement; every other uses batches
// (pipeline/reference/execution.md 7).
bool FragmentSource::depth_suits_rows(const PassState& state) {
    const bool is_nearest = state.depth == DepthTest{.enabled = true, .func = CompareFunc::less, .write = true};
    return is_nearest && targets_.is_one_sample(state.depth_target) && draws_rows(state, *shared_.frame.transparent);
}

rasterizer::DepthDrawn FragmentSource::draw_depth_rows(const PassState& state) {
    stages_.begin_pass(state, PassKind::geometry);
    Word* const codes = targets_.at(state.depth_target).depth_plane(0).words;
    rasterizer::DepthDrawn all;
    for (std::size_t sample = 0; sample < shared_.samples; ++sample) {
        const rasterizer::Geometry& geometry = shared_.frame.transparent->of_sample(sample);
        const rasterizer::DepthDrawn rows =
            rasterizer::draw_depth_rows(geometry, geometry.bin(shared_.area.tile), shared_.frame.key_request(),
                                        shared_.rect(), codes + sample * shared_.pixels());
        all.fragments += rows.fragments;
        all.passed += rows.passed;
    }
    shared_.statistics.fragments_drawn += all.fragments;
    return all;
}

// Rows add to halves, rounded to nearest, and to binary32; colours must be exact planes without texture or shadow
// (execution.md 7). Everything else runs the program.
bool FragmentSource::sums_suit_rows(const PassState& state) {
    const auto is_sum = [&](std::size_t k, Format format) {
        return targets_.is_one_sample(state.color[k]) && targets_.at(state.color[k]).format() == format &&
               state.blend[k] == blend_mode::sum;
    };
    const PreparedDraw& list = *shared_.frame.transparent;
    const bool is_tested = state.depth == DepthTest{.enabled = true, .func = CompareFunc::less, .write = false};
    const bool has_count_target = state.color[1].exists();
    const auto are_sums = [&](Format sums, Format count) {
        return is_sum(0, sums) && (!has_count_target || is_sum(1, count));
    };
    return is_tested && !state.color[2].exists() && targets_.is_one_sample(state.depth_target) &&
           (are_sums(Format::rgba32f, Format::r32f) ||
            (are_sums(Format::rgba16f, Format::r16f) && shared_.profile().half_rounding == HalfRounding::nearest_even &&
             shared_.profile().blend_storage == BlendStorage::target)) &&
           shared_.profile().raster.color == rasterizer::ColorInterpolation::exact_plane && may_walk_rows(list) &&
           draws_rows(state, list) && list.needs.shadow == 0 && !list.needs.fog && !list.needs.secondary &&
           !needs_of_tile(list).texcoord;
}

rasterizer::DepthDrawn FragmentSource::draw_sum_rows(const PassState& state) {
    const PreparedDraw& list = *shared_.frame.transparent;
    stages_.begin_pass(state, PassKind::geometry);
    // For triangles of few pixels, testing each fragment takes less time than bounding all triangles.
    const bool has_few_pixels = 4 * list.triangles_in(shared_.area.tile) > shared_.elements();
    const bool is_open = has_few_pixels || depth_outcome(state, list) == DepthOutcome::open;
    const bool has_count_target = state.color[1].exists();
    const Texels sums = targets_.at(state.color[0]).texels(0);
    rasterizer::DepthDrawn all;
    for (std::size_t sample = 0; sample < shared_.samples; ++sample) {
        const std::size_t first = sample * shared_.pixels();
        SumPlanes planes{sums.words() == 4 ? SumWords::binary32 : SumWords::halves,
                         {},
                         has_count_target ? targets_.at(state.color[1]).texels(0).plane(0).words + first : nullptr,
                         is_open ? targets_.at(state.depth_target).depth_plane(0).words + first : nullptr,
                         shared_.profile().denormals == DenormalRule::flush};
        for (std::size_t word = 0; word < sums.words(); ++word) planes.sums[word] = sums.plane(word).words + first;
        const rasterizer::DepthDrawn rows = add_sum_rows(list.of_sample(sample), triangles_of(list, sample),
                                                         shared_.frame.key_request(), shared_.rect(), planes);
        all.fragments += rows.fragments;
        all.passed += rows.passed;
    }
    shared_.statistics.fragments_drawn += all.fragments;
    return all;
}

}  // namespace strata::pipeline
