// pipeline/region/region_shortcuts.cpp - access to a region's fragments outside its passes, and target words for
// kernels (pipeline/reference/execution.md 7). Such access is not a pass and is not counted.
#include "pipeline/region/region_shortcuts.h"

#include <algorithm>
#include <numeric>

#include "pipeline/formats/image_texels.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region_scratch.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

Trace& RegionShortcuts::trace() noexcept { return region_.scratch_->trace; }

void RegionShortcuts::count_coverage(std::span<std::uint32_t> coverage) {
    constexpr FragmentNeeds nothing{false, false, false, false, false, false};
    const Frame& frame = region_.frame();
    for (std::size_t sample = 0; sample < region_.shared_.samples; ++sample) {
        auto add = [&, first = sample * region_.rect().area()](FragmentBatch& batch) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) ++coverage[first + batch.pixel[i]];
        };
        region_.source_.rasterizer().draw(frame.transparent->of_sample(sample),
                                          region_.source_.triangles_of(*frame.transparent, sample), frame.key_request(),
                                          nothing, rasterizer::BatchSink{add});
    }
}

// Coverage is counted first, before MASK, so that the list is allocated once and not moved while it grows.
std::vector<CapturedFragment> RegionShortcuts::capture(Counting counting) {
    std::optional<UncountedWork> look;
    if (counting == Counting::silent) look.emplace(region_.shared_.statistics);
    std::uint64_t fragments = 0;
    std::vector<std::uint32_t> coverage(region_.elements());
    count_coverage(coverage);
    for (const std::uint32_t of_pixel : coverage) fragments += of_pixel;
    std::vector<CapturedFragment> all;
    all.reserve(fragments);
    PassState state;
    state.needs = {
        .shader_z = true, .code = true, .exact_code = true, .color = true, .texcoord = false, .facing = false};
    const auto pixels = static_cast<std::uint32_t>(region_.rect().area());
    static_cast<void>(region_.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            if (out.alive[i] == 0) continue;
            all.push_back({in.pixel[i] % pixels,
                           in.primitive[i],
                           in.code[i],
                           in.exact_code[i],
                           in.shader_z[i],
                           {in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]},
                           in.pixel[i] / pixels});
        }
    }));
    return all;
}

// Each part has twice as many triangles as the previous one. A program that needs little can stop early, and few
// batches end early.
void RegionShortcuts::rasterize_band(FragmentNeeds needs, const rasterizer::Rect& band, std::size_t sample,
                                     rasterizer::BatchSink sink, const bool& goes_on) {
    const PreparedDraw& list = *region_.frame().transparent;
    const MaterialNeeds& materials = region_.source_.needs_of_tile(list);
    needs.color |= materials.color;  // MASK decides which fragments exist
    add_needs_of_color(needs, materials);
    region_.stages_.set_material(needs.color ? materials : MaterialNeeds{});
    rasterizer::TileRasterizer rows{band};
    auto triangles = region_.source_.triangles_of(list, sample);
    for (std::size_t part = 64; goes_on && !triangles.empty(); part *= 2) {
        part = std::min(part, triangles.size());
        rows.draw(list.of_sample(sample), triangles.first(part), region_.frame().key_request(), needs, sink);
        triangles = triangles.subspan(part);
    }
}

std::optional<SortedRecord> RegionShortcuts::sorted_record(const FragmentNeeds& needs) {
    if (!region_.source_.record_sorted(needs)) return std::nullopt;
    return SortedRecord{region_.scratch_->fragments, region_.scratch_->sorted};
}

// LESS with a write over a copy of the opaque depth, in the form of the algorithm's key (execution.md 9).
Target RegionShortcuts::nearest_depth() {
    const UncountedWork look{region_.shared_.statistics};
    const Target nearest = region_.make_depth();
    region_.copy(region_.opaque_depth(), nearest);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = nearest;
    state.needs = {
        .shader_z = false, .code = true, .exact_code = false, .color = false, .texcoord = false, .facing = false};
    static_cast<void>(region_.draw_depth(state));
    return nearest;
}

void RegionShortcuts::store_pixel(Target target, std::uint32_t pixel, const Rgba& color) {
    TargetStorage& to = region_.targets_.at(target);
    const auto codes = color_codes(to.format(), region_.profile().color_rounding(), color);
    RegionScratch& s = *region_.scratch_;
    Lanes<std::uint32_t>& index = s.depth_stored;  // only its first lane is used
    index[0] = pixel;
    s.alive[0] = ~0u;
    for (std::size_t c = 0; c < 4; ++c) s.codes[c][0] = codes[c];
    to.scatter(index, s.alive, 1, 0, 0xfu, s.codes);
}

std::uint64_t RegionShortcuts::target_words() const {
    std::uint64_t words = 0;
    for (const TargetStorage& storage : region_.targets_.all()) {
        const std::size_t stencil = storage.format() == Format::d24s8 ? 1 : 0;
        words += static_cast<std::uint64_t>(storage.samples()) * (storage.texels(0).words() + stencil);
    }
    return words;
}

// Geometry passes also count for limit_reached, like the passes that they replace.
void RegionShortcuts::count_passes(const PassCount& passes) {
    region_.shared_.count_pass(passes);
    region_.shared_.statistics.geometry_passes += passes.geometry;
    if (passes.full_screen > 0) region_.shared_.show(StepEvent{.step = Step::full_screen});
}

void RegionShortcuts::store_pixels(Target target, std::uint32_t first, int pixels, const ColorCodes& codes) {
    RegionScratch& s = *region_.scratch_;
    std::iota(s.screen.pixel.begin(), s.screen.pixel.begin() + pixels, first);
    std::fill_n(s.alive.begin(), pixels, ~0u);
    region_.targets_.at(target).scatter(s.screen.pixel, s.alive, pixels, 0, 0xfu, codes);
}

void RegionShortcuts::write_image(Target target, std::size_t sample, Image& frame) const {
    const rasterizer::Rect& whole = region_.frame().rect();
    const rasterizer::Rect own = region_.rect();
    for (int y = 0; y < own.height(); ++y)
        region_.targets_.read_row(target, y, &frame.codes[frame.index(own.x0 - whole.x0, own.y0 - whole.y0 + y)],
                                  sample);
    finish_words();
}

}  // namespace strata::pipeline
