// pipeline/region/executor.h - runs an algorithm over the frame's regions and puts the frame together.
//
// Rule     literal: one region, the frame; every pass rasterizes everything. It is the definition. tiled: one region a tile;
//          a tile guesses the frame's answers from its own counts, and runs again only where the frame decided otherwise and
//          the tile was not idle. replay: as tiled, and a tile rasterizes its transparent list once (region_replay.cpp). One
//          blank tile runs for all of its size, if the frame says that they are alike. Counters are literal's. A frame that
//          needs it whole (Frame::needs_frame, or a lookup that leaves its region) runs literally whatever was asked for.
// Source   execution.md 4, 5 and 8.
// Tests    tests/peeling/execution_test.cpp
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "pipeline/region/region.h"

namespace strata::pipeline {

using Body = std::function<void(Region&)>;  // once a region, never a fragment

// A region after its body: what the audit looks at.
struct RegionTrace {
    rasterizer::Rect rect;
    std::size_t tile = 0;
    std::vector<TraceEntry> entries;
};

struct Work {                     // what was really done; may differ by execution
    std::uint64_t fragments = 0;  // rasterized
    std::uint64_t regions = 0, reruns = 0;
    int tile_size = 0;
};

struct FrameResult {
    Image color;
    Image depth;  // nearest visible key, when asked for
    std::vector<KeptLayer> layers;
    int iterations = 0;
    PassCount passes;
    Counters counters;
    Work work;
    std::vector<Diagnostic> diagnostics;
    std::vector<RegionTrace> traces;
};

// `progress`, if any, is called now and then with the share done, from any thread.
[[nodiscard]] FrameResult run(const Frame& frame, const Body& body, Execution execution, int threads,
                              const std::function<void(double)>& progress = {});

}  // namespace strata::pipeline
