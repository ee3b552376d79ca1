// peeling/closed_form.h - peels whose whole course a pixel's sorted fragments decide: run pixel by pixel instead of pass by pass.
//
// Rule     A closed form leaves what its algorithm's passes would leave, ties included: the same codes, by the same stage
//          functions in the same order for every pixel, and the same counters, queries and trace. It offers itself: where it
//          does not apply it returns false and has touched nothing, and the passes run.
// Source   design.md, idea 2: "an algorithm may offer it to the executor".
// Tests    tests/peeling/execution_test.cpp, sequences_test.cpp: against literal execution
#pragma once
#include <vector>

#include "peeling/block_passes.h"
#include "peeling/programs.h"

namespace strata::peeling {

[[nodiscard]] bool dual_closed(pipeline::Region& region);
[[nodiscard]] bool front_to_back_closed(pipeline::Region& region);

// A query that every layer answers, and nothing that wants the layers one by one.
[[nodiscard]] inline bool peels_to_the_end(const pipeline::Frame& frame) {
    using pipeline::TerminationRule;
    const bool exact = frame.termination.rule == TerminationRule::exact || frame.termination.rule == TerminationRule::any;
    return frame.replay.bytes > 0 && exact && frame.max_passes == 0 && !frame.keep_layers;
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

// histogram[i] = how many pixels have exactly i of something; grows as needed.
inline void tally(std::vector<std::uint64_t>& histogram, std::size_t i, std::uint64_t times = 1) {
    if (histogram.size() <= i) histogram.resize(i + 1);
    histogram[i] += times;
}

}  // namespace strata::peeling
