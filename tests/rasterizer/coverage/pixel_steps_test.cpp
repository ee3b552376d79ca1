// Tests softpipe's lines and points: thin lines against whole steps in rationals, wide ones and points against their
// parallelograms and squares in rationals, and the values of all of them against the steps of their rule.
#include "rasterizer/coverage/pixel_steps.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "tests/rasterizer/lines.h"

namespace {

using namespace strata::rasterizer;

const RasterRules softpipe_shapes{.coverage = CoverageRule::float_spans,
                                  .plane_origin = PlaneOrigin::unsnapped,
                                  .plane_rule = PlaneRule::least_corner,
                                  .lines = LineRule::pixel_steps,
                                  .points = PointRule::two_triangles};

RasterState state_of_width(float px) {
    RasterState state = line_state();
    state.line_width_px = state.point_size_px = px;
    return state;
}

// A vertex at multiples of 1/unit pixel.
ClipVertex vertex_of(int x, int y, int unit) {
    return {.x = static_cast<float>(x) / static_cast<float>(unit),
            .y = static_cast<float>(y) / static_cast<float>(unit),
            .z = 0.5f};
}

std::vector<Fragment> softpipe_fragments(const std::vector<ClipVertex>& ends, Primitive primitive,
                                         const RasterState& state) {
    return draw(shapes(ends, primitive, state, softpipe_shapes)).fragments;
}

int sign_of(int v) { return v < 0 ? -1 : 1; }

// From pixel to pixel along the longer axis, without the last; across by the nearest pixel, a half in the direction of
// the line.
PixelSet stepped(int x0, int y0, int x1, int y1) {
    PixelSet pixels;
    const int across = std::abs(x1 - x0), below = std::abs(y1 - y0), steps = std::max(across, below),
              least = std::min(across, below);
    for (int i = 0; i < steps; ++i) {
        const int j = floor(Rational{i * least, steps} + Rational{1, 2}).convert_to<int>();
        const int x = x0 + sign_of(x1 - x0) * (across >= below ? i : j),
                  y = y0 + sign_of(y1 - y0) * (across >= below ? j : i);
        if (x < line_window && y < line_window) pixels.insert({x, y});
    }
    return pixels;
}

// The value at a pixel of a plane through `value` at (x, y): from the even pixel of its block of 2 x 2 on.
float stepped_value(Rounded value, Rounded x, Rounded y, Rounded right, Rounded down, int i, int j) {
    const Rounded half{0.5f};
    Rounded at = value - (right * (x - half) + down * (y - half));
    at = at + right * Rounded{static_cast<float>(i / 2 * 2)};
    at = at + down * Rounded{static_cast<float>(j / 2 * 2)};
    if (i % 2 == 1) at = at + right;
    if (j % 2 == 1) at = at + down;
    return at.v;
}

float stepped_line(const ClipVertex& a, const ClipVertex& b, float va, float vb, int i, int j) {
    const Rounded dx = Rounded{b.x} - Rounded{a.x}, dy = Rounded{b.y} - Rounded{a.y};
    const Rounded inverse = Rounded{1.0f} / (dx * dx + dy * dy), change = Rounded{vb} - Rounded{va};
    return stepped_value({va}, {a.x}, {a.y}, change * dx * inverse, change * dy * inverse, i, j);
}

}  // namespace

TEST_CASE("softpipe's thin lines step from the pixel of their start to that of their end") {
    Random random{1};
    int wrong = 0, covered = 0;
    for (int i = 0; i < 3000; ++i) {
        const int unit = i % 3 == 0 ? 2 : 64, reach = i % 5 == 0 ? 4 * unit : line_window * unit;
        const auto any = [&] { return random_int(random, 0, line_window * unit); };
        const auto near = [&](int v) {
            return std::clamp(v + random_int(random, -reach, reach), 0, line_window * unit);
        };
        const int ax = any(), ay = any(), bx = i % 7 == 0 ? ax : near(ax), by = i % 11 == 0 ? ay : near(ay);
        const PixelSet drawn =
            pixels_of(softpipe_fragments({vertex_of(ax, ay, unit), vertex_of(bx, by, unit)}, Primitive::lines,
                                         state_of_width(i % 2 == 0 ? 1.0f : 1.49f)));
        covered += static_cast<int>(drawn.size());
        wrong += drawn != stepped(ax / unit, ay / unit, bx / unit, by / unit) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 30000);
}

