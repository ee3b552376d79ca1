// pipeline/region/region_rows.cpp - geometry passes that need no batches: the rasterizer's rows go straight into the targets, where
// that leaves the same bits. Literal execution never takes this way: it is what this one is tested against.
#include <algorithm>

#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/stages/sum_rows.h"
#include "rasterizer/walk/rows.h"

namespace strata::pipeline {

namespace {

// A row reads and writes whole vectors: the words behind a target's last pixel are room for the last one.
static_assert(rasterizer::row_padding <= spare_words);

// Literal execution, --effects all and a timed effect go through batches.
[[nodiscard]] bool may_leave_batches(Extent extent, Effects effects, Effect once_more) {
    return extent == Extent::tile && effects == Effects::needed && once_more == Effect::none;
}

}  // namespace

bool Region::may_walk_rows(const PreparedDraw& list) const {
    return may_leave_batches(extent_, frame_.effects, instruments_.once_more) &&
           row_walk_suits(list.geometry, frame_.key_request(), rect_);
}

// Whether nothing stands between the rasterizer and the tests of this pass. What rows of depth can do is more than what other rows
// can: they ask may_walk_rows, too.
bool Region::draws_rows(const PassState& state, const PreparedDraw& list) {
    if (!may_leave_batches(extent_, frame_.effects, instruments_.once_more) ||
        !depth_rows_suit(list.geometry, frame_.key_request(), rect_))
        return false;
    const bool is_plain = !state.alpha.enabled && !state.stencil.enabled && state.depth_unit_count == 0 &&
                          (state.sample_mask & 1u) != 0 && state.primitives.empty() && !state.needs.reference &&
                          !state.replaces_depth && std::ranges::none_of(state.reads, &Target::exists) &&
                          std::ranges::none_of(state.textures, &Target::exists) && !needs_of_tile(list).color;
    const bool is_recorded = frame_.replay.bytes > 0 && scratch_->fragments.serves(state.needs);
    return is_plain && !is_recorded;
}

// LESS with a write is the one depth pass that rows know; every other goes through batches (execution.md 7).
Drawn Region::draw_depth(const PassState& state) {
    const PreparedDraw& list = *frame_.transparent;
    const bool is_nearest = state.depth == DepthTest{.enabled = true, .func = CompareFunc::less, .write = true};
    if (!is_nearest || !is_one_sample(state.depth_target) || !draws_rows(state, list))
        return draw(state, [](const FragmentBatch&, const Loads&, Outputs&) {});
    begin_pass(state, PassKind::geometry);
    const rasterizer::DepthDrawn rows = draw_depth_rows(list.geometry, list.geometry.bin(tile_), frame_.key_request(),
                                                        rect_, at(state.depth_target).depth_plane(0).words);
    books_.fragments_drawn += rows.fragments;
    Drawn drawn;
    drawn.passed.own_ = rows.passed;
    return drawn;
}

// Rows add halves to nearest, and binary32, of colours by exact planes, without texture or shadow (execution.md 7). All else runs the
// program.
bool Region::sums_suit_rows(const PassState& state) {
    const auto is_sum = [&](std::size_t k, Format format) {
        return is_one_sample(state.color[k]) && storage(state.color[k]).format() == format &&
               state.blend[k] == blend_mode::sum;
    };
    const PreparedDraw& list = *frame_.transparent;
    const bool is_tested = state.depth == DepthTest{.enabled = true, .func = CompareFunc::less, .write = false};
    const bool has_count_target = state.color[1].exists();
    const auto are_sums = [&](Format sums, Format count) {
        return is_sum(0, sums) && (!has_count_target || is_sum(1, count));
    };
    return is_tested && !state.color[2].exists() && is_one_sample(state.depth_target) &&
           (are_sums(Format::rgba32f, Format::r32f) ||
            (are_sums(Format::rgba16f, Format::r16f) && profile().half_rounding == HalfRounding::nearest_even &&
             profile().blend_storage == BlendStorage::target)) &&
           profile().raster.color == rasterizer::ColorInterpolation::exact_plane && may_walk_rows(list) &&
           draws_rows(state, list) && list.needs.shadow == 0 && !needs_of_tile(list).texcoord;
}

Drawn Region::draw_sum_rows(const PassState& state) {
    const PreparedDraw& list = *frame_.transparent;
    begin_pass(state, PassKind::geometry);
    // Of triangles of few pixels a test of each fragment takes less than a bound of all triangles.
    const bool has_few_pixels = 4 * list.geometry.bin(tile_).size() > rect_.area();
    const bool is_open = has_few_pixels || depth_outcome(state, list) == DepthOutcome::open;
    const bool has_count_target = state.color[1].exists();
    const Texels sums = at(state.color[0]).texels(0);
    SumPlanes planes{sums.words() == 4 ? SumWords::binary32 : SumWords::halves,
                     {},
                     has_count_target ? at(state.color[1]).texels(0).plane(0).words : nullptr,
                     is_open ? at(state.depth_target).depth_plane(0).words : nullptr,
                     profile().denormals == DenormalRule::flush};
    for (std::size_t word = 0; word < sums.words(); ++word) planes.sums[word] = sums.plane(word).words;
    const rasterizer::DepthDrawn rows =
        add_sum_rows(list.geometry, list.geometry.bin(tile_), frame_.key_request(), rect_, planes);
    books_.fragments_drawn += rows.fragments;
    Drawn drawn;
    drawn.passed.own_ = rows.passed;
    return drawn;
}

}  // namespace strata::pipeline
