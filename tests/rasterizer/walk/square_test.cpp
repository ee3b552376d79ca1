// Tests the pixels of a square, counted by hand. The README of rasterizer quotes this file.
#include <catch2/catch.hpp>
#include <set>

#include "rasterizer/walk/tile_rasterizer.h"

TEST_CASE("two triangles of a square cover each of its 64 pixels once") {
    using namespace strata::rasterizer;
    TriangleSoup soup;
    soup.vertices = {ClipVertex{-1, -1}, ClipVertex{1, -1}, ClipVertex{-1, 1}, ClipVertex{1, 1}};
    soup.indices = {0, 1, 2, 2, 1, 3};
    soup.runs = {{.first_index = 0, .index_count = 6}};
    RasterState state;
    state.viewport = {0, 0, 8, 8};
    const Geometry geometry = set_up(soup, state, {}, 1);  // one thread
    std::multiset<std::uint32_t> pixels;
    auto sink = [&](FragmentBatch& batch) { pixels.insert(batch.pixel.begin(), batch.pixel.begin() + batch.count); };
    TileRasterizer{state.viewport}.draw(geometry, geometry.all_triangles, {}, {}, BatchSink{sink});
    CHECK(pixels.size() == 64);
    CHECK(std::set(pixels.begin(), pixels.end()).size() == 64);
}
