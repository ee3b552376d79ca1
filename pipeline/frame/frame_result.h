// pipeline/frame/frame_result.h - the result of a run: images, counts, and the data that the audit and the instruments
// request.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/region_statistics.h"

namespace strata::pipeline {

struct Work {                     // work actually done; may depend on the execution
    std::uint64_t fragments = 0;  // rasterized
    std::uint64_t visited = 0;    // by programs of geometry passes, in the last run of every region
    std::uint64_t regions = 0, reruns = 0;
    int tile_size = 0;
    Path path = Path::literal;  // the slowest path of all regions
    std::string why;            // why no faster path was taken; empty if there is none
};

struct FrameResult {
    Image color;                 // resolved, if a pixel has several samples
    std::vector<Image> samples;  // the picture of every sample, if the frame keeps them and has several
    Image depth;                 // nearest visible key, if requested
    std::vector<PeeledLayer> layers;
    int iterations = 0;
    PassCount passes;
    std::optional<Counters> counters;  // only from literal execution
    Work work;
    std::vector<Diagnostic> diagnostics;
    Answers answers;     // to the frame's queries: a script for repeating a part of the frame
    double watched = 0;  // the share of the time spent in regions that Watch took
    PassLog pass_log;    // if Instruments request it
};

}  // namespace strata::pipeline
