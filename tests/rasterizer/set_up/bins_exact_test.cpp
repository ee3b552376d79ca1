// Tests tile lists. A triangle belongs to a tile's list if its box of pixels overlaps the tile and, unless it is small,
// every side includes some pixel centre of the tile; each centre is tested by itself.
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

// Twice the area of (a, b, p), positive inside of a triangle whose area has the sign `turn`; in 64 bits.
[[nodiscard]] std::int64_t side_value(SubpixelPoint a, SubpixelPoint b, SubpixelPoint p, int turn) {
    return turn * ((std::int64_t{b.x} - a.x) * (std::int64_t{p.y} - a.y) -
                   (std::int64_t{b.y} - a.y) * (std::int64_t{p.x} - a.x));
}

// By TieRule::top_left: a side that runs up, or a horizontal one that runs right, includes the centres on it. y down.
[[nodiscard]] bool side_takes_ties(SubpixelPoint a, SubpixelPoint b, int turn) {
    const std::int64_t dx = turn * (std::int64_t{b.x} - a.x), dy = turn * (std::int64_t{b.y} - a.y);
    return dy < 0 || (dy == 0 && dx > 0);
}

[[nodiscard]] bool in_tile_by_model(const Geometry& g, const TriangleRecord& t, const Rect& tile) {
    const Rect& port = g.state.viewport;
    const Rect box{port.x0 + t.box.x0, port.y0 + t.box.y0, port.x0 + t.box.x1, port.y0 + t.box.y1};
    const bool overlaps = box.x0 < tile.x1 && tile.x0 < box.x1 && box.y0 < tile.y1 && tile.y0 < box.y1;
    const bool in_one = box.x0 >= tile.x0 && box.x1 <= tile.x1 && box.y0 >= tile.y0 && box.y1 <= tile.y1;
    if (!overlaps || in_one || (t.box.x1 - t.box.x0 <= 16 && t.box.y1 - t.box.y0 <= 15)) return overlaps;
    const auto p = g.points(t);
    const int turn = side_value(p[0], p[1], p[2], 1) > 0 ? 1 : -1;
    for (std::size_t i = 0; i < 3; ++i) {
        const SubpixelPoint a = p[i], b = p[(i + 1) % 3];
        bool takes_any = false;
        for (int y = tile.y0; y < tile.y1 && !takes_any; ++y)
            for (int x = tile.x0; x < tile.x1 && !takes_any; ++x) {
                const std::int64_t e = side_value(a, b, model_centre(x, y, g.rules.subpixel_bits), turn);
                takes_any = e > 0 || (e == 0 && side_takes_ties(a, b, turn));
            }
        if (!takes_any) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a tile lists exactly the triangles whose box overlaps it and of which no side excludes it") {
    Random random{641};
    std::uint64_t wrong = 0, listed = 0, left_out = 0;
    for (const int bits : {4, 8}) {
        std::vector<SetupTriangle> triangles;
        while (triangles.size() < 60) {
            const int unit = 1 << bits;
            std::array<SubpixelPoint, 3> p;
            // Some corners are on a grid of pixel centres and corners, where ties decide; some triangles have a long
            // thin side.
            for (SubpixelPoint& q : p)
                q = triangles.size() % 2 == 0 ? random_point(random, 100, 70, bits, 20)
                                              : SubpixelPoint{random_int(random, 0, 50) * unit + unit / 2,
                                                              random_int(random, 0, 35) * unit * 2};
            if (triangles.size() % 5 == 0) p[2] = {p[0].x + random_int(random, 1, unit), p[0].y + 1};
            if (doubled_area(p[0], p[1], p[2]) != 0) triangles.push_back(window_triangle(p, bits));
        }
        Geometry g = window_geometry(triangles, 100, 70, {.subpixel_bits = bits});
        for (const int size : {8, 16, 32}) {
            bin_triangles(g, size);
            for (std::size_t tile = 0; tile + 1 < g.bin_start.size(); ++tile) {
                const auto bin = g.bin(tile);
                const Rect rect = tile_rect(g, tile);
                for (std::uint32_t i = 0; i < g.triangles.size(); ++i) {
                    const PixelBox& box = g.triangles[i].box;
                    if (box.x1 <= box.x0 || box.y1 <= box.y0) continue;  // dropped by set-up
                    const bool found = std::ranges::find(bin, i) != bin.end();
                    const bool expected = in_tile_by_model(g, g.triangles[i], rect);
                    wrong += found != expected ? 1 : 0;
                    listed += expected ? 1 : 0;
                    left_out += expected ? 0 : 1;
                }
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(listed > 1000);
    CHECK(left_out > 1000);
}

TEST_CASE("lists of many triangles are joined from chunks in submission order for any number of threads") {
    // 30,000 triangles are binned in seven chunks, 20 in one chunk.
    std::vector<SetupTriangle> triangles;
    Random random{642};
    for (int i = 0; i < 30000; ++i) {
        const SubpixelPoint a = random_point(random, 120, 60, 8);
        triangles.push_back(window_triangle({{a, {a.x + random_int(random, 300, 4000), a.y}, {a.x, a.y + 900}}}, 8));
    }
    Geometry g = window_geometry(triangles, 124, 64, {});
    std::vector<std::vector<std::uint32_t>> expected(8 * 4);  // in 16 x 16 tiles
    Geometry few = g;
    for (std::uint32_t first = 0; first < triangles.size(); first += 20) {
        few.triangles.assign(g.triangles.begin() + first, g.triangles.begin() + first + 20);
        bin_triangles(few, 16, 1);
        for (std::size_t tile = 0; tile < expected.size(); ++tile)
            for (const std::uint32_t i : few.bin(tile)) expected[tile].push_back(first + i);
    }
    for (const int threads : {1, 3}) {
        bin_triangles(g, 16, threads);
        REQUIRE(g.bin_start.size() == expected.size() + 1);
        std::size_t wrong = 0, all = 0;
        for (std::size_t tile = 0; tile < expected.size(); ++tile) {
            wrong += std::ranges::equal(g.bin(tile), expected[tile]) ? 0 : 1;
            all += expected[tile].size();
        }
        CHECK(wrong == 0);
        CHECK(g.bin_triangles.size() == all);
    }
}

TEST_CASE("a geometry is binned again for another tile size and a viewport without pixels has no tile") {
    Geometry g = window_geometry({window_triangle({{{0, 0}, {9000, 0}, {0, 9000}}}, 8)}, 40, 30, {});
    bin_triangles(g, 8);
    CHECK(g.tiles_x == 5);
    CHECK(g.tiles_y == 4);
    bin_triangles(g, 32);
    CHECK(g.tile_size == 32);
    CHECK(g.tiles_x == 2);
    CHECK(g.tiles_y == 1);
    CHECK(g.bin_start == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(tile_rect(g, 1) == Rect{32, 0, 40, 30});
    g.state.viewport = {5, 5, 5, 30};
    bin_triangles(g, 8);
    CHECK(g.bin_triangles.empty());
    CHECK(g.bin_start == std::vector<std::uint32_t>{0});
}
