// pipeline/region/region_replay.cpp - where a geometry pass gets its fragments from: the rasterizer, or what an earlier pass captured.
#include <algorithm>
#include <utility>

#include "pipeline/frame/effects.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "rasterizer/rules/depth_code.h"
#include "rasterizer/set_up/depth_bound.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

FragmentStore& Region::store() noexcept { return scratch_->store; }

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
    const bool checks = wraps_depths() && needs.code && (books_.counts || source_ == Source::captured);
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

// Sends every captured batch down the stages again, in submission order.
void Region::replay(rasterizer::BatchSink sink) {
    const Source before = std::exchange(source_, Source::store);
    for (std::size_t number = 0; number < store().batches(); ++number) {
        store().recall(number, scratch_->recalled, scratch_->recalled_alive);
        sink(scratch_->recalled);
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

// The first pass over the repeated list captures what it and all later passes look at; a list that did not fit is rasterized
// every time.
void Region::for_each_batch(const PreparedDraw& list, const PassState& state, rasterizer::BatchSink sink) {
    depth_ = depth_outcome(state, list);
    const MaterialNeeds& materials = needs_of_tile(list);
    FragmentNeeds needs = with_value(pass_needs(state, materials, frame_.effects, depth_), instruments_.once_more);
    if (instruments_.log_passes)
        books_.pass_log.passes.push_back({state, needs, pass_needs(state, materials, Effects::needed),
                                          needs.color && materials.texcoord, &list == frame_.opaque,
                                          books_.iterations});
    const bool may_replay = frame_.replay.bytes > 0 && &list == frame_.repeated() && state.primitives.empty();
    FragmentNeeds kept = needs;
    kept.texcoord = state.needs.texcoord;  // for the program; colours are kept with their texture and shadow
    kept.units = state.needs.units;
    if (may_replay && store().serves(kept)) {
        store().recall_only(needs);
        replay(sink);
    } else if (may_replay && store().may_start()) {
        source_ = Source::captured;
        needs = needs | frame_.replay.needs;
        needs.texcoord |= materials.texcoord && needs.color;
        if (needs.color) needs.units |= materials.shadow;
        store().start(kept | frame_.replay.needs, frame_.replay.bytes);
        scratch_->sorted.forget();
        rasterize(list, needs, {}, sink);
        store().finish();
    } else {
        rasterize(list, needs, state.primitives, sink);
    }
    source_ = Source::rasterizer;
}

// The material stage gives the same colours whether it runs or is remembered.
void Region::shade_or_recall(const PreparedDraw& list, FragmentBatch& batch, Outputs& out) {
    if (source_ != Source::store) {
        shade(list, batch, out);
        if (source_ == Source::captured) store().append(batch, out.alive);
        return;
    }
    std::copy_n(scratch_->recalled_alive.begin(), batch.count, out.alive.begin());
}

}  // namespace strata::pipeline
