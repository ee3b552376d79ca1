// pipeline/region/region_source.cpp - provides the fragments of a geometry pass, from the rasterizer or from the tile's
// record.
#include "pipeline/region/region_source.h"

#include <algorithm>
#include <utility>

#include "pipeline/fragments/join_samples.h"
#include "pipeline/fragments/record_rows.h"
#include "pipeline/frame/effects.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_stages.h"
#include "pipeline/region/region_targets.h"
#include "rasterizer/rules/depth_code.h"
#include "rasterizer/set_up/depth_bound.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;
using rasterizer::Rect;

FragmentSource::FragmentSource(const RegionShared& shared, Targets& targets, Stages& stages)
    : shared_{shared},
      targets_{targets},
      stages_{stages},
      rasterizer_{std::make_unique<rasterizer::TileRasterizer>(shared.rect())} {}
FragmentSource::~FragmentSource() = default;

// Computed per tile for the transparent and the opaque list, not for a second list.
const MaterialNeeds& FragmentSource::needs_of_tile(const PreparedDraw& list) {
    const bool is_transparent = &list == shared_.frame.transparent, is_opaque = &list == shared_.frame.opaque;
    if (shared_.is_frame() || list.needs == MaterialNeeds{} || !(is_transparent || is_opaque)) return list.needs;
    auto& needs = is_transparent ? transparent_needs_ : opaque_needs_;
    if (!needs) {
        needs = MaterialNeeds{};
        for (std::size_t sample = 0; sample < shared_.samples; ++sample)
            *needs |= needs_of(list, triangles_of(list, sample), sample);
    }
    return *needs;
}

// Indices of the triangles that may touch the region, in submission order.
std::span<const std::uint32_t> FragmentSource::triangles_of(const PreparedDraw& list,
                                                            std::size_t sample) const noexcept {
    const rasterizer::Geometry& geometry = list.of_sample(sample);
    return shared_.is_frame() ? std::span<const std::uint32_t>{geometry.all_triangles}
                              : geometry.bin(shared_.area.tile);
}

// Sample by sample, each in submission order: a batch has elements of one sample.
void FragmentSource::rasterize(const PreparedDraw& list, FragmentNeeds needs,
                               std::span<const PrimitiveRange> primitives, rasterizer::BatchSink given) {
    stages_.set_material(needs.color ? needs_of_tile(list) : MaterialNeeds{});
    auto checked = [&](FragmentBatch& batch) {
        require_range(batch);
        given(batch);
    };
    // a silent query does not order fragments
    const bool checks = shared_.wraps_depths() && needs.code && (shared_.statistics.counts || from_ == From::recording);
    const rasterizer::BatchSink sink = checks ? rasterizer::BatchSink{checked} : given;
    rasterize_sample(list, 0, needs, primitives, sink);
    for (std::size_t sample = 1; sample < shared_.samples; ++sample) {
        auto moved = [&, first = static_cast<std::uint32_t>(sample * shared_.pixels())](FragmentBatch& batch) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) batch.pixel[i] += first;
            sink(batch);
        };
        rasterize_sample(list, sample, needs, primitives, rasterizer::BatchSink{moved});
    }
}

// Without ranges all triangles are drawn.
void FragmentSource::rasterize_sample(const PreparedDraw& list, std::size_t sample, const FragmentNeeds& needs,
                                      std::span<const PrimitiveRange> primitives, rasterizer::BatchSink sink) {
    const rasterizer::Geometry& geometry = list.of_sample(sample);
    const auto triangles = triangles_of(list, sample);
    const rasterizer::DepthRequest depth = shared_.frame.key_request();
    if (primitives.empty()) rasterizer_->draw(geometry, triangles, depth, needs, sink);
    for (const PrimitiveRange& range : primitives)
        rasterizer_->draw(geometry, triangles_in(geometry, triangles, range), depth, needs, sink);
}

