// Tests the lines and points of a frame of several samples against OpenGL's text in rationals: a sample is covered if
// it lies in a rectangle around the segment, or in a square around the point.
#include "rasterizer/coverage/sample_rectangle.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/lines.h"

namespace {

using namespace strata::rasterizer;

constexpr int few_bits = 4;  // ties are frequent
const RasterRules sampled_rules{
    .subpixel_bits = few_bits, .lines = LineRule::diamond_exit, .points = PointRule::square};

struct RealSample {
    Rational x, y;
};

// Sample (x, y) sixteenths of a pixel from its upper left corner.
RealSample sample_in(int x, int y, const SamplePoint& sample) {
    return {Rational{16 * x + sample.x, 16}, Rational{16 * y + sample.y, 16}};
}
Rational in_pixels(int subpixels) { return Rational{subpixels, 1 << few_bits}; }

// On a side of value 0 the one whose inside is to the right, or below.
bool is_inside(const Rational& value, const Rational& right, const Rational& down) {
    return value > 0 || (value == 0 && (right > 0 || (right == 0 && down > 0)));
}

// The distance of a point from the segment's line is |e| / |d|: at most half the width where 4 e^2 <= w^2 |d|^2.
bool is_in_rectangle(const RandomLine& line, const Rational& width, const RealSample& s) {
    const Rational ax = in_pixels(line.a.x), ay = in_pixels(line.a.y), dx = in_pixels(line.b.x) - ax,
                   dy = in_pixels(line.b.y) - ay;
    const Rational length_squared = dx * dx + dy * dy;
    if (length_squared == 0) return false;
    const Rational e = dx * (s.y - ay) - dy * (s.x - ax), t = dx * (s.x - ax) + dy * (s.y - ay);
    const Rational beyond = width * width * length_squared - 4 * e * e;
    // Left of the direction e is negative: the side there has the inward normal (-dy, dx).
    const bool is_across = e < 0 ? is_inside(beyond, -dy, dx) : e > 0 ? is_inside(beyond, dy, -dx) : width > 0;
    return is_across && is_inside(t, dx, dy) && is_inside(length_squared - t, -dx, -dy);
}

RasterState state_of(const SamplePoint& sample) {
    RasterState state = line_state();
    state.sample = sample;
    return state;
}

SamplePoint any_sample(Random& random) { return {random_int(random, 0, 15), random_int(random, 0, 15)}; }

}  // namespace

TEST_CASE("a line covers the samples in its rectangle") {
    Random random{1};
    int wrong = 0, covered = 0;
    for (int i = 0; i < 600; ++i) {
        const RandomLine line = random_line(random, few_bits, 6);
        const SamplePoint sample = any_sample(random);
        RasterState state = state_of(sample);
        const int width = i % 5 == 0 ? 256 : i % 5 == 1 ? 512 : random_int(random, 1, 1800);
        state.line_width_px = static_cast<float>(width) / 256.0f;
        const PixelSet drawn = drawn_line(line, state, sampled_rules);
        covered += static_cast<int>(drawn.size());
        wrong += drawn != pixels_where([&](int x, int y) {
                     return is_in_rectangle(line, Rational{width, 256}, sample_in(x, y, sample));
                 })
                     ? 1
                     : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 10000);
}

TEST_CASE("collinear lines that share an end cover every sample of their sum once") {
    Random random{2};
    int wrong = 0;
    for (int i = 0; i < 200; ++i) {
        const RandomLine part = random_line(random, few_bits, 0);
        const SubpixelPoint a = part.a, m = part.b, b{2 * m.x - a.x, 2 * m.y - a.y};
        RasterState state = state_of(any_sample(random));
        state.line_width_px = 3;
        const PixelSet whole = drawn_line({a, b}, state, sampled_rules),
                       first = drawn_line({a, m}, state, sampled_rules),
                       second = drawn_line({m, b}, state, sampled_rules);
        wrong += first.size() + second.size() != whole.size() ? 1 : 0;
        for (const auto& pixel : first) wrong += second.count(pixel) > 0 || whole.count(pixel) == 0 ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a width is rounded to 1/256 pixel and one of 0 covers nothing") {
    const RandomLine line{{100, 160}, {600, 160}};
    RasterState state = state_of({8, 8});
    // 10 is a pixel's border: centres are half a pixel away.
    const auto rows = [&](float width) {
        state.line_width_px = width;
        return drawn_line(line, state, sampled_rules).size();
    };
    const std::size_t row = rows(1.0f);
    CHECK(row > 20);
    CHECK(rows(0.0f) == 0);
    CHECK(rows(1.0f - 1.0f / 256) == 0);
    CHECK(rows(1.0f - 1.0f / 1024) == row);  // rounded to 1: the lower side's centres are on a side that owns them
    CHECK(rows(1.0f + 1.0f / 256) == 2 * row);
    CHECK(rows(65536.0f) > 30 * row);
}

TEST_CASE("a point covers the samples in its square, with the left and upper side") {
    Random random{3};
    int wrong = 0, covered = 0;
    for (int i = 0; i < 300; ++i) {
        const SubpixelPoint p{random_int(random, 0, 768), random_int(random, 0, 768)};
        const SamplePoint sample = any_sample(random);
        RasterState state = state_of(sample);
        const int size = random_int(random, 1, 160);
        state.point_size_px = static_cast<float>(size) / 16.0f;
        const PixelSet drawn =
            pixels_of(draw(shapes({vertex_at(p, few_bits)}, Primitive::points, state, sampled_rules), {}, coverage_only)
                          .fragments);
        const Rational half{size, 32};
        covered += static_cast<int>(drawn.size());
        wrong += drawn != pixels_where([&](int x, int y) {
                     const RealSample s = sample_in(x, y, sample);
                     const Rational right = s.x - in_pixels(p.x), down = s.y - in_pixels(p.y);
                     return right >= -half && right < half && down >= -half && down < half;
                 })
                     ? 1
                     : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 3000);
}
