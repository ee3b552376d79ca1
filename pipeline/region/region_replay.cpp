// pipeline/region/region_replay.cpp - where a geometry pass gets its fragments from: the rasterizer, or what is recorded of the tile.
#include <algorithm>
#include <utility>

#include "pipeline/fragments/record_rows.h"
#include "pipeline/frame/effects.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "rasterizer/rules/depth_code.h"
#include "rasterizer/set_up/depth_bound.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

// A second list's is not asked for tile by tile.
const MaterialNeeds& Region::needs_of_tile(const PreparedDraw& list) {
    const bool is_transparent = &list == frame_.transparent, is_opaque = &list == frame_.opaque;
    if (extent_ == Extent::frame || list.needs == MaterialNeeds{} || !(is_transparent || is_opaque)) return list.needs;
    auto& needs = is_transparent ? transparent_needs_ : opaque_needs_;
    if (!needs) needs = needs_of(list, list.geometry.bin(tile_));
    return *needs;
}

// Numbers of the triangles that may touch the region, in submission order.
std::span<const std::uint32_t> Region::triangles_of(const PreparedDraw& list) const noexcept {
    return extent_ == Extent::frame ? std::span<const std::uint32_t>{list.geometry.all_triangles}
                                    : list.geometry.bin(tile_);
}

// Without ranges all triangles are drawn. Triangles stand in submission order, and the pieces of a clipped one carry
// its number, so that a range of primitives is a run of triangles.
void Region::rasterize(const PreparedDraw& list, FragmentNeeds needs, std::span<const PrimitiveRange> primitives,
                       rasterizer::BatchSink given) {
    samples_textures_ = needs.color && needs_of_tile(list).texcoord;
    takes_shadow_ = needs.color && list.needs.shadow != 0;
    const auto& geometry = list.geometry;
    const auto triangles = triangles_of(list);
    auto checked = [&](FragmentBatch& batch) {
        require_range(batch);
        given(batch);
    };
    // A silent look orders nothing.
    const bool checks = wraps_depths() && needs.code && (books_.counts || source_ == Source::recording);
    const rasterizer::BatchSink sink = checks ? rasterizer::BatchSink{checked} : given;
    if (primitives.empty()) rasterizer_->draw(geometry, triangles, frame_.key_request(), needs, sink);
    const auto before = [&](std::uint32_t triangle, std::uint32_t primitive) {
        return geometry.triangles[triangle].primitive < primitive;
    };
    for (const PrimitiveRange& range : primitives) {
        const auto first = std::lower_bound(triangles.begin(), triangles.end(), range.first, before);
        const auto last = std::lower_bound(first, triangles.end(), range.last, before);
        const auto part = triangles.subspan(static_cast<std::size_t>(first - triangles.begin()),
                                            static_cast<std::size_t>(last - first));
        rasterizer_->draw(geometry, part, frame_.key_request(), needs, sink);
    }
}

// Codes beyond the range order as no key does: where one comes, the frame is drawn as its definition has it (execution.md 5.4).
void Region::require_range(const FragmentBatch& batch) const {
    const rasterizer::DepthFormat format = frame_.key_request().format;
    const auto is_beyond = [&](std::uint32_t code) { return rasterizer::is_beyond_range(code, format); };
    if (extent_ == Extent::tile && std::any_of(batch.code.begin(), batch.code.begin() + batch.count, is_beyond))
        throw NeedsFrame{};
}

// Whether passes may look at what was recorded, rather than rasterize the list again.
bool Region::may_record(const PreparedDraw& list) const {
    return extent_ == Extent::tile && frame_.effects == Effects::needed && instruments_.once_more == Effect::none &&
           frame_.replay.bytes > 0 && &list == frame_.repeated();
}

// What all passes look at is recorded before the first of them. False where that does not fit, or is not recorded at all.
bool Region::record(const PreparedDraw& list, const FragmentNeeds& needs) {
    TileFragments& fragments = scratch_->fragments;
    if (fragments.serves(needs)) return true;
    const FragmentNeeds kept = needs | frame_.replay.needs;
    if (!TileFragments::records(kept) || !fragments.may_start()) return false;
    fragments.start(kept, frame_.replay.bytes);
    scratch_->sorted.forget();
    scratch_->other_sorted.forget();
    const MaterialNeeds& materials = needs_of_tile(list);
    if (rows_have(kept) && may_walk_rows(list) && materials == MaterialNeeds{} &&
        profile().raster.color == rasterizer::ColorInterpolation::exact_plane) {
        books_.fragments_drawn +=
            record_rows(fragments, list.geometry, triangles_of(list), frame_.key_request(), rect_);
        fragments.finish();
        return fragments.serves(needs);
    }
    FragmentNeeds drawn = kept;
    drawn.color |= materials.color;
    drawn.texcoord |= materials.texcoord && drawn.color;
    if (drawn.color) drawn.units |= materials.shadow;
    auto sink = [&](FragmentBatch& batch) {
        Outputs& out = start_batch(batch);
        shade(list, batch, out);
        fragments.append(batch, out.alive);
    };
    const Source before = std::exchange(source_, Source::recording);
    rasterize(list, drawn, {}, rasterizer::BatchSink{sink});
    source_ = before;
    fragments.finish();
    return fragments.serves(needs);
}

