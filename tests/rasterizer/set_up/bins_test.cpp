// Tests the bins of tiles against the fragments that are drawn.
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

}  // namespace

TEST_CASE("every fragment's triangle is in the bin of its tile once and in submission order", "[slow]") {
    constexpr std::uint64_t seed = 111;
    const TriangleSoup soup = random_soup(seed, 300, SoupKind::needs_clipping);
    RasterState state = scene_state(150, 90);
    state.viewport = {13, 7, 163, 97};
    Geometry geometry = set_up(soup, state, {}, 1);
    const auto fragments = draw(geometry, {}, coverage_only).fragments;
    REQUIRE(fragments.size() > 10000);
    for (const int size : {8, 16, 32, 64, 128}) {
        bin_triangles(geometry, size);
        const auto tiles = static_cast<std::size_t>(geometry.tiles_x) * static_cast<std::size_t>(geometry.tiles_y);
        REQUIRE(geometry.bin_start.size() == tiles + 1);
        std::uint64_t wrong = 0;
        std::size_t area = 0;
        for (std::size_t t = 0; t < tiles; ++t) {
            const auto bin = geometry.bin(t);
            wrong += std::ranges::adjacent_find(bin, std::ranges::greater_equal{}) != bin.end() ? 1 : 0;
            area += tile_rect(geometry, t).area();
            wrong += intersection(tile_rect(geometry, t), state.viewport) != tile_rect(geometry, t) ? 1 : 0;
        }
        CHECK(area == state.viewport.area());
        std::size_t covered = 0;
        for (std::size_t t = 0; t < tiles; ++t)
            covered += draw(geometry, {}, coverage_only, tile_rect(geometry, t), geometry.bin(t)).fragments.size();
        CHECK(covered == fragments.size());
        CHECK(wrong == 0);
    }
}

TEST_CASE("a thin diagonal is not in adjacent bins") {
    const SetupTriangle t = window_triangle({{{0, 0}, {256 * 256, 256 * 256}, {254 * 256, 256 * 256}}}, 8);
    Geometry geometry = window_geometry({t}, 256, 256, {});
    bin_triangles(geometry, 16);
    CHECK(geometry.bin_triangles.size() < 3 * 16);
    CHECK(geometry.bin_triangles.size() >= 16);
}

TEST_CASE("a frame of 16384 x 16384 pixels has four million bins of 8 x 8") {
    std::vector<SetupTriangle> triangles;
    for (int i = 0; i < 100; ++i) {
        const std::int32_t x = (16383 - i) * 256, y = i * 256;
        triangles.push_back(window_triangle({{{x, y}, {x + 255, y}, {x, y + 255}}}, 8));
    }
    Geometry geometry = window_geometry(triangles, 16384, 16384, {});
    bin_triangles(geometry, 8);
    CHECK(geometry.bin_start.size() == std::size_t{2048} * 2048 + 1);
    CHECK(geometry.bin_triangles.size() == 100);
    CHECK(geometry.bin(2047).size() == 8);
    CHECK(tile_rect(geometry, 2047) == Rect{16376, 0, 16384, 8});
}

TEST_CASE("a frame of one pixel has one bin") {
    Geometry geometry = window_geometry({window_triangle({{{0, 0}, {300, 0}, {0, 300}}}, 8)}, 1, 1, {});
    bin_triangles(geometry, 128);
    CHECK(geometry.bin(0).size() == 1);
    CHECK(draw(geometry, {}, coverage_only, tile_rect(geometry, 0), geometry.bin(0)).fragments.size() == 1);
}
