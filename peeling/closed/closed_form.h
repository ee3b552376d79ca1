// peeling/closed/closed_form.h - peels whose whole course a pixel's sorted fragments decide: run pixel by pixel instead of pass by pass.
//
// Rule     A closed form leaves what its algorithm's passes would leave, ties included: the same codes, by the same
//          stage functions in the same order for every pixel, and the same counters, queries and trace. It is tried
//          before them; where it does not apply it returns false, has counted nothing, and the passes run.
// Source   algorithms.md 0.7.
// Tests    tests/peeling/execution_test.cpp, sequences_test.cpp: against literal execution
#pragma once
#include <vector>

#include "peeling/closed/block_passes.h"
#include "peeling/programs/programs.h"
#include "pipeline/frame/frame.h"

namespace strata::peeling {

[[nodiscard]] bool dual_closed(pipeline::Region& region);
[[nodiscard]] bool front_to_back_closed(pipeline::Region& region);

// True if the frame is peeled to its end: every layer answers the query, all passes see the same depth of a fragment,
// the caller keeps no single layers, and the device rounds 8-bit codes once. A closed form declines every other frame, and one without memory for
// fragments.
[[nodiscard]] inline bool peels_to_the_end(const pipeline::Frame& frame) {
    using pipeline::TerminationRule;
    const bool exact =
        frame.termination.rule == TerminationRule::exact || frame.termination.rule == TerminationRule::any;
    return frame.profile->rounds_codes_once() && frame.is_invariant() && frame.replay.bytes > 0 && exact &&
           frame.max_passes == 0 && !frame.keep_layers;
}

// The pixels of a block whose columns hold a depth twice, or all of them.
struct BlockPixels {
    std::array<std::size_t, block_lanes> lane;
    std::size_t count = 0;
};
[[nodiscard]] inline BlockPixels pixels_of(const ColumnBlock& block, bool tied_alone) {
    BlockPixels pixels{};
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane)
        if (!tied_alone || block.has_ties[lane] != 0) pixels.lane[pixels.count++] = lane;
    return pixels;
}

}  // namespace strata::peeling
