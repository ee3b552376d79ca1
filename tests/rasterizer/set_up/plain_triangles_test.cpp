// The model: set-up of one triangle after the other by the scalar twins, and edge functions in 64 bits at every centre of a box.
#include "rasterizer/set_up/plain_triangles.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/dense.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] bool same(const TriangleRecord& a, const TriangleRecord& b) {
    return a.vertex == b.vertex && a.primitive == b.primitive && a.material == b.material && a.box.x0 == b.box.x0 &&
           a.box.y0 == b.box.y0 && a.box.x1 == b.box.x1 && a.box.y1 == b.box.y1 && a.front_facing == b.front_facing &&
           a.is_tiny == b.is_tiny && a.negative_w == b.negative_w && a.covered == b.covered;
}

// Of any winding: positive, or on a side that takes its ties.
[[nodiscard]] bool covers_by_model(std::array<SubpixelPoint, 3> p, SubpixelPoint centre, TieRule rule) {
    const auto side = [](SubpixelPoint a, SubpixelPoint b, SubpixelPoint c) {
        return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
               (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
    };
    if (side(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
    const bool takes_left = rule == TieRule::top_left || rule == TieRule::bottom_left;
    const bool takes_top = rule == TieRule::top_left || rule == TieRule::top_right;
    for (std::size_t i = 0; i < 3; ++i) {
        const SubpixelPoint a = p[i], b = p[(i + 1) % 3];
        const bool takes = a.y != b.y ? (b.y < a.y) == takes_left : (b.x > a.x) == takes_top;
        const std::int64_t e = side(a, b, centre);
        if (e < 0 || (e == 0 && !takes)) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("sixteen plain triangles at once become the records and counts of one after the other, on every set",
          "[slow]") {
    std::uint64_t wrong = 0, tiny = 0, others = 0;
    for (const DenseCase& dense : dense_cases()) {
        const auto set_up_by = [&](strata::Simd simd) {
            const strata::SimdScope kernels{simd};
            return set_up(dense.soup, dense.state, dense.rules, 2);
        };
        const Geometry expected = set_up_by(strata::Simd::scalar);
        for (const TriangleRecord& t : expected.triangles) ++(t.is_tiny ? tiny : others);
        for (const strata::Simd simd : strata::available_simd()) {
            const Geometry found = set_up_by(simd);
            wrong += found.counters == expected.counters ? 0 : 1;
            wrong += std::ranges::equal(found.triangles, expected.triangles, same) ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(tiny > 10'000);
    CHECK(others > 1'000);
}

TEST_CASE("a tiny triangle's record holds the pixels that it covers, and none of it is binned where there are none",
          "[slow]") {
    std::uint64_t wrong = 0, covered = 0, empty = 0;
    for (const DenseCase& dense : dense_cases()) {
        Geometry g = set_up(dense.soup, dense.state, dense.rules, 1);
        bin_triangles(g, 16);
        std::vector<bool> is_binned(g.triangles.size());
        for (const std::uint32_t t : g.bin_triangles) is_binned[t] = true;
        for (std::size_t i = 0; i < g.triangles.size(); ++i) {
            const TriangleRecord& t = g.triangles[i];
            const bool is_small = t.box.x1 - t.box.x0 <= tiny_size && t.box.y1 - t.box.y0 <= tiny_size;
            wrong += is_small != t.is_tiny ? 1 : 0;  // no corners here lie far apart
            if (!t.is_tiny) continue;
            std::uint32_t bits = 0;
            for (int y = t.box.y0; y < t.box.y1; ++y)
                for (int x = t.box.x0; x < t.box.x1; ++x) {
                    const Rect& port = g.state.viewport;
                    const SubpixelPoint centre = pixel_centre(port.x0 + x, port.y0 + y, g.rules.subpixel_bits);
                    if (covers_by_model(g.points(t), centre, g.rules.tie_rule))
                        bits |= 1u << ((y - t.box.y0) * tiny_size + (x - t.box.x0));
                }
            wrong += t.covered != bits || is_binned[i] != (bits != 0) ? 1 : 0;
            ++(bits != 0 ? covered : empty);
        }
    }
    CHECK(wrong == 0);
    CHECK(covered > 5'000);
    CHECK(empty > 1'000);
}

TEST_CASE("a thin triangle that reaches far beyond the viewport is not tiny, however few of its pixels are in it") {
    TriangleSoup soup;
    for (const auto& [x, y] : std::array<std::array<float, 2>, 3>{{{0.98f, -0.01f}, {90.0f, 0.0f}, {90.0f, 0.01f}}})
        soup.vertices.push_back({.x = x, .y = y});
    soup.indices = {0, 1, 2};
    soup.runs = {{0, 3, 0, 0, true, false}};
    RasterState state;
    state.viewport = {0, 0, 100, 100};
    const Geometry g = set_up(soup, state, {.subpixel_bits = 8}, 1);
    REQUIRE(g.triangles.size() == 1);
    CHECK(g.triangles[0].box.x1 - g.triangles[0].box.x0 <= tiny_size);
    CHECK_FALSE(g.triangles[0].is_tiny);
}
