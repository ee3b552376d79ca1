// pipeline/region/region_shortcuts.h - what a fast way through a region needs: a way to the same bits that is not the
// machine's, in the machine's own statistics. The resolve of dual (peeling/loops), the kernels of rows and whole
// pixels, and the emulator's own looks.
//
// Rule     Nothing here is a pass, and nothing is counted unless `count_passes` says so: the caller statistics what the
//          passes that it replaces would have counted. An algorithm that is written as its paper says needs none of it.
// Tests    tests/peeling/execution_test.cpp: every fast way against literal execution
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

// A tile's fragments, and by pixel in the order of the frame's key.
struct SortedRecord {
    const TileFragments& fragments;
    const SortedLists& sorted;
};

class RegionShortcuts {
  public:
    explicit RegionShortcuts(Region& region) noexcept : region_{region} {}

    // `coverage[i]` += how many fragments pixel i of the region gets, before MASK.
    void count_coverage(std::span<std::uint32_t> coverage);
    // program(batch, outputs) for the list's fragments in `band`, a part of this region, after MASK; `pixel` counts row
    // by row from the band's first. Once the program answers false it sees no more, and so does the caller.
    template <class P>
    [[nodiscard]] bool look(const rasterizer::FragmentNeeds& needs, const rasterizer::Rect& band, P&& program);
    // What the tile draws of the list, with the values that `needs` names; nothing where that is not recorded or has no
    // order.
    [[nodiscard]] std::optional<SortedRecord> sorted_record(const rasterizer::FragmentNeeds& needs);

    // Every fragment of the transparent list in submission order, after MASK, before any test.
    [[nodiscard]] std::vector<CapturedFragment> capture(Counting counting);
    // Runs `work`, whose passes, clears and copies are the emulator's own: nothing counts them.
    template <class Work>
    void uncounted(Work&& work) {
        const UncountedWork own{region_.shared_.statistics};
        work();
    }

    // Words a pixel that the region's targets have by now, samples and all.
    [[nodiscard]] std::uint64_t target_words() const;
    void count_passes(const PassCount& passes);  // that something stood in for
    // Whether a whole loop was computed from the record: null, or why not, in a sentence.
    void note_resolved(const char* why_not) noexcept {
        region_.shared_.statistics.taken.is_resolved = why_not == nullptr;
        region_.shared_.statistics.taken.why_unresolved = why_not;
    }
    void count(const Counters& counters) noexcept { region_.shared_.count(counters); }
    [[nodiscard]] static Count query_of(std::uint64_t own) noexcept { return Count{own}; }
    [[nodiscard]] Trace& trace() noexcept;

    // An rgba8 target's codes: a word a pixel, red lowest, and spare_words behind the last.
    [[nodiscard]] Word* words(Target target) { return region_.targets_.at(target).depth_plane(0).words; }
    // Consecutive pixels, all channels, sample 0.
    void store_pixels(Target target, std::uint32_t first, int pixels, const ColorCodes& codes);
    // A pixel's colour, converted like a write without blending.
    void store_pixel(Target target, std::uint32_t pixel, const Rgba& color);

    // Depth of the nearest visible key: the frame's Z. Never counted.
    [[nodiscard]] Target nearest_depth();
    void write_image(Target target, Image& frame) const;  // into this region's index in an image of the frame

  private:
    void rasterize_band(rasterizer::FragmentNeeds needs, const rasterizer::Rect& band, rasterizer::BatchSink sink,
                        const bool& goes_on);

    Region& region_;
};

template <class P>
bool RegionShortcuts::look(const rasterizer::FragmentNeeds& needs, const rasterizer::Rect& band, P&& program) {
    const UncountedWork look{region_.shared_.statistics};
    bool goes_on = true;
    auto sink = [&](FragmentBatch& batch) {
        if (!goes_on) return;
        Outputs& out = region_.stages_.start_batch(batch);
        region_.stages_.shade(*region_.frame().transparent, batch, out);
        goes_on = program(static_cast<const FragmentBatch&>(batch), static_cast<const Outputs&>(out));
    };
    rasterize_band(needs, band, rasterizer::BatchSink{sink}, goes_on);
    return goes_on;
}

}  // namespace strata::pipeline
