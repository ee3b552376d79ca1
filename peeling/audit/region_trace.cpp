// peeling/audit/region_trace.cpp - a watch that copies every region's trace when the region ends.
#include "peeling/audit/region_trace.h"

#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling {

using namespace pipeline;

RegionCallbacks keep_traces(std::vector<RegionTrace>& traces) {
    // One element per region is made before the frame runs, so that workers need no lock.
    const auto begin = [&traces](std::span<const RegionArea> regions) {
        traces.clear();
        for (const RegionArea& place : regions) traces.push_back({place.rect, {}});
    };
    const auto keep = [&traces](Region& region, std::size_t number, const FrameResult&) {
        RegionTrace& kept = traces[number];
        kept.entries.clear();
        for (std::size_t i = 0; i < RegionShortcuts{region}.trace().size(); ++i)
            kept.entries.push_back(RegionShortcuts{region}.trace()[i]);
    };
    // A tile whose result the executor copied from another tile was not executed: it gets the entries of that tile,
    // whose pixel indices are relative to the tile.
    const auto copy = [&traces](std::size_t like, std::size_t number) {
        traces[number].entries = traces[like].entries;
    };
    return {.begun = begin, .ended = keep, .alike = copy};
}

}  // namespace strata::peeling
