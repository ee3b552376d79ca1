// Tests the coverage of NV2A's lines and of points against the formulas of lines-and-points.md, pixel by pixel, in
// rationals and integers.
#include "rasterizer/coverage/line_coverage.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/lines.h"

namespace {

using namespace strata::rasterizer;

PixelSet band_model(const RandomLine& line, int w) {
    const BandModel band{line, w};
    return pixels_where(
        [&](int x, int y) { return band.has_in_box(x, y) && band.has_within_sides(16 * x + 8, 16 * y + 8); });
}

// Rule 3: walks the columns (rows).
PixelSet thin_model(const RandomLine& line) {
    const auto& [a, b] = line;
    const auto cx = [](const Rational& v) { return floor(v / 16).convert_to<int>(); };
    const auto cy = [](const Rational& v) { return -floor(-v / 16).convert_to<int>() - 1; };
    const int dx = b.x - a.x, dy = b.y - a.y;
    PixelSet pixels;
    const bool by_columns = std::abs(dx) >= std::abs(dy);
    const int from = by_columns ? cx(a.x) : cy(a.y), to = by_columns ? cx(b.x) : cy(b.y);
    for (int i = from; i != to; i += from < to ? 1 : -1) {
        const int middle = 16 * i + 8;
        const int x = by_columns ? i : cx(a.x + Rational{dx} * (middle - a.y) / dy);
        const int y = by_columns ? cy(a.y + Rational{dy} * (middle - a.x) / dx) : i;
        if (x >= 0 && y >= 0 && x < line_window && y < line_window) pixels.insert({x, y});
    }
    return pixels;
}

// Rule 5: `s` eighths of a pixel.
bool point_model(int c, int p, int s) {
    if (s == 0) return c == 16 * floor(Rational{p, 16}).convert_to<int>() + 8;
    const Rational u = Rational{1, 2} + (c - p) * truncate_to_bits(Rational{1, s}, 24) / 2;
    return u >= 0 && u < 1;
}

}  // namespace

TEST_CASE("band lines of every width cover the pixels of the formula") {
    Random random{1};
    RasterState state = line_state();
    int wrong = 0, covered = 0;
    for (int i = 0; i < 1500; ++i) {
        const int w = i % 3 == 0 ? random_int(random, 0, 12) : random_int(random, 0, 511);
        const RandomLine line = random_line(random, 4, 20);
        state.line_width_px = static_cast<float>(w) / 8;
        const PixelSet drawn = drawn_line(line, state, chip_lines);
        covered += static_cast<int>(drawn.size());
        wrong += drawn != band_model(line, w) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 100000);
}

TEST_CASE("a wider register than 511 is drawn as 511") {
    const RandomLine line{{-100, 300}, {700, 420}};
    RasterState state = line_state();
    state.line_width_px = 511.0f / 8;
    const PixelSet widest = drawn_line(line, state, chip_lines);
    state.line_width_px = 70;
    CHECK(drawn_line(line, state, chip_lines) == widest);
}

TEST_CASE("thin lines have a pixel per step and leave the last one out") {
    Random random{2};
    RasterState state = line_state();
    state.line_style = LineStyle::thin;
    int wrong = 0, covered = 0;
    for (int i = 0; i < 4000; ++i) {
        const RandomLine line = random_line(random, 4, 20);
        const PixelSet drawn = drawn_line(line, state, chip_lines);
        covered += static_cast<int>(drawn.size());
        wrong += drawn != thin_model(line) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 20000);
}

TEST_CASE("points of every size cover the pixels of the chip's coordinates") {
    Random random{3};
    RasterState state = line_state();
    int wrong = 0;
    for (int size = 0; size <= 511; ++size) {
        const SubpixelPoint p{random_int(random, -200, 900), random_int(random, -200, 900)};
        state.point_size_px = static_cast<float>(size) / 8;
        const PixelSet drawn = pixels_of(
            draw(shapes({vertex_at(p, 4)}, Primitive::points, state, chip_lines), {}, coverage_only).fragments);
        const PixelSet model = pixels_where(
            [&](int x, int y) { return point_model(16 * x + 8, p.x, size) && point_model(16 * y + 8, p.y, size); });
        wrong += drawn != model ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE(
    "beside thin and smooth lines a point of one pixel is that of its vertex, on a border the right and upper one") {
    Random random{5};
    RasterState state = line_state();
    for (const LineStyle style : {LineStyle::thin, LineStyle::smooth}) {
        state.line_style = style;
        for (int i = 0; i < 400; ++i) {
            SubpixelPoint p{random_int(random, 1, 16 * line_window - 1), random_int(random, 1, 16 * line_window)};
            if (i % 2 == 0) p = {p.x / 16 * 16, (p.y + 15) / 16 * 16};
            const PixelSet drawn = pixels_of(
                draw(shapes({vertex_at(p, 4)}, Primitive::points, state, chip_lines), {}, coverage_only).fragments);
            const int x = floor(Rational{p.x, 16}).convert_to<int>(),
                      y = -floor(-Rational{p.y, 16}).convert_to<int>() - 1;
            CHECK(drawn == PixelSet{{x, y}});
        }
    }
}

TEST_CASE("square points cover the centres within half their size, with the left and upper side") {
    Random random{4};
    const RasterRules rules{.points = PointRule::square};
    RasterState state = line_state();
    int wrong = 0;
    for (int i = 0; i < 500; ++i) {
        const SubpixelPoint p{random_int(random, -2000, 14000), random_int(random, 0, 100) * 128};
        const float size = i % 2 == 0 ? static_cast<float>(random_int(random, 0, 40)) : random_float(random, 0, 40);
        state.point_size_px = size;
        const auto is_in = [&](int pixel, int at) {
            const Rational c = pixel + Rational{1, 2} - Rational{at, 256}, half = Rational{size} / 2;
            return c >= -half && c < half;
        };
        const PixelSet drawn =
            pixels_of(draw(shapes({vertex_at(p, 8)}, Primitive::points, state, rules), {}, coverage_only).fragments);
        wrong += drawn != pixels_where([&](int x, int y) { return is_in(x, p.x) && is_in(y, p.y); }) ? 1 : 0;
    }
    CHECK(wrong == 0);
}