// Sends all recorded fragments down the stages, in the order of arrival.
void Region::visit_all(const FragmentNeeds& needs, rasterizer::BatchSink sink) {
    const Source before = std::exchange(source_, Source::record);
    FragmentBatch& batch = scratch_->recorded;
    TileFragments::Reading& reading = scratch_->reading;
    reading = {0, 0, std::move(reading.stamp)};
    reading.stamp.assign(rect_.area(), 0);
    Lanes<std::uint32_t> places;
    for (auto next = scratch_->fragments.next_places(reading, places); !next.empty();
         next = scratch_->fragments.next_places(reading, places)) {
        batch.count = static_cast<int>(next.size());
        batch.material = 0;
        for (std::size_t i = 0; i < next.size(); ++i) batch.pixel[i] = scratch_->fragments.pixel()[next[i]];
        find_positions(batch);
        scratch_->fragments.fetch(next, needs, batch);
        sink(batch);
    }
    source_ = before;
}

// Whether the test against a cleared opaque depth can be left out in this tile.
DepthOutcome Region::depth_outcome(const PassState& state, const PreparedDraw& list) const {
    using rasterizer::DepthPath;
    const bool is_plain = state.depth.enabled && state.depth.func == CompareFunc::less && !state.depth.write &&
                          state.depth_target == opaque_depth_ && !state.stencil.enabled &&
                          state.depth_unit_count == 0 && !state.replaces_depth;
    const rasterizer::DepthRequest depth = frame_.key_request();
    const bool has_bound = depth.path == DepthPath::float32 || depth.path == DepthPath::exact;
    if (!is_plain || !has_bound || wraps_depths() || state.needs.code || !opaque_depth_is_cleared_ ||
        extent_ == Extent::frame || frame_.effects == Effects::all || &list != frame_.transparent)
        return DepthOutcome::open;
    const double bound = depth_bound(list.geometry, list.geometry.bin(tile_));
    const auto code = [&](float z) { return to_depth_code(z, depth.format, profile().raster.depth_rounding); };
    return code(static_cast<float>(bound)) < code(1.0f) ? DepthOutcome::passes : DepthOutcome::open;
}

// Of passes over the list that may be recorded.
void Region::note_rasterized(const PassState& state, const FragmentNeeds& needs) {
    PathTaken& taken = books_.taken;
    taken.rasterizes = true;
    if (taken.why_rasterized != nullptr) return;
    taken.why_rasterized = frame_.effects == Effects::all ? "--effects all simulates every effect in every pass"
                           : frame_.replay.bytes == 0     ? "--fragment-memory 0 records nothing"
                           : !TileFragments::records(needs)
                               ? "a pass looks at texture coordinates or facing, which are not recorded"
                           : !state.primitives.empty() ? "a pass looks at all fragments of a part of the list"
                                                       : "a tile's fragments take more than --fragment-memory";
}

// A list that did not fit is rasterized every time.
void Region::for_each_batch(const PreparedDraw& list, const PassState& state, rasterizer::BatchSink sink) {
    depth_ = depth_outcome(state, list);
    const MaterialNeeds& materials = needs_of_tile(list);
    const FragmentNeeds needs =
        with_value(pass_needs(state, materials, frame_.effects, depth_), instruments_.once_more);
    if (instruments_.log_passes)
        books_.pass_log.passes.push_back({state, needs, pass_needs(state, materials, Effects::needed),
                                          needs.color && materials.texcoord, &list == frame_.opaque,
                                          books_.iterations});
    FragmentNeeds looked_at = needs;
    looked_at.texcoord = state.needs.texcoord;  // for the program; colours are recorded with their texture and shadow
    looked_at.units = state.needs.units;
    if (may_record(list) && state.primitives.empty() && record(list, looked_at)) {
        books_.taken.reads_record = true;
        visit_all(looked_at, sink);
    } else {
        if (books_.counts && &list == frame_.repeated()) note_rasterized(state, looked_at);
        rasterize(list, needs, state.primitives, sink);
    }
}

}  // namespace strata::pipeline
