// peeling/audit/region_trace.h - the traces of a whole frame, kept: for measurements that hold all of its fragments
// anyhow.
#pragma once
#include <vector>

#include "pipeline/frame/trace.h"
#include "pipeline/region/executor.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::peeling {

struct RegionTrace {
    rasterizer::Rect rect;
    std::vector<pipeline::TraceEntry> entries;  // pixels count in `rect`
};

// Keeps the traces of a frame's regions in `traces` while it runs; one, if it runs as a whole.
[[nodiscard]] pipeline::Watch keep_traces(std::vector<RegionTrace>& traces);

}  // namespace strata::peeling
