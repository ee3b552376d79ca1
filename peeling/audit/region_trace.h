// peeling/audit/region_trace.h - keeps the traces of a whole frame, for measurements that keep all fragments in memory
// anyway.
#pragma once
#include <vector>

#include "pipeline/frame/trace.h"
#include "pipeline/region/executor.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::peeling {

struct RegionTrace {
    rasterizer::Rect rect;
    std::vector<pipeline::TraceEntry> entries;  // `pixel` is an element: sample * rect.area() + pixel of `rect`
};

// Keeps the traces of a frame's regions in `traces` while it runs: one per region, or a single one if the frame runs as
// a whole.
[[nodiscard]] pipeline::RegionCallbacks keep_traces(std::vector<RegionTrace>& traces);

}  // namespace strata::peeling
