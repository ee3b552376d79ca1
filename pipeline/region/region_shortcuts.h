// pipeline/region/region_shortcuts.h - access for optimized paths through a region, which compute the same bits without
// the device's passes and record them in the device's statistics: the resolve of dual peeling (peeling/loops), the
// kernels for rows and whole pixels, and the emulator's own queries.
//
// Rule     Nothing here is a pass, and nothing is counted except by `count_passes`: the caller records what the passes
//          that it replaces would have counted. An algorithm written as in its paper needs none of it.
// Tests    tests/peeling/execution/execution_test.cpp compares every optimized path with literal execution.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "pipeline/frame/captured_fragment.h"
#include "pipeline/region/region.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::pipeline {

class SortedLists;
class TileFragments;

// A tile's fragments, and their per-pixel lists in the order of the frame's key.
struct SortedRecord {
    const TileFragments& fragments;
    const SortedLists& sorted;
};

class RegionShortcuts {
  public:
    explicit RegionShortcuts(Region& region) noexcept : region_{region} {}

    // Adds to `coverage[i]` the number of fragments of element i of the region, before MASK.
    void count_coverage(std::span<std::uint32_t> coverage);
    // Calls program(batch, outputs) for a sample's fragments in `band`, a part of this region, after MASK; `pixel` is
    // relative to the band, row by row. Stops once the program returns false, and then returns false.
    template <class P>
    [[nodiscard]] bool visit_batches(const rasterizer::FragmentNeeds& needs, const rasterizer::Rect& band,
                                     std::size_t sample, P&& program);
    // Calls program(batch, outputs) for the fragments of a pass once a pixel in `band`, after its test. The pass is not
    // counted.
    template <class P>
    void visit_pixels(const PassState& state, const rasterizer::Rect& band, P&& program);
    // The tile's fragments of the list, with the values that `needs` names; empty if that is not recorded or not
    // sortable.
    [[nodiscard]] std::optional<SortedRecord> sorted_record(const rasterizer::FragmentNeeds& needs);

    // Every fragment of the transparent list in submission order, after MASK, before any test.
    [[nodiscard]] std::vector<CapturedFragment> capture(Counting counting);
    // Runs `work`, whose passes, clears and copies are the emulator's own and are not counted.
    template <class Work>
    void uncounted(Work&& work) {
        const UncountedWork own{region_.shared_.statistics};
        work();
    }

    // Words per pixel of the region's targets so far, including a target's own samples, for one sample of the frame.
    [[nodiscard]] std::uint64_t target_words() const;
    void count_passes(const PassCount& passes);  // passes that another computation replaced
    // Records whether a whole loop was computed from the record: null, or the reason why not, as text.
    void note_resolved(const char* why_not) noexcept {
        region_.shared_.statistics.taken.is_resolved = why_not == nullptr;
        region_.shared_.statistics.taken.why_unresolved = why_not;
    }
    void count(const Counters& counters) noexcept { region_.shared_.count(counters); }
    [[nodiscard]] static Count query_of(std::uint64_t own) noexcept { return Count{own}; }
    [[nodiscard]] Trace& trace() noexcept;

    // An rgba8 target's codes: one word per pixel, red in the lowest byte, followed by spare_words.
    [[nodiscard]] Word* words(Target target) { return region_.targets_.at(target).depth_plane(0).words; }
    // Writes consecutive elements, all channels, sample 0 of the target's own.
    void store_pixels(Target target, std::uint32_t first, int pixels, const ColorCodes& codes);
    // Writes a pixel's colour, converted like a write without blending.
    void store_pixel(Target target, std::uint32_t pixel, const Rgba& color);

    // The depth of the nearest visible key: the frame's depth image. Never counted.
    [[nodiscard]] Target nearest_depth();
    // Writes a sample of a target into this region's rectangle of an image of the frame.
    void write_image(Target target, std::size_t sample, Image& frame) const;

  private:
    void rasterize_band(rasterizer::FragmentNeeds needs, const rasterizer::Rect& band, std::size_t sample,
                        rasterizer::BatchSink sink, const bool& goes_on);

    Region& region_;
};

template <class P>
bool RegionShortcuts::visit_batches(const rasterizer::FragmentNeeds& needs, const rasterizer::Rect& band,
                                    std::size_t sample, P&& program) {
    const UncountedWork look{region_.shared_.statistics};
    bool goes_on = true;
    auto sink = [&](FragmentBatch& batch) {
        if (!goes_on) return;
        Outputs& out = region_.stages_.start_batch(batch);
        region_.stages_.shade(*region_.frame().transparent, batch, out);
        goes_on = program(static_cast<const FragmentBatch&>(batch), static_cast<const Outputs&>(out));
    };
    rasterize_band(needs, band, sample, rasterizer::BatchSink{sink}, goes_on);
    return goes_on;
}

template <class P>
void RegionShortcuts::visit_pixels(const PassState& state, const rasterizer::Rect& band, P&& program) {
    const UncountedWork look{region_.shared_.statistics};
    DrawCounts drawn;
    region_.source_.for_each_pixel_batch(*region_.frame().transparent, state, band, JoinedColors::once,
                                         [&](PixelBatch& pixels) {
                                             const Outputs& out = region_.stages_.test_pixels(state, pixels, drawn);
                                             program(static_cast<const FragmentBatch&>(pixels.batch), out);
                                         });
}

}  // namespace strata::pipeline