// The part of the region is divided into rows if the region is the whole frame, so that few fragments are joined at a
// time. Pixels are independent of one another, so a division changes nothing.
void FragmentSource::for_each_pixel_batch(const PreparedDraw& list, const PassState& state, const Rect& part,
                                          JoinedColors colors, const std::function<void(PixelBatch&)>& sink) {
    FragmentNeeds needs = pass_needs(state, needs_of_tile(list), Effects::needed);
    needs.code = needs.reference = true;
    PathTaken& taken = shared_.statistics.taken;
    if (shared_.statistics.counts && &list == shared_.frame.repeated()) {
        taken.rasterizes = true;
        if (taken.why_rasterized == nullptr) taken.why_rasterized = "a pass looks at all samples of a pixel together";
    }
    stages_.set_material(needs.color ? needs_of_tile(list) : MaterialNeeds{});
    if (joined_ == nullptr) joined_ = std::make_unique<PixelFragments>(shared_.rect());
    const auto shade = [&](FragmentBatch& batch, bool again) -> const Lanes<std::uint32_t>& {
        std::optional<UncountedWork> same;
        if (again) same.emplace(shared_.statistics);
        if (shared_.wraps_depths()) require_range(batch);
        Outputs& out = stages_.start_batch(batch);
        stages_.shade(list, batch, out);
        return out.alive;
    };
    const SamplesToJoin samples{list,
                                shared_.samples,
                                [&](std::size_t sample) { return triangles_of(list, sample); },
                                shared_.frame.key_request(),
                                needs,
                                colors,
                                shade};
    const int rows = shared_.is_frame() ? std::max(1, 4096 / part.width()) : part.height();
    for (int y = part.y0; y < part.y1; y += rows)
        join_samples(samples, {part.x0, y, part.x1, std::min(y + rows, part.y1)}, *joined_, sink);
}

// Codes outside the depth range are ordered differently from keys: if one occurs, the frame is drawn literally
// (pipeline/reference/execution.md 5.4).
void FragmentSource::require_range(const FragmentBatch& batch) const {
    const rasterizer::DepthFormat format = shared_.frame.key_request().format;
    const auto is_beyond = [&](std::uint32_t code) { return rasterizer::is_beyond_range(code, format); };
    if (!shared_.is_frame() && std::any_of(batch.code.begin(), batch.code.begin() + batch.count, is_beyond))
        throw NeedsFrame{};
}

// True if passes may read the record instead of rasterizing the list again.
bool FragmentSource::may_record(const PreparedDraw& list) const {
    return !shared_.is_frame() && shared_.frame.effects == Effects::needed &&
           shared_.instruments.once_more == Effect::none && shared_.frame.replay.bytes > 0 &&
           &list == shared_.frame.repeated();
}

// Records the values that all passes read before the first of them. Returns false if they do not fit or cannot be
// recorded.
bool FragmentSource::record(const PreparedDraw& list, const FragmentNeeds& needs) {
    TileFragments& fragments = shared_.scratch.fragments;
    if (fragments.serves(needs)) return true;
    const FragmentNeeds kept = needs | shared_.frame.replay.needs;
    if (!TileFragments::records(kept) || !fragments.may_start()) return false;
    fragments.start(kept, shared_.frame.replay.bytes);
    shared_.scratch.sorted.forget();
    shared_.scratch.other_sorted.forget();
    const MaterialNeeds& materials = needs_of_tile(list);
    if (rows_have(kept) && may_walk_rows(list) && materials == MaterialNeeds{} &&
        shared_.profile().raster.color == rasterizer::ColorInterpolation::exact_plane) {
        for (std::size_t sample = 0; sample < shared_.samples; ++sample) {
            const std::size_t first = fragments.size();
            shared_.statistics.fragments_drawn +=
                record_rows(fragments, list.of_sample(sample), triangles_of(list, sample), shared_.frame.key_request(),
                            shared_.rect());
            if (sample > 0) fragments.move_pixels(first, static_cast<std::uint32_t>(sample * shared_.pixels()));
        }
        fragments.finish();
        return fragments.serves(needs);
    }
    FragmentNeeds drawn = kept;
    drawn.color |= materials.color;
    add_needs_of_color(drawn, materials);
    auto sink = [&](FragmentBatch& batch) {
        Outputs& out = stages_.start_batch(batch);
        stages_.shade(list, batch, out);
        fragments.append(batch, out.alive);
    };
    const From before = std::exchange(from_, From::recording);
    rasterize(list, drawn, {}, rasterizer::BatchSink{sink});
    from_ = before;
    fragments.finish();
    return fragments.serves(needs);
}

