// pipeline/region/executor.h - runs an algorithm over the frame's regions and assembles the frame.
//
// Rule     literal: one region, the frame; every pass rasterizes everything. It is the definition. replay: one region
//          per tile. A tile guesses the frame's answers to queries from its own counts; it runs again only if the frame
//          decided otherwise and the tile was not idle. Within the limit of fragment memory, a tile rasterizes its
//          transparent list once (region_source.cpp); without memory every pass rasterizes. Of all tiles without
//          triangles, one of each size runs for the others of that size, if the frame promises that their results are
//          equal (Frame::blank_tiles_are_equal). Counters are those of literal execution. A frame that needs to be
//          whole (Frame::needs_frame, or a lookup that leaves its region) runs literally, whatever was requested.
// Source   pipeline/reference/execution.md 4, 5 and 8.
// Tests    tests/peeling/execution/execution_test.cpp
#pragma once
#include <functional>
#include <span>

#include "pipeline/frame/frame_result.h"
#include "pipeline/frame/instruments.h"
#include "pipeline/frame/region_area.h"
#include "pipeline/frame/run_settings.h"

namespace strata::pipeline {

struct Frame;
class Region;

using Body = std::function<void(Region&)>;  // called once per region, never per fragment

// Inspects regions while their targets and traces exist, from any thread. If a region runs again, it is inspected again
// and the earlier result is void; if the frame runs again as a whole, all earlier results are void.
struct RegionCallbacks {
    // The regions that will run: tiles and parts of tiles, or the frame. The other functions refer to them by index.
    std::function<void(std::span<const RegionArea>)> begun{};
    // Region `region` has ended, and its part of the pictures of `result` is written.
    std::function<void(Region&, std::size_t region, const FrameResult& result)> ended{};
    // Region `region` is blank and did not run: its result is that of region `like`, which has the same size.
    std::function<void(std::size_t like, std::size_t region)> alike{};
};

// `progress`, unless empty, is called occasionally with the fraction done, from any thread.
[[nodiscard]] FrameResult run(const Frame& frame, const Body& body, Execution execution, int threads,
                              const std::function<void(double)>& progress = {}, const Instruments& instruments = {},
                              const RegionCallbacks& callbacks = {});

}  // namespace strata::pipeline
