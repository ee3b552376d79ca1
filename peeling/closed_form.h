// peeling/closed_form.h - peels whose whole course a pixel's sorted fragments decide: run pixel by pixel instead of pass by pass.
//
// Rule     A closed form leaves what its algorithm's passes would leave, ties included: the same codes, by the same stage
//          functions in the same order for every pixel, and the same counters, queries and trace. It offers itself: where it
//          does not apply it returns false and has counted nothing, and the passes run.
// Source   design.md, idea 2: "an algorithm may offer it to the executor".
// Tests    tests/peeling/execution_test.cpp, sequences_test.cpp: against literal execution
#pragma once
#include <algorithm>
#include <vector>

#include "peeling/block_passes.h"
#include "peeling/programs.h"
#include "pipeline/arena.h"

namespace strata::peeling {

[[nodiscard]] bool dual_closed(pipeline::Region& region);
[[nodiscard]] bool front_to_back_closed(pipeline::Region& region);

// A query that every layer answers, passes that see one depth of a fragment, and nothing that wants the layers one by one.
[[nodiscard]] inline bool peels_to_the_end(const pipeline::Frame& frame) {
    using pipeline::TerminationRule;
    const bool exact = frame.termination.rule == TerminationRule::exact || frame.termination.rule == TerminationRule::any;
    return frame.is_invariant() && frame.replay.bytes > 0 && exact && frame.max_passes == 0 && !frame.keep_layers;
}

// A block of a band for block_passes.h; its targets' codes are the caller's.
[[nodiscard]] inline PeelBlock peel_block(const Columns& columns, std::size_t number) {
    const ColumnBlock& place = columns.blocks[number];
    PeelBlock block;
    block.order = columns.order.data() + place.first;
    for (std::size_t c = 0; c < 4; ++c) block.color[c] = columns.color[c].data() + place.first;
    std::copy_n(&columns.visible[number * block_lanes], block_lanes, block.visible.begin());
    std::copy_n(&columns.alive[number * block_lanes], block_lanes, block.alive.begin());
    block.depth = place.depth;
    return block;
}

// Neighbouring pixels of a band, at most a block.
struct PixelGroup {
    std::size_t first = 0;  // in the band
    int count = 0;
};

// visit(block number, its pixels)
template <class Visit>
void for_each_block(const Columns& columns, Visit&& visit) {
    for (std::size_t b = 0; b < columns.blocks.size(); ++b) {
        const std::size_t first = b * block_lanes;
        visit(b, PixelGroup{first, static_cast<int>(std::min(columns.pixels() - first, block_lanes))});
    }
}

// A colour target's codes while its pixels are worked on: by channel, then by pixel of the region, room for a whole last block.
class CodePlanes {
  public:
    CodePlanes(pipeline::Region& region, pipeline::Target initial) : region_{region}, pixels_{region.rect().area()} {
        for (auto& channel : codes_) {
            channel = region.arena().take<std::uint32_t>(pixels_ + block_lanes);
            std::ranges::fill(channel.subspan(pixels_), 0u);  // blended like the others, and looked at by nobody
        }
        pipeline::ColorCodes batch;
        for_each_batch([&](std::size_t first, int count) {
            region_.load_pixels(initial, static_cast<std::uint32_t>(first), count, batch);
            for (std::size_t c = 0; c < 4; ++c) std::copy_n(batch[c].begin(), count, codes_[c].data() + first);
        });
    }

    // Sixteen pixels from `first` on; those beyond the region's end are nobody's.
    void load(std::size_t first, BlockCodes& block) const {
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes_[c].data() + first, block_lanes, block[c].begin());
    }
    void store(std::size_t first, int count, const BlockCodes& block) {
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(block[c].begin(), count, codes_[c].data() + first);
    }
    void write_to(pipeline::Target target) const {
        pipeline::ColorCodes batch;
        for_each_batch([&](std::size_t first, int count) {
            for (std::size_t c = 0; c < 4; ++c) std::copy_n(codes_[c].data() + first, count, batch[c].begin());
            region_.store_pixels(target, static_cast<std::uint32_t>(first), count, batch);
        });
    }

  private:
    void for_each_batch(auto&& visit) const {
        for (std::size_t first = 0; first < pixels_; first += pipeline::batch_capacity)
            visit(first, static_cast<int>(std::min<std::size_t>(pixels_ - first, pipeline::batch_capacity)));
    }

    pipeline::Region& region_;
    std::size_t pixels_;
    std::array<std::span<std::uint32_t>, 4> codes_;
};

// histogram[i] = how many pixels have exactly i of something; grows as needed.
inline void tally(std::vector<std::uint64_t>& histogram, std::size_t i, std::uint64_t times = 1) {
    if (histogram.size() <= i) histogram.resize(i + 1);
    histogram[i] += times;
}

}  // namespace strata::peeling
