// peeling/closed_form.h - peels whose whole course a pixel's sorted fragments decide: run pixel by pixel instead of pass by pass.
//
// Rule     A closed form leaves what its algorithm's passes would leave, ties included: the same codes, by the same stage
//          functions in the same order for every pixel, and the same counters, queries and trace. It offers itself: where it
//          does not apply it returns false and has touched nothing, and the passes run.
// Source   design.md, idea 2: "an algorithm may offer it to the executor".
// Tests    tests/peeling/execution_test.cpp, sequences_test.cpp: against literal execution
#pragma once
#include <vector>

#include "peeling/columns.h"
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

// Neighbouring pixels of a band that are blended side by side: as many as a batch has lanes.
struct PixelGroup {
    std::size_t first = 0;  // in the band
    int count = 0;
};

template <class Visit>
void for_each_group(const Columns& columns, Visit&& visit) {
    for (std::size_t first = 0; first < columns.pixels(); first += pipeline::batch_capacity)
        visit(PixelGroup{first, static_cast<int>(std::min<std::size_t>(columns.pixels() - first, pipeline::batch_capacity))});
}

// histogram[i] = how many pixels have exactly i of something; grows as needed.
inline void tally(std::vector<std::uint64_t>& histogram, std::size_t i, std::uint64_t times = 1) {
    if (histogram.size() <= i) histogram.resize(i + 1);
    histogram[i] += times;
}

}  // namespace strata::peeling
