// pipeline/region/region_shortcuts.cpp - looks at a region's fragments beside its passes, and words of targets lent to
// kernels (execution.md 7). A look is no pass: the counters do not see it.
#include "pipeline/region/region_shortcuts.h"

#include <algorithm>
#include <numeric>

#include "pipeline/formats/image_words.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region_scratch.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

void RegionShortcuts::count_coverage(std::span<std::uint32_t> coverage) {
    constexpr FragmentNeeds nothing{false, false, false, false, false, false};
    auto add = [&](FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) ++coverage[batch.pixel[i]];
    };
    const Frame& frame = region_.frame_;
    const rasterizer::Geometry& geometry = frame.transparent->geometry;
    region_.rasterizer_->draw(geometry, region_.triangles_of(*frame.transparent), frame.key_request(), nothing,
                              rasterizer::BatchSink{add});
}

// Each part has twice as many triangles as the one before. A program that soon has enough is asked soon, and few
// batches end early.
void RegionShortcuts::rasterize_band(FragmentNeeds needs, const rasterizer::Rect& band, rasterizer::BatchSink sink,
                                     const bool& goes_on) {
    const PreparedDraw& list = *region_.frame_.transparent;
    const MaterialNeeds& materials = region_.needs_of_tile(list);
    needs.color |= materials.color;  // MASK decides which fragments there are
    needs.texcoord |= materials.texcoord && needs.color;
    region_.samples_textures_ = needs.texcoord;
    region_.takes_shadow_ = needs.color && list.needs.shadow != 0;
    if (region_.takes_shadow_) needs.units |= list.needs.shadow;
    rasterizer::TileRasterizer rows{band};
    auto triangles = region_.triangles_of(list);
    for (std::size_t part = 64; goes_on && !triangles.empty(); part *= 2) {
        part = std::min(part, triangles.size());
        rows.draw(list.geometry, triangles.first(part), region_.frame_.key_request(), needs, sink);
        triangles = triangles.subspan(part);
    }
}

std::optional<SortedRecord> RegionShortcuts::sorted_record(const FragmentNeeds& needs) {
    const PreparedDraw& list = *region_.frame_.transparent;
    if (!region_.may_record(list) || !region_.has_ordered_surface() || !region_.record(list, needs) ||
        !region_.sort_for({}))
        return std::nullopt;
    return SortedRecord{region_.scratch_->fragments, region_.scratch_->sorted};
}

// LESS with a write over a copy of the opaque depth, in the form of the algorithm's key (execution.md 9).
Target RegionShortcuts::nearest_depth() {
    const UncountedWork look{region_.books_};
    const Target nearest = region_.make_depth();
    region_.copy(region_.opaque_depth_, nearest);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = nearest;
    state.needs = {
        .shader_z = false, .code = true, .exact_code = false, .color = false, .texcoord = false, .facing = false};
    static_cast<void>(region_.draw_depth(state));
    return nearest;
}

void RegionShortcuts::store_pixel(Target target, std::uint32_t pixel, const Rgba& color) {
    TargetStorage& to = region_.at(target);
    const auto codes = color_codes(to.format(), region_.profile().color_rounding(), color);
    RegionScratch& s = *region_.scratch_;
    Lanes<std::uint32_t>& index = s.depth_stored;  // one lane of it
    index[0] = pixel;
    s.alive[0] = ~0u;
    for (std::size_t c = 0; c < 4; ++c) s.codes[c][0] = codes[c];
    to.scatter(index, s.alive, 1, 0, 0xfu, s.codes);
}

std::uint64_t RegionShortcuts::target_words() const {
    std::uint64_t words = 0;
    for (const TargetStorage& storage : region_.storages_) {
        const std::size_t stencil = storage.format() == Format::d24s8 ? 1 : 0;
        words += static_cast<std::uint64_t>(storage.samples()) * (storage.texels(0).words() + stencil);
    }
    return words;
}

// Geometry passes also count for limit_reached, as the passes that are replaced would have.
void RegionShortcuts::book(const PassCount& passes) {
    region_.count_pass(passes);
    region_.books_.geometry_passes += passes.geometry;
    if (passes.full_screen > 0) region_.show(StepEvent{.step = Step::full_screen});
}

void RegionShortcuts::store_pixels(Target target, std::uint32_t first, int pixels, const ColorCodes& codes) {
    RegionScratch& s = *region_.scratch_;
    std::iota(s.screen.pixel.begin(), s.screen.pixel.begin() + pixels, first);
    std::fill_n(s.alive.begin(), pixels, ~0u);
    region_.at(target).scatter(s.screen.pixel, s.alive, pixels, 0, 0xfu, codes);
}

void RegionShortcuts::write_image(Target target, Image& frame) const {
    const rasterizer::Rect& whole = region_.frame_.rect();
    const rasterizer::Rect& own = region_.rect_;
    for (int y = 0; y < own.height(); ++y)
        region_.read_row(region_.storage(target), y,
                         &frame.codes[frame.index(own.x0 - whole.x0, own.y0 - whole.y0 + y)]);
    finish_words();
}

}  // namespace strata::pipeline