// Passes all recorded fragments to the sink, in submission order.
void FragmentSource::visit_all(const FragmentNeeds& needs, rasterizer::BatchSink sink) {
    const From before = std::exchange(from_, From::record);
    FragmentBatch& batch = shared_.scratch.recorded;
    TileFragments::Reading& reading = shared_.scratch.reading;
    reading = {0, 0, std::move(reading.stamp)};
    reading.stamp.assign(shared_.elements(), 0);
    Lanes<std::uint32_t> places;
    for (auto next = shared_.scratch.fragments.next_indices(reading, places); !next.empty();
         next = shared_.scratch.fragments.next_indices(reading, places)) {
        batch.count = static_cast<int>(next.size());
        batch.material = 0;
        for (std::size_t i = 0; i < next.size(); ++i) batch.pixel[i] = shared_.scratch.fragments.pixel()[next[i]];
        find_positions(batch);
        shared_.scratch.fragments.fetch(next, needs, batch);
        sink(batch);
    }
    from_ = before;
}

// Decides whether the test against a cleared opaque depth can be skipped in this tile.
DepthOutcome FragmentSource::depth_outcome(const PassState& state, const PreparedDraw& list) const {
    using rasterizer::DepthPath;
    const bool is_plain = state.depth.enabled && state.depth.func == CompareFunc::less && !state.depth.write &&
                          state.depth_target == targets_.opaque_depth() && !state.stencil.enabled &&
                          state.depth_unit_count == 0 && !state.replaces_depth;
    const rasterizer::DepthRequest depth = shared_.frame.key_request();
    const bool has_bound = depth.path == DepthPath::float32 || depth.path == DepthPath::exact;
    if (!is_plain || !has_bound || shared_.wraps_depths() || state.needs.code || !targets_.opaque_depth_is_cleared() ||
        shared_.is_frame() || shared_.frame.effects == Effects::all || &list != shared_.frame.transparent)
        return DepthOutcome::open;
    double bound = 0;
    for (std::size_t sample = 0; sample < shared_.samples; ++sample)
        bound = std::max(bound, depth_bound(list.of_sample(sample), triangles_of(list, sample)));
    const auto code = [&](float z) { return to_depth_code(z, depth.format, shared_.profile().raster.depth_rounding); };
    return code(static_cast<float>(bound)) < code(1.0f) ? DepthOutcome::passes : DepthOutcome::open;
}

// Called in passes over a list that may be recorded.
void FragmentSource::note_rasterized(const PassState& state, const FragmentNeeds& needs) {
    PathTaken& taken = shared_.statistics.taken;
    taken.rasterizes = true;
    if (taken.why_rasterized != nullptr) return;
    taken.why_rasterized = shared_.frame.effects == Effects::all ? "--effects all simulates every effect in every pass"
                           : shared_.frame.replay.bytes == 0     ? "--fragment-memory 0 records nothing"
                           : !TileFragments::records(needs)
                               ? "a pass looks at texture coordinates or facing, which are not recorded"
                           : !state.primitives.empty() ? "a pass looks at all fragments of a part of the list"
                                                       : "a tile's fragments take more than --fragment-memory";
}

// A list that did not fit is rasterized in every pass.
void FragmentSource::for_each_batch(const PreparedDraw& list, const PassState& state, rasterizer::BatchSink sink) {
    const DepthOutcome depth = depth_outcome(state, list);
    stages_.set_depth(depth);
    const MaterialNeeds& materials = needs_of_tile(list);
    const FragmentNeeds needs =
        with_value(pass_needs(state, materials, shared_.frame.effects, depth), shared_.instruments.once_more);
    if (shared_.instruments.log_passes)
        shared_.statistics.pass_log.passes.push_back({state, needs, pass_needs(state, materials, Effects::needed),
                                                      needs.color && materials.texcoord, &list == shared_.frame.opaque,
                                                      shared_.statistics.iterations});
    FragmentNeeds looked_at = needs;
    looked_at.texcoord = state.needs.texcoord;  // for the program; colours are recorded as they are shaded
    looked_at.units = state.needs.units;
    looked_at.fog = state.needs.fog;
    looked_at.secondary = state.needs.secondary;
    if (may_record(list) && state.primitives.empty() && record(list, looked_at)) {
        shared_.statistics.taken.reads_record = true;
        visit_all(looked_at, sink);
    } else {
        if (shared_.statistics.counts && &list == shared_.frame.repeated()) note_rasterized(state, looked_at);
        rasterize(list, needs, state.primitives, sink);
    }
}

bool FragmentSource::record_sorted(const FragmentNeeds& needs) {
    const PreparedDraw& list = *shared_.frame.transparent;
    return may_record(list) && !shared_.frame.loads_others() && targets_.has_ordered_surface() && record(list, needs) &&
           sort_for({});
}

}  // namespace strata::pipeline
