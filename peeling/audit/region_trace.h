// peeling/audit/region_trace.h - the traces of a whole frame, kept: for measurements that hold all of its fragments anyhow.
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

// Keeps the traces of `frame` in `traces` while it runs. A frame that runs as a whole leaves one; the others stay empty.
[[nodiscard]] pipeline::Watch keep_traces(const pipeline::Frame& frame, std::vector<RegionTrace>& traces);

}  // namespace strata::peeling
