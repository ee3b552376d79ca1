// Tests the kernels for small triangles on every instruction set against boxes, areas and inequalities in 64-bit
// integers, pixel by pixel.
#include "rasterizer/coverage/small_triangles.h"

#include <catch2/catch.hpp>
#include <memory>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

using Corners = std::array<SubpixelPoint, 3>;

[[nodiscard]] std::int64_t area_of(SubpixelPoint a, SubpixelPoint b, SubpixelPoint c) {
    return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
           (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

// True if side (a, b) of a clockwise triangle, y down, includes a centre on it.
[[nodiscard]] bool side_owns(SubpixelPoint a, SubpixelPoint b, TieRule rule) {
    if (a.y != b.y) {
        const bool is_left = b.y < a.y;
        return is_left == (rule == TieRule::top_left || rule == TieRule::bottom_left);
    }
    const bool is_top = b.x > a.x;
    return is_top == (rule == TieRule::top_left || rule == TieRule::top_right);
}

[[nodiscard]] bool takes_centre(Corners p, int x, int y, const GroupRules& rules) {
    if (area_of(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
    const SubpixelPoint c = model_centre(x, y, rules.subpixel_bits);
    for (std::size_t i = 0; i < 3; ++i) {
        const SubpixelPoint a = p[i], b = p[(i + 1) % 3];
        const std::int64_t e = area_of(a, b, c);
        if (e < 0 || (e == 0 && !side_owns(a, b, rules.tie_rule))) return false;
    }
    return true;
}

// The pixels of the clip rectangle between the outermost corners, found by search.
[[nodiscard]] Rect box_by_search(const Corners& p, const GroupRules& rules) {
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    Rect box{1 << 20, 1 << 20, -1, -1};
    for (int x = rules.clip.x0; x < rules.clip.x1; ++x) {
        const int at = model_centre(x, 0, rules.subpixel_bits).x;
        if (at >= left && at <= right) box.x0 = std::min(box.x0, x), box.x1 = x + 1;
    }
    for (int y = rules.clip.y0; y < rules.clip.y1; ++y) {
        const int at = model_centre(0, y, rules.subpixel_bits).y;
        if (at >= top && at <= bottom) box.y0 = std::min(box.y0, y), box.y1 = y + 1;
    }
    return box;
}

[[nodiscard]] Corners random_corners(Random& random, int bits, int n) {
    const int unit = 1 << bits, size = std::array{1, 3, 9, 16, 17, 40, 5000}[static_cast<std::size_t>(n % 7)];
    const int x = random_int(random, -4, 44), y = random_int(random, -4, 34);
    Corners p;
    for (SubpixelPoint& q : p) {
        q = {x * unit + random_int(random, 0, size * unit), y * unit + random_int(random, 0, size * unit)};
        if (n % 3 == 0) q = {q.x / unit * unit + unit / 2, q.y / unit * unit + unit / 2};  // on pixel centres, for ties
    }
    return p;
}

struct GroupErrors {
    std::uint64_t boxes = 0, small = 0, areas = 0, centres = 0, reached = 0;
    std::uint64_t small_triangles = 0, pixels = 0, missed = 0;
};

void compare_group(const TriangleGroup& g, const std::vector<Corners>& all, const GroupRules& rules,
                   GroupErrors& wrong) {
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Corners& p = all[k];
        const Rect expected = box_by_search(p, rules), found = g.box(k);
        const bool is_empty = expected.area() == 0;
        wrong.boxes += is_empty ? found.area() != 0 : found != expected ? 1 : 0;
        const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
        const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
        const bool is_small =
            found.width() <= 16 && found.height() <= 15 && right - left <= 16384 && bottom - top <= 16384;
        wrong.small += (g.small[k] != 0) != is_small ? 1 : 0;
        if (!is_small) wrong.reached += (g.reached[k] != 0) == is_empty ? 1 : 0;
        if (!is_small || g.small[k] > 1) continue;
        ++wrong.small_triangles;
        const std::int64_t area = area_of(p[0], p[1], p[2]);
        wrong.areas += std::int64_t{g.area[k]} != std::abs(area) || (g.turned[k] != 0) != (area < 0) ? 1 : 0;
        unsigned edges_met = 0;  // bit i: some centre of the box is not outside of edge i
        for (int y = found.y0; area != 0 && y < found.y1; ++y)
            for (int x = found.x0; x < found.x1; ++x, ++wrong.pixels) {
                bool covered = true;
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::uint32_t e = g.value[i][k] + g.step[i][k] * static_cast<std::uint32_t>(x - found.x0) +
                                            g.down[i][k] * static_cast<std::uint32_t>(y - found.y0);
                    covered = covered && e < 0x80000000u;
                    edges_met |= (~e >> 31) << i;
                }
                wrong.centres += covered != takes_centre(p, x, y, rules) ? 1 : 0;
            }
        if (area == 0) continue;
        wrong.reached += (g.reached[k] != 0) != (edges_met == 7) ? 1 : 0;
        wrong.missed += !is_empty && g.reached[k] == 0 ? 1 : 0;
    }
}

}  // namespace

TEST_CASE(
    "sixteen triangles together have the boxes and areas and covered centres of each alone under every tie rule") {
    const auto group = std::make_unique<TriangleGroup>();
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope scope{simd};
        Random random{691};
        GroupErrors wrong;
        for (const int bits : {4, 8, 12})
            for (const TieRule tie :
                 {TieRule::top_left, TieRule::bottom_left, TieRule::top_right, TieRule::bottom_right})
                for (int round = 0; round < 12; ++round) {
                    const GroupRules rules{round % 3 == 0 ? Rect{5, 3, 21, 18} : Rect{0, 0, 48, 40}, bits, tie};
                    std::vector<Corners> all;
                    std::vector<WindowCorner> corners;
                    const std::size_t count = round % 4 == 0 ? static_cast<std::size_t>(random_int(random, 1, 15)) : 16;
                    for (std::size_t k = 0; k < count; ++k) {
                        all.push_back(random_corners(random, bits, static_cast<int>(random() % 100)));
                        for (const SubpixelPoint& p : all.back()) corners.push_back({.p = p});
                    }
                    std::array<std::uint32_t, 3> own{};
                    const auto vertices = [&](std::size_t k) -> const auto& {
                        const auto first = static_cast<std::uint32_t>(3 * k);
                        return own = {first, first + 1, first + 2};
                    };
                    load_corners(corners, count, vertices, *group);
                    small_kernels().set_up(rules, *group);
                    compare_group(*group, all, rules, wrong);
                    const auto boxes = std::make_unique<TriangleGroup>();
                    load_corners(corners, count, vertices, *boxes);
                    small_kernels().set_up_boxes(rules, *boxes);
                    for (std::size_t k = 0; k < TriangleGroup::size; ++k)
                        wrong.boxes += boxes->box(k) != group->box(k) || boxes->small[k] != group->small[k] ||
                                               boxes->area[k] != group->area[k] || boxes->turned[k] != group->turned[k]
                                           ? 1
                                           : 0;
                }
        CHECK(wrong.boxes == 0);
        CHECK(wrong.small == 0);
        CHECK(wrong.areas == 0);
        CHECK(wrong.centres == 0);
        CHECK(wrong.reached == 0);
        CHECK(wrong.missed > 50);
        CHECK(wrong.small_triangles > 500);
        CHECK(wrong.pixels > 10000);
    }
}

TEST_CASE("a group that is not full repeats its last triangle") {
    const std::vector<WindowCorner> corners{{.p = {1, 2}}, {.p = {30, 4}}, {.p = {5, 60}}, {.p = {70, 80}}};
    const std::array<std::array<std::uint32_t, 3>, 2> index{{{0, 1, 2}, {3, 1, 0}}};
    const auto group = std::make_unique<TriangleGroup>();
    load_corners(
        corners, 2, [&](std::size_t k) -> const auto& { return index[k]; }, *group);
    for (std::size_t k = 0; k < TriangleGroup::size; ++k) {
        CHECK(group->x[0][k] == (k == 0 ? 1u : 70u));
        CHECK(group->y[0][k] == (k == 0 ? 2u : 80u));
        CHECK(group->x[2][k] == (k == 0 ? 5u : 1u));
        CHECK(group->y[2][k] == (k == 0 ? 60u : 2u));
    }
}
