// Tests the corner cases of rasterizer/reference/coverage.md 11. The expected pixels are those printed there, in window
// positions, y down.
#include "rasterizer/coverage/edge.h"

#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "rasterizer/set_up/window.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;
using Pixels = std::vector<std::pair<int, int>>;
using Position = std::array<float, 2>;

struct Device {
    int subpixel_bits;
    Snap snap;
};
constexpr Device geforce3_like{4, Snap::toward_zero};
constexpr Device geforce8_like{8, Snap::nearest_even};

[[nodiscard]] Pixels covered(const Device& device, std::array<Position, 3> corner) {
    std::array<SubpixelPoint, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = {snap(corner[i][0], device.subpixel_bits, device.snap),
                snap(corner[i][1], device.subpixel_bits, device.snap)};
    if (Edge{p[0], p[1]}.at(p[2]) == 0) return {};  // dropped by set-up: setup_test.cpp
    const RasterRules rules{.subpixel_bits = device.subpixel_bits, .snap = device.snap};
    const Geometry geometry = window_geometry({window_triangle(p, device.subpixel_bits)}, 16, 16, rules);
    Pixels pixels;
    for (const Fragment& f : by_pixel(draw(geometry, {}, coverage_only).fragments)) pixels.emplace_back(f.x, f.y);
    return pixels;
}

void check_both(const std::array<Position, 3>& corner, const Pixels& expected) {
    for (const Device& device : {geforce3_like, geforce8_like})
        for (int turn = 0; turn < 3; ++turn) {
            const std::size_t a = static_cast<std::size_t>(turn), b = (a + 1) % 3, c = (a + 2) % 3;
            CHECK(covered(device, {corner[a], corner[b], corner[c]}) == expected);
            CHECK(covered(device, {corner[c], corner[b], corner[a]}) == expected);
        }
}

// True if column 0 is covered by a triangle whose left edge is vertical at x.
[[nodiscard]] bool column_0_is_covered(const Device& device, float x) {
    for (const auto& [i, j] : covered(device, {Position{x, -20.0f}, Position{x + 40.0f, 5.0f}, Position{x, 30.0f}}))
        if (i == 0) return true;
    return false;
}

}  // namespace

TEST_CASE("vertex centres on right and bottom edges are excluded and those on top and left edges are not") {
    check_both({{{.5f, .5f}, {2.5f, .5f}, {.5f, 2.5f}}}, {{0, 0}, {1, 0}, {0, 1}});
}

TEST_CASE("the other half of a square covers exactly the remaining pixel") {
    check_both({{{2.5f, .5f}, {2.5f, 2.5f}, {.5f, 2.5f}}}, {{1, 1}});
}

TEST_CASE("centres on a shared diagonal belong to one of its two triangles") {
    check_both({{{0, 0}, {2, 0}, {0, 2}}}, {{0, 0}});
    check_both({{{2, 0}, {2, 2}, {0, 2}}}, {{1, 0}, {0, 1}, {1, 1}});
}

TEST_CASE("a sliver along the pixel border covers nothing") { check_both({{{0, 0}, {8, .0625f}, {8, 0}}}, {}); }

TEST_CASE("a top edge through centres covers them and a bottom edge does not") {
    check_both({{{0, .5f}, {8, .5f}, {8, .5625f}}}, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}, {7, 0}});
    check_both({{{0, .5f}, {8, .5f}, {8, .4375f}}}, {});
}

TEST_CASE("a triangle smaller than a pixel covers the centre that it surrounds") {
    check_both({{{.4f, .4f}, {.6f, .4f}, {.5f, .6f}}}, {{0, 0}});
}

TEST_CASE("a left edge at .5624 is truncated onto the centre by GeForce3 and rounded past it by GeForce8") {
    CHECK(column_0_is_covered(geforce3_like, .5624f));
    CHECK_FALSE(column_0_is_covered(geforce8_like, .5624f));
}

TEST_CASE("a left edge at .4999 or .5 covers column 0 and one at .5625 or .5626 does not") {
    for (const Device& device : {geforce3_like, geforce8_like}) {
        CHECK(column_0_is_covered(device, .4999f));
        CHECK(column_0_is_covered(device, .5f));
        CHECK_FALSE(column_0_is_covered(device, .5625f));
        CHECK_FALSE(column_0_is_covered(device, .5626f));
    }
}

TEST_CASE("edge values at the corners of the guard band are exact") {
    constexpr std::int32_t far = 1 << 27;
    CHECK(Edge{{-far, -far}, {far, -far}}.at({far, far}) == std::int64_t{1} << 56);
    CHECK(Edge{{-far, far}, {far, -far}}.at({far, far}) == std::int64_t{1} << 56);
    CHECK(Edge{{far, -far}, {-far, far}}.at({far, far}) == -(std::int64_t{1} << 56));
}

TEST_CASE("each tie rule owns one of two opposite directions of every edge") {
    for (const TieRule rule : {TieRule::top_left, TieRule::bottom_left, TieRule::top_right, TieRule::bottom_right})
        for (int dx = -2; dx <= 2; ++dx)
            for (int dy = -2; dy <= 2; ++dy) {
                if (dx == 0 && dy == 0) continue;
                const SubpixelPoint a{0, 0}, b{dx, dy};
                CHECK(Edge{a, b}.owns_ties(rule) != Edge{b, a}.owns_ties(rule));
            }
}
