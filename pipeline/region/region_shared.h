// pipeline/region/region_shared.h - what the parts of a region share while it runs: its place, its statistics, and who
// watches.
//
// Rule     Targets hold render targets, stages take batches through a pass, source says where its fragments come from,
//          loop asks and stops. Each looks at those before it alone: targets, stages, source; loop beside them. Region
//          (region.h) has them all.
// Tests    tests/pipeline/region/region_test.cpp
#pragma once
#include <cstddef>

#include "pipeline/frame/alteration.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/instruments.h"
#include "pipeline/frame/observer.h"
#include "pipeline/frame/region_area.h"
#include "pipeline/frame/region_statistics.h"
#include "pipeline/frame/trace.h"

namespace strata::pipeline {

class Region;
struct RegionScratch;

struct RegionShared {
    const Frame& frame;
    RegionArea place;
    RegionStatistics& statistics;
    Instruments instruments;
    RegionScratch& scratch;  // the arrays that a batch passes through
    Region& region;          // for those who watch or alter its steps

    [[nodiscard]] const DeviceProfile& profile() const noexcept { return *frame.profile; }
    [[nodiscard]] rasterizer::Rect rect() const noexcept { return place.rect; }
    // Literal execution: the frame is one region.
    [[nodiscard]] bool is_frame() const noexcept { return place.extent == Extent::frame; }
    // Whether depths beyond the range have codes of their own (depth.md 2.9).
    [[nodiscard]] bool wraps_depths() const noexcept {
        return profile().raster.depth_limits == rasterizer::DepthLimits::wrap;
    }
    // Whether to simulate an effect that changes nothing.
    [[nodiscard]] bool idles(Effect effect, bool is_called_for) const noexcept {
        return instruments.once_more == effect || (frame.effects == Effects::all && !is_called_for);
    }
    // Null where the next step is to be taken as it is.
    [[nodiscard]] const Alteration* alteration() const noexcept {
        return statistics.counts ? instruments.alteration : nullptr;
    }
    // What the machine does; the emulator's own work is not counted.
    void count(const Counters& counters) const noexcept {
        if (statistics.counts) statistics.counters += counters;
    }
    void count_pass(const PassCount& passes) const noexcept {
        if (statistics.counts) statistics.loops.back().passes += passes;
    }
    void show(StepEvent event) const {  // to the observer, if there is one
        if (instruments.observer == nullptr || !instruments.observer->step) return;
        event.is_counted = statistics.counts;
        event.iteration = statistics.iterations;
        instruments.observer->step(region, event);
    }
    void trace(const TraceEntry& entry) const;  // and shows it
    // Diagnostics name pixels of the window, not of the region: `pixels` of it, the first of them at region index
    // `first_pixel`.
    void report(Fault fault, std::uint64_t pixels, std::uint32_t first_pixel, std::string detail) const;
};

}  // namespace strata::pipeline
