// pipeline/region/executor.h - runs an algorithm over the frame's regions and puts the frame together.
//
// Rule     literal: one region, the frame; every pass rasterizes everything. It is the definition. replay: one region a
//          tile; a tile guesses the frame's answers from its own counts, and runs again only where the frame decided
//          otherwise and the tile was not idle. As far as fragment memory reaches, a tile rasterizes its transparent
//          list once (region_source.cpp); without memory every pass rasterizes. One blank tile runs for all of its
//          size, if the frame says that they are alike. Counters are literal's. A frame that needs it whole
//          (Frame::needs_frame, or a lookup that leaves its region) runs literally whatever was asked for.
// Source   execution.md 4, 5 and 8.
// Tests    tests/peeling/execution_test.cpp
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

using Body = std::function<void(Region&)>;  // once a region, never a fragment

// Looks at regions while their targets and traces are there, from any thread. A region that runs again is looked at
// again, and what was seen before is void; so is all of it if the frame is run again as a whole.
struct Watch {
    // The regions that will run: tiles and parts of tiles, or the frame. Other functions name them by their number.
    std::function<void(std::span<const RegionArea>)> begun{};
    // Region number `region` has ended, and its part of `color` is written.
    std::function<void(Region&, std::size_t region, const Image& color)> ended{};
    // Region `region` is blank, and did not run: it left what region `like`, of the same size, left.
    std::function<void(std::size_t like, std::size_t region)> alike{};
};

// `progress`, if any, is called now and then with the share done, from any thread.
[[nodiscard]] FrameResult run(const Frame& frame, const Body& body, Execution execution, int threads,
                              const std::function<void(double)>& progress = {}, const Instruments& instruments = {},
                              const Watch& watch = {});

}  // namespace strata::pipeline