// The line runs a whole number of pixels along its longer axis with a slope of at most 1 in sixteenths; its ends are
// odd multiples of 1/64, so that no centre is on a side.
TEST_CASE("softpipe's wide lines are parallelograms, half a pixel back, an eighth to the right or upwards") {
    Random random{2};
    int wrong = 0, covered = 0;
    for (int i = 0; i < 600; ++i) {
        const bool is_x = i % 2 == 0;
        const int run = random_int(random, 1, 24) * sign_of(random_int(random, -1, 0)),
                  slope = random_int(random, -15, 15), width = random_int(random, 12, 60);  // eighths of a pixel
        const auto odd = [&] { return 2 * random_int(random, 32 * 18, 32 * 30) + 1; };
        const int along = odd(), across = odd(), end = along + 64 * run, across_end = across + 4 * run * slope;
        const auto vertex = [&](int u, int v) { return is_x ? vertex_of(u, v, 64) : vertex_of(v, u, 64); };
        const std::vector<Fragment> fragments =
            softpipe_fragments({vertex(along, across), vertex(end, across_end)}, Primitive::lines,
                               state_of_width(static_cast<float>(width) / 8));
        const Rational back = run > 0 ? Rational{-1, 2} : Rational{1, 2}, half{width, 16},
                       moved = is_x ? Rational{-1, 8} : Rational{1, 8};
        const PixelSet expected = pixels_where([&](int x, int y) {
            const Rational u = Rational{2 * (is_x ? x : y) + 1, 2} - back, v{2 * (is_x ? y : x) + 1, 2};
            const Rational line = Rational{across, 64} + Rational{slope, 16} * (u - Rational{along, 64});
            return u > std::min(Rational{along, 64}, Rational{end, 64}) &&
                   u < std::max(Rational{along, 64}, Rational{end, 64}) && abs(v - line - moved) < half;
        });
        covered += static_cast<int>(expected.size());
        wrong += pixels_of(fragments) != expected || fragments.size() != expected.size() ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 10000);
}

TEST_CASE("softpipe's points are squares, an eighth of a pixel to the right and upwards, of any size") {
    Random random{3};
    int wrong = 0;
    for (int i = 0; i < 1500; ++i) {
        const int x = random_int(random, 0, 48 * 16), y = random_int(random, 0, 48 * 16),
                  size = random_int(random, 1, 160);
        RasterState state = state_of_width(static_cast<float>(size) / 16);
        state.cull = CullFace::front_and_back;
        const std::vector<Fragment> fragments = softpipe_fragments({vertex_of(x, y, 16)}, Primitive::points, state);
        const PixelSet expected = pixels_where([&](int px, int py) {  // in 32ths of a pixel
            const int right = 32 * px + 16 - 2 * x - 4, down = 32 * py + 16 - 2 * y + 4;
            return right > -size && right <= size && down >= -size && down < size;
        });
        wrong += pixels_of(fragments) != expected || fragments.size() != expected.size() ? 1 : 0;
        for (const Fragment& f : fragments) wrong += !f.front_facing || f.shader_z != 0.5f ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("softpipe's points and lines are at most 255 pixels wide") {
    // Their middle is 128 pixels to the right of column 32: the left side is at 32 1/2, and an eighth.
    const ClipVertex p = vertex_of(160, 20, 1), upper = vertex_of(160, 0, 1), lower = vertex_of(160, 48, 1);
    const auto columns = [](const std::vector<Fragment>& fragments) {
        std::set<int> all;
        for (const Fragment& f : fragments) all.insert(f.x);
        return all;
    };
    const std::vector<Fragment> point = softpipe_fragments({p}, Primitive::points, state_of_width(300)),
                                line = softpipe_fragments({upper, lower}, Primitive::lines, state_of_width(300));
    CHECK(*columns(point).begin() == 33);
    CHECK(*columns(line).begin() == 33);
    CHECK(*columns(softpipe_fragments({p}, Primitive::points, state_of_width(253))).begin() == 34);
}

TEST_CASE("depths and colours of softpipe's thin lines change along the line by the steps of their rule") {
    Random random{4};
    int wrong = 0, seen = 0;
    for (int i = 0; i < 200; ++i) {
        const std::array<ClipVertex, 2> ends = random_ends(random);
        const Geometry g = shapes({ends[0], ends[1]}, Primitive::lines, line_state(), softpipe_shapes);
        for (const Fragment& f : draw(g).fragments) {
            ++seen;
            wrong += wrong_values(g, ends, f, stepped_line, [](Rounded over, Rounded under) { return over / under; });
        }
    }
    CHECK(wrong == 0);
    CHECK(seen > 2000);
}

TEST_CASE("softpipe's sprites have texture coordinates from corner to corner") {
    RasterState state = state_of_width(8);
    state.point_sprites = true;
    ClipVertex point = vertex_of(16 * 20, 16 * 20, 16);
    point.texcoord = {7, -3};
    const std::vector<Fragment> fragments = softpipe_fragments({point}, Primitive::points, state);
    REQUIRE(fragments.size() == 64);
    int wrong = 0;
    for (const Fragment& f : fragments) {  // the square begins at 16 1/8 and 15 7/8: exact in binary32
        wrong += Rational{f.texcoord[0]} != Rational{8 * f.x + 4 - 129, 64} ? 1 : 0;
        wrong += Rational{f.texcoord[1]} != Rational{8 * f.y + 4 - 127, 64} ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("softpipe's lines and points need its spans and planes") {
    CHECK(draws(softpipe_shapes, Primitive::lines));
    CHECK(draws(softpipe_shapes, Primitive::points));
    RasterRules other = softpipe_shapes;
    other.plane_rule = PlaneRule::exact;
    CHECK_FALSE(draws(other, Primitive::lines));
    other = softpipe_shapes;
    other.coverage = CoverageRule::snapped_edges;
    CHECK_FALSE(draws(other, Primitive::points));
    other = softpipe_shapes;
    other.lines = LineRule::diamond_exit;
    CHECK_FALSE(draws(other, Primitive::lines));
    RasterState state = state_of_width(3);
    state.polygon_stipple = PolygonStipple{};
    CHECK_THROWS_AS(shapes({vertex_of(9, 9, 1)}, Primitive::points, state, softpipe_shapes), strata::InputError);
}
