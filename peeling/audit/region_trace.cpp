// peeling/audit/region_trace.cpp - a watch that copies every region's trace when the region ends.
#include "peeling/audit/region_trace.h"

#include "pipeline/frame/frame.h"
#include "pipeline/region/region_shortcuts.h"
#include "pipeline/vertices/prepare.h"

namespace strata::peeling {

using namespace pipeline;

Watch keep_traces(const Frame& frame, std::vector<RegionTrace>& traces) {
    const rasterizer::Geometry& geometry = frame.transparent->geometry;
    // One place for each tile, before the frame runs: workers then write to different places without a lock.
    traces.assign(static_cast<std::size_t>(geometry.tiles_x) * static_cast<std::size_t>(geometry.tiles_y), {});
    const auto keep = [&traces](Region& region, std::size_t number, const Image&) {
        RegionTrace& kept = traces[number];
        kept = {region.rect(), {}};
        for (std::size_t i = 0; i < RegionShortcuts{region}.trace().size(); ++i)
            kept.entries.push_back(RegionShortcuts{region}.trace()[i]);
    };
    // A tile that the executor found equal to another was not run: it has the other's entries, whose pixels
    // count in its own rectangle.
    const auto copy = [&traces, &geometry](std::size_t like, std::size_t number) {
        traces[number] = {tile_rect(geometry, number), traces[like].entries};
    };
    return {.ended = keep, .alike = copy};
}

}  // namespace strata::peeling
