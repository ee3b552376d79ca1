// Tests llvmpipe's lines against OpenGL's diamonds in rationals, where no end is on a border, its points against their
// squares, and the values of both against the steps of their rule, each rounded to binary32 by definition.
#include "rasterizer/coverage/shifted_ends.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "tests/rasterizer/lines.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata::rasterizer;

const RasterRules llvmpipe_shapes{.tie_rule = TieRule::bottom_left,
                                  .plane_origin = PlaneOrigin::unsnapped,
                                  .plane_rule = PlaneRule::reciprocal_area,
                                  .perspective = PerspectiveDivide::reciprocal,
                                  .lines = LineRule::shifted_ends,
                                  .points = PointRule::subpixel_square};

struct RealEnd {
    Rational x, y;
};

Rational distance_to_centre(const RealEnd& p, int x, int y) {
    return abs(p.x - x - Rational{1, 2}) + abs(p.y - y - Rational{1, 2});
}

// OpenGL's text: the segment meets the pixel's diamond and does not end in it. No end is on a border here.
bool leaves_diamond(const RealEnd& a, const RealEnd& b, int x, int y) {
    if (std::max(a.x, b.x) < x || std::min(a.x, b.x) > x + 1 || std::max(a.y, b.y) < y || std::min(a.y, b.y) > y + 1)
        return false;  // beside the pixel's square
    std::vector<Rational> at{0, 1};
    if (a.x != b.x) at.push_back((x + Rational{1, 2} - a.x) / (b.x - a.x));
    if (a.y != b.y) at.push_back((y + Rational{1, 2} - a.y) / (b.y - a.y));
    const auto is_in = [&](const Rational& t) {
        return t >= 0 && t <= 1 &&
               distance_to_centre({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}, x, y) < Rational{1, 2};
    };
    return std::ranges::any_of(at, is_in) && distance_to_centre(b, x, y) >= Rational{1, 2};
}

// A line whose slope is an odd number of sixteenths; its ends are odd multiples of 1/16 pixel along its longer axis and
// odd multiples of 1/64 across it. So binary32 computes its corners exactly, in whole subpixels, and nothing is on a
// border: at the middle of a pixel the line is an odd multiple of 1/256 away. It stays in the window across.
struct ExactLine {
    std::array<float, 2> a, b;
};
ExactLine exact_line(Random& random, bool is_x) {
    const int run = random_int(random, 1, 20) * (random() % 2 == 0 ? 1 : -1), slope = 2 * random_int(random, -8, 7) + 1;
    const auto odd = [&](int unit) {
        return static_cast<float>(2 * random_int(random, 5 * unit, 8 * unit) + 1) / static_cast<float>(unit);
    };
    const float along = odd(16), across = odd(64) + 12.0f, to = along + static_cast<float>(run),
                across_to = across + static_cast<float>(run * slope * 4) / 64.0f;
    return is_x ? ExactLine{{along, across}, {to, across_to}} : ExactLine{{across, along}, {across_to, to}};
}

std::vector<Fragment> fragments_of(const std::vector<ClipVertex>& ends, Primitive primitive, const RasterState& state,
                                   const RasterRules& rules) {
    return draw(shapes(ends, primitive, state, rules)).fragments;
}

// Steps of the rule: the value of a line at the centre of pixel (i, j).
float line_value(const ClipVertex& a, const ClipVertex& b, float va, float vb, int i, int j) {
    const Rounded one{1.0f}, half{0.5f}, dx = Rounded{a.x} - Rounded{b.x}, dy = Rounded{a.y} - Rounded{b.y};
    const Rounded inverse = one / (dx * dx + dy * dy), change = Rounded{va} - Rounded{vb};
    const bool is_x = std::abs(dx.v) >= std::abs(dy.v);
    const Rounded slope = is_x ? dy / dx : dx / dy, longer = (is_x ? dx : dy) * (one + slope * slope);
    const Rounded right = is_x ? change * longer * inverse : Rounded{0.0f},
                  down = is_x ? Rounded{0.0f} : change * longer * inverse;
    const Rounded origin = Rounded{va} - (right * (Rounded{a.x} - half) + down * (Rounded{a.y} - half));
    return ((right * Rounded{static_cast<float>(i)} + origin) + down * Rounded{static_cast<float>(j)}).v;
}

}  // namespace

