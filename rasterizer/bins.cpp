// rasterizer/bins.cpp - which tiles a set-up triangle may touch: its box of pixel centres, less the tiles wholly
// outside an edge. Two walks, one that counts and one that fills, so the memory is exactly that of the lists.
#include <cassert>
#include <stdexcept>

#include "rasterizer/coverage.h"
#include "rasterizer/geometry.h"

namespace strata::rasterizer {
namespace {

// The edge values at the pixel centre of `r` where they are largest decide: all three must reach a covered value.
[[nodiscard]] bool may_cover(const TriangleEdges& edges, const Rect& r, int subpixel_bits) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = edges.edge(i);
        const int x = edge.step_x() > 0 ? r.x1 - 1 : r.x0;
        const int y = edge.step_y() > 0 ? r.y1 - 1 : r.y0;
        if (edge.at(pixel_centre(x, y, subpixel_bits)) < edges.tie(i)) return false;
    }
    return true;
}

template <class Visit>
void for_each_tile(const Geometry& geometry, const SetupTriangle& triangle, Visit&& visit) {
    const Rect& viewport = geometry.state.viewport;
    const int bits = geometry.rules.subpixel_bits, size = geometry.tile_size;
    const Rect box = intersection(centre_box(triangle.p, bits), viewport);
    if (box.area() == 0) return;
    const Rect tiles{(box.x0 - viewport.x0) / size, (box.y0 - viewport.y0) / size,
                     (box.x1 - 1 - viewport.x0) / size + 1, (box.y1 - 1 - viewport.y0) / size + 1};
    const auto tile_number = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry.tiles_x) + static_cast<std::size_t>(x);
    };
    if (tiles.area() == 1) return visit(tile_number(tiles.x0, tiles.y0));
    const TriangleEdges edges{triangle.p, geometry.rules.tie_rule};
    for (int y = tiles.y0; y < tiles.y1; ++y)
        for (int x = tiles.x0; x < tiles.x1; ++x)
            if (may_cover(edges, tile_rect(geometry, tile_number(x, y)), bits)) visit(tile_number(x, y));
}

}  // namespace

Rect tile_rect(const Geometry& geometry, std::size_t tile) {
    const Rect& viewport = geometry.state.viewport;
    const auto columns = static_cast<std::size_t>(geometry.tiles_x);
    const int x = viewport.x0 + static_cast<int>(tile % columns) * geometry.tile_size;
    const int y = viewport.y0 + static_cast<int>(tile / columns) * geometry.tile_size;
    return intersection({x, y, x + geometry.tile_size, y + geometry.tile_size}, viewport);
}

void bin_triangles(Geometry& geometry, int tile_size) {
    assert(tile_size > 0 && "a tile has pixels");
    geometry.tile_size = tile_size;
    geometry.tiles_x = (geometry.state.viewport.width() + tile_size - 1) / tile_size;
    geometry.tiles_y = (geometry.state.viewport.height() + tile_size - 1) / tile_size;
    const std::size_t tiles = static_cast<std::size_t>(geometry.tiles_x) * static_cast<std::size_t>(geometry.tiles_y);

    // bin_start[t + 1] counts tile t, becomes the start of tile t, and ends as its end: the start of tile t + 1.
    std::vector<std::uint32_t>& start = geometry.bin_start;
    start.assign(tiles + 1, 0);
    std::uint64_t total = 0;
    for (const SetupTriangle& triangle : geometry.triangles)
        for_each_tile(geometry, triangle, [&](std::size_t tile) {
            ++start[tile + 1];
            ++total;
        });
    if (total > 0xffffffffu)
        throw std::length_error("more than 2^32 triangles in the bins of a frame: take larger tiles");
    std::uint32_t sum = 0;
    for (std::size_t t = 1; t <= tiles; ++t) {
        const std::uint32_t count = start[t];
        start[t] = sum;
        sum += count;
    }
    geometry.bin_triangles.resize(total);
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i)
        for_each_tile(geometry, geometry.triangles[i], [&](std::size_t tile) {
            geometry.bin_triangles[start[tile + 1]++] = static_cast<std::uint32_t>(i);
        });
}

}  // namespace strata::rasterizer
