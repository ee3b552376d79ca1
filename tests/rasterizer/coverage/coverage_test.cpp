// Tests that every sample inside a planar mesh is in exactly one triangle, on meshes of several shapes. The expected
// count is 1.
#include "rasterizer/coverage/coverage.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/set_up/window.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr int size_px = 192;
constexpr std::array tie_rules{TieRule::top_left, TieRule::bottom_left, TieRule::top_right, TieRule::bottom_right};

// The triangle with its corners in a random rotation and winding; neither may change its pixels.
[[nodiscard]] SetupTriangle shuffled(std::array<SubpixelPoint, 3> p, int bits, Random& random) {
    std::ranges::shuffle(p, random);
    return window_triangle(p, bits);
}

// Float positions at random places on the border of the window, in order, and one inside: a fan of slivers.
[[nodiscard]] std::vector<SetupTriangle> fan(const RasterRules& rules, int points, Random& random) {
    const int bits = rules.subpixel_bits;
    std::vector<float> along{0, size_px, 2 * size_px, 3 * size_px};
    while (static_cast<int>(along.size()) < points) along.push_back(random_float(random, 0, 4 * size_px));
    std::ranges::sort(along);
    const auto on_border = [&](float s) {
        constexpr float n = size_px;
        const std::array<float, 2> p = s < n       ? std::array{s, 0.0f}
                                       : s < 2 * n ? std::array{n, s - n}
                                       : s < 3 * n ? std::array{3 * n - s, n}
                                                   : std::array{0.0f, 4 * n - s};
        return SubpixelPoint{snap(p[0], bits, rules.snap), snap(p[1], bits, rules.snap)};
    };
    const SubpixelPoint hub{snap(random_float(random, 1, size_px - 1), bits, rules.snap),
                            snap(random_float(random, 1, size_px - 1), bits, rules.snap)};
    std::vector<SetupTriangle> triangles;
    for (std::size_t i = 0; i < along.size(); ++i) {
        const SubpixelPoint a = on_border(along[i]), b = on_border(along[(i + 1) % along.size()]);
        if (doubled_area(hub, a, b) != 0) triangles.push_back(shuffled({hub, a, b}, bits, random));
    }
    return triangles;
}

// A grid of cells whose inner corners are moved at random by less than half a cell minus a subpixel; each cell is split
// along a random diagonal.
[[nodiscard]] std::vector<SetupTriangle> grid(const RasterRules& rules, int columns, int rows, Random& random) {
    const int bits = rules.subpixel_bits;
    const float cell_x = static_cast<float>(size_px) / static_cast<float>(columns);
    const float cell_y = static_cast<float>(size_px) / static_cast<float>(rows);
    std::vector<SubpixelPoint> corner;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const bool border = i == 0 || j == 0 || i == columns || j == rows;
            // A move of less than a quarter preserves the orientation of every half cell.
            const float move = border ? 0.0f : 0.2f;
            const float x = cell_x * (static_cast<float>(i) + random_float(random, -move, move));
            const float y = cell_y * (static_cast<float>(j) + random_float(random, -move, move));
            corner.push_back({snap(x, bits, rules.snap), snap(y, bits, rules.snap)});
        }
    std::vector<SetupTriangle> triangles;
    const auto add = [&](SubpixelPoint a, SubpixelPoint b, SubpixelPoint c) {
        const Integer area = doubled_area(a, b, c);
        REQUIRE(area >= 0);
        if (area > 0) triangles.push_back(shuffled({a, b, c}, bits, random));
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto at = [&](int x, int y) { return corner[static_cast<std::size_t>(y * (columns + 1) + x)]; };
            const SubpixelPoint a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            if ((random() & 1) != 0) {
                add(a, b, c);
                add(a, c, d);
            } else {
                add(a, b, d);
                add(b, c, d);
            }
        }
    return triangles;
}

[[nodiscard]] std::uint64_t wrongly_covered(const std::vector<SetupTriangle>& triangles, const RasterRules& rules) {
    const Geometry geometry = window_geometry(triangles, size_px, size_px, rules);
    std::vector<int> count(std::size_t{size_px} * size_px, 0);
    for (const Fragment& f : draw(geometry, {}, coverage_only).fragments)
        ++count[static_cast<std::size_t>(f.y) * size_px + static_cast<std::size_t>(f.x)];
    return static_cast<std::uint64_t>(std::ranges::count_if(count, [](int n) { return n != 1; }));
}

}  // namespace