TEST_CASE("llvmpipe's lines have the diamonds that they leave if no end is on a border") {
    Random random{1};
    int wrong = 0, covered = 0;
    for (int i = 0; i < 400; ++i) {
        const ExactLine ends = exact_line(random, i % 2 == 0);
        const auto &a = ends.a, &b = ends.b;
        const RealEnd first{Rational{a[0]}, Rational{a[1]}}, second{Rational{b[0]}, Rational{b[1]}};
        const PixelSet drawn =
            pixels_of(fragments_of({{.x = a[0], .y = a[1], .z = 0.5f}, {.x = b[0], .y = b[1], .z = 0.5f}},
                                   Primitive::lines, line_state(), llvmpipe_shapes));
        covered += static_cast<int>(drawn.size());
        wrong += drawn != pixels_where([&](int x, int y) { return leaves_diamond(first, second, x, y); }) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 2000);
}

TEST_CASE("llvmpipe's wide lines add pixels across the longer axis, half of them on either side") {
    Random random{2};
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const ExactLine ends = exact_line(random, i % 2 == 0);
        const auto &a = ends.a, &b = ends.b;
        const int width = 2 + i % 6;
        const bool is_x = i % 2 == 0;
        const auto drawn = [&](float px) {
            RasterState state = line_state();
            state.line_width_px = px;
            return pixels_of(fragments_of({{.x = a[0], .y = a[1], .z = 0.5f}, {.x = b[0], .y = b[1], .z = 0.5f}},
                                          Primitive::lines, state, llvmpipe_shapes));
        };
        // By the line itself at the middle of each column that has a pixel.
        std::set<int> columns;
        for (const auto& [x, y] : drawn(1)) columns.insert(is_x ? x : y);
        const PixelSet expected = pixels_where([&](int x, int y) {
            const int along = is_x ? x : y, across = is_x ? y : x;
            const std::size_t u = is_x ? 0 : 1, v = 1 - u;
            const Rational slope = (Rational{b[v]} - Rational{a[v]}) / (Rational{b[u]} - Rational{a[u]});
            const Rational line = Rational{a[v]} + slope * (along + Rational{1, 2} - Rational{a[u]});
            return columns.contains(along) && abs(across + Rational{1, 2} - line) < Rational{width, 2};
        });
        wrong += drawn(static_cast<float>(width) + (i % 3 == 0 ? 0.25f : -0.25f)) != expected ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("llvmpipe's points are squares of whole subpixels, at least a pixel, with left and lower side") {
    Random random{3};
    int wrong = 0;
    for (int i = 0; i < 1000; ++i) {
        const int x = random_int(random, 0, 48 * 256), y = random_int(random, 0, 48 * 256),
                  size = random_int(random, 1, 2500);
        RasterState state = line_state();
        state.point_size_px = static_cast<float>(size) / 256.0f;
        const ClipVertex point{.x = static_cast<float>(x) / 256.0f, .y = static_cast<float>(y) / 256.0f, .z = 0.5f};
        const int width = std::max(size, 256), left = x - width / 2, top = y - width / 2;
        const PixelSet expected = pixels_where([&](int px, int py) {
            const int cx = 256 * px + 128, cy = 256 * py + 128;
            return cx >= left && cx < left + width && cy > top && cy <= top + width;
        });
        wrong += pixels_of(fragments_of({point}, Primitive::points, state, llvmpipe_shapes)) != expected ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("depths and colours of llvmpipe's lines change along the longer axis by the steps of their rule") {
    Random random{4};
    RasterState state = line_state();
    state.line_width_px = 3;
    int wrong = 0, seen = 0;
    for (int i = 0; i < 200; ++i) {
        const std::array<ClipVertex, 2> ends = random_ends(random);
        const Geometry g = shapes({ends[0], ends[1]}, Primitive::lines, state, llvmpipe_shapes);
        for (const Fragment& f : draw(g).fragments) {
            ++seen;
            wrong += wrong_values(g, ends, f, line_value,
                                  [](Rounded over, Rounded under) { return over * (Rounded{1.0f} / under); });
        }
    }
    CHECK(wrong == 0);
    CHECK(seen > 2000);
}

TEST_CASE("outlines of polygons are refused where the view volume cuts them in an unknown way") {
    RasterRules rules = llvmpipe_shapes;
    rules.clip = ClipVolume::view_volume;
    CHECK(draws(rules, Primitive::lines));
    CHECK(draws(rules, Primitive::points));
    CHECK_FALSE(draws(rules, Primitive::polygon_lines));
    CHECK_FALSE(draws(rules, Primitive::polygon_points));
    CHECK(draws(rules, Primitive::triangles));
}
