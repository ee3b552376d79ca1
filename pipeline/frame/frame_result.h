// pipeline/frame/frame_result.h - what a run leaves: the picture, what was counted, and what the audit and the
// instruments asked for.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/region_statistics.h"

namespace strata::pipeline {

struct Work {                     // what was really done; may differ by execution
    std::uint64_t fragments = 0;  // rasterized
    std::uint64_t visited = 0;    // by programs of geometry passes, in the last run of every region
    std::uint64_t regions = 0, reruns = 0;
    int tile_size = 0;
    Path path = Path::literal;  // the slowest of all regions
    std::string why;            // not a faster one; empty where there is none
};

struct FrameResult {
    Image color;
    Image depth;  // nearest visible key, when asked for
    std::vector<KeptLayer> layers;
    int iterations = 0;
    PassCount passes;
    std::optional<Counters> counters;  // of literal execution alone
    Work work;
    std::vector<Diagnostic> diagnostics;
    Answers answers;     // to the frame's queries: a script for running a part of it again
    double watched = 0;  // the watch's share of the time that was spent in regions
    PassLog pass_log;    // where Instruments ask for it
};

}  // namespace strata::pipeline