TEST_CASE("a mesh of triangles that share edges covers every sample exactly once including slivers", "[slow]") {
    constexpr std::uint64_t seed = 3;
    Random random{seed};
    std::uint64_t samples = 0, wrong = 0;
    for (const int bits : {4, 8, 12})
        for (const Snap snap_rule : {Snap::toward_zero, Snap::nearest_even})
            for (const TieRule tie : tie_rules) {
                const RasterRules rules{.subpixel_bits = bits, .snap = snap_rule, .tie_rule = tie};
                for (const auto& mesh : {fan(rules, 9, random), fan(rules, 1500, random), grid(rules, 20, 17, random),
                                         grid(rules, 150, 3, random), grid(rules, 2, 180, random)}) {
                    wrong += wrongly_covered(mesh, rules);
                    samples += std::uint64_t{size_px} * size_px;
                }
            }
    INFO("seed " << seed << ", samples " << samples);
    CHECK(samples >= 1'000'000);
    CHECK(wrong == 0);
}

TEST_CASE("coverage equals three integer inequalities at every centre and also for triangles of the whole guard band",
          "[slow]") {
    constexpr std::uint64_t seed = 4;
    Random random{seed};
    std::uint64_t wrong = 0;
    constexpr int size = 40;
    for (const int bits : {4, 8, 12})
        for (const int outside : {-17, -13, 0, 3, 100, 32700})  // negative: small triangles, within 6 and 14 pixels
            for (int n = 0; n < 300; ++n) {
                const std::array p{random_point(random, size, size, bits, outside),
                                   random_point(random, size, size, bits, outside),
                                   random_point(random, size, size, bits, outside)};
                const Integer area = doubled_area(p[0], p[1], p[2]);
                if (area == 0) continue;
                std::vector<std::array<int, 2>> expected, found;
                for (int y = 0; y < size; ++y)
                    for (int x = 0; x < size; ++x) {
                        const SubpixelPoint c = model_centre(x, y, bits);
                        bool inside = true;
                        for (std::size_t i = 0; i < 3; ++i) {
                            const SubpixelPoint a = p[i], b = p[(i + 1) % 3];
                            const Integer e = doubled_area(a, b, c) * (area > 0 ? 1 : -1);
                            const int dx = area > 0 ? b.x - a.x : a.x - b.x, dy = area > 0 ? b.y - a.y : a.y - b.y;
                            const bool top_left = dy < 0 || (dy == 0 && dx > 0);
                            inside &= e > 0 || (e == 0 && top_left);
                        }
                        if (inside) expected.push_back({x, y});
                    }
                const Geometry geometry =
                    window_geometry({window_triangle(p, bits)}, size, size, {.subpixel_bits = bits});
                for (const Fragment& f : draw(geometry, {}, coverage_only).fragments) found.push_back({f.x, f.y});
                wrong += found != expected ? 1 : 0;
            }
    INFO("seed " << seed);
    CHECK(wrong == 0);
}

TEST_CASE("the span of a row does not depend on the box that clips it") {
    constexpr std::uint64_t seed = 5;
    Random random{seed};
    std::uint64_t wrong = 0, spans = 0;
    for (int n = 0; n < 30000; ++n) {
        const int bits = n % 3 == 0 ? 12 : 8, outside = n % 2 == 0 ? 0 : 32700;
        const std::array p{random_point(random, 60, 12, bits, outside), random_point(random, 60, 12, bits, outside),
                           random_point(random, 60, 12, bits, outside)};
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        const TriangleEdges edges{p, TieRule::top_left};
        const int left = random_int(random, 0, 59), right = random_int(random, left + 1, 60);
        RowWalker all{edges, {0, 0, 60, 12}, bits}, part{edges, {left, 0, right, 12}, bits};
        for (int y = 0; y < 12; ++y, all.next_row(), part.next_row()) {
            const PixelSpan a = all.span(), b = part.span();
            const int x0 = std::max(a.x0, left), x1 = std::min(a.x1, right);
            if (x0 >= x1) {
                wrong += b.x0 < b.x1 ? 1 : 0;
                continue;
            }
            ++spans;
            wrong += b.x0 != x0 || b.x1 != x1 || b.e != edges.at(pixel_centre(x0, y, bits)) ? 1 : 0;
        }
    }
    INFO("seed " << seed);
    CHECK(spans > 30000);
    CHECK(wrong == 0);
}
