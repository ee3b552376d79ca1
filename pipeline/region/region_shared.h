// pipeline/region/region_shared.h - what the parts of a region share while it runs: its area, its statistics and its
// instruments.
//
// Rule     Targets own the render targets; stages pass batches through the fragment operations; source provides the
//          fragments; loop makes queries and ends the loop. Each part uses only the parts before it in the order
//          targets, stages, source; loop is independent of them. Region (region.h) contains all of them.
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
    RegionArea area;
    RegionStatistics& statistics;
    Instruments instruments;
    RegionScratch& scratch;                                           // the arrays through which a batch passes
    Region& region;                                                   // for observers and alterations of its steps
    std::size_t samples = static_cast<std::size_t>(frame.samples());  // of a pixel

    [[nodiscard]] const DeviceProfile& profile() const noexcept { return *frame.profile; }
    [[nodiscard]] rasterizer::Rect rect() const noexcept { return area.rect; }
    // Element sample * pixels() + pixel of a target is that sample of a pixel; with one sample, an element is a pixel.
    [[nodiscard]] std::size_t pixels() const noexcept { return area.rect.area(); }
    [[nodiscard]] std::size_t elements() const noexcept { return samples * pixels(); }
    // Literal execution: the frame is one region.
    [[nodiscard]] bool is_frame() const noexcept { return area.extent == Extent::frame; }
    // True if depths outside the depth range have codes (rasterizer/reference/depth.md 2.9).
    [[nodiscard]] bool wraps_depths() const noexcept {
        return profile().raster.depth_limits == rasterizer::DepthLimits::wrap;
    }
    // True if an effect that changes nothing is to be simulated.
    [[nodiscard]] bool runs_extra(Effect effect, bool is_called_for) const noexcept {
        return instruments.once_more == effect || (frame.effects == Effects::all && !is_called_for);
    }
    // Null if the next step is not altered.
    [[nodiscard]] const Alteration* alteration() const noexcept {
        return statistics.counts ? instruments.alteration : nullptr;
    }
    // Counts the device's work; the emulator's own work is not counted.
    void count(const Counters& counters) const noexcept {
        if (statistics.counts) statistics.counters += counters;
    }
    void count_pass(const PassCount& passes) const noexcept {
        if (statistics.counts) statistics.loops.back().passes += passes;
    }
    void show(StepEvent event) const {  // reports to the observer, if there is one
        if (instruments.observer == nullptr || !instruments.observer->step) return;
        event.is_counted = statistics.counts;
        event.iteration = statistics.iterations;
        instruments.observer->step(region, event);
    }
    void trace(const TraceEntry& entry) const;  // and reports it
    // Diagnostics refer to pixels of the window, not of the region: `elements` are affected, the first of their pixels
    // has region index `first_pixel`.
    void report(Fault fault, std::uint64_t elements, std::uint32_t first_pixel, std::string detail) const;
    [[nodiscard]] std::uint32_t pixel_of(std::uint32_t element) const noexcept {
        return element % static_cast<std::uint32_t>(pixels());
    }
};

}  // namespace strata::pipeline
