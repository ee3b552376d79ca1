// pipeline/fragments/tile_parts.h - the regions of a frame in replay: its tiles, split into parts if their fragments
// need more than a region's memory, so that no region has to rasterize every pass.
//
// Rule     A tile is halved across its longer side until each part fits or is a single pixel. A part fits if its
//          fragments (Replay::bytes_per_fragment) and their sorted entries do. Parts take the position of their tile in
//          the order. If a region's memory is less than two chunks of a store, nothing is split.
// Source   pipeline/reference/execution.md 5.3.
// Tests    tests/pipeline/fragments/tile_parts_test.cpp, tests/peeling/execution/execution_test.cpp
#pragma once
#include <array>
#include <vector>

#include "pipeline/frame/region_area.h"

namespace strata::pipeline {

struct Frame;

// Halves a rectangle. Precondition: its area is above 1.
[[nodiscard]] constexpr std::array<rasterizer::Rect, 2> halves(const rasterizer::Rect& r) noexcept {
    const int x = (r.x0 + r.x1) / 2, y = (r.y0 + r.y1) / 2;
    if (r.height() >= r.width()) return {{{r.x0, r.y0, r.x1, y}, {r.x0, y, r.x1, r.y1}}};
    return {{{r.x0, r.y0, x, r.y1}, {x, r.y0, r.x1, r.y1}}};
}

[[nodiscard]] std::vector<RegionArea> tile_parts(const Frame& frame, int threads);

}  // namespace strata::pipeline
