// Tests OpenGL's aliased lines against its text, in rationals: a diamond around every centre, ends that are moved by
// (-e, -e^2) with a small e, and fragments that are repeated across wide lines.
#include "rasterizer/coverage/diamond_exit.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/lines.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata::rasterizer;

constexpr int tie_bits = 4;  // ties are frequent
const RasterRules opengl{.subpixel_bits = tie_bits, .lines = LineRule::diamond_exit};

struct RealPoint {
    Rational x, y;
};

// In pixels with y up, moved.
RealPoint moved(SubpixelPoint p) {
    return {Rational{p.x, 1 << tie_bits} - power(-40), Rational{-p.y, 1 << tie_bits} - power(-80)};
}

// OpenGL's region: |x - xc| + |y - yc| < 1/2, y up.
Rational diamond_distance(const RealPoint& p, int x, int y) {
    return abs(p.x - x - Rational{1, 2}) + abs(p.y + y + Rational{1, 2});
}

// The least distance along the segment: at an end, or where it crosses the region's axes.
bool meets_diamond(const RealPoint& a, const RealPoint& b, int x, int y) {
    if (std::max(a.x, b.x) < x || std::min(a.x, b.x) > x + 1 || std::max(a.y, b.y) < -y - 1 || std::min(a.y, b.y) > -y)
        return false;  // beside the pixel's square
    std::vector<Rational> at{0, 1};
    if (a.x != b.x) at.push_back((x + Rational{1, 2} - a.x) / (b.x - a.x));
    if (a.y != b.y) at.push_back((-y - Rational{1, 2} - a.y) / (b.y - a.y));
    return std::ranges::any_of(at, [&](const Rational& t) {
        return t >= 0 && t <= 1 &&
               diamond_distance({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}, x, y) < Rational{1, 2};
    });
}

PixelSet diamond_model(const RandomLine& line) {
    const RealPoint a = moved(line.a), b = moved(line.b);
    return pixels_where([&](int x, int y) {
        return meets_diamond(a, b, x, y) && diamond_distance(b, x, y) >= Rational{1, 2};
    });
}

}  // namespace

TEST_CASE("an aliased line has the diamonds that it leaves") {
    Random random{1};
    int wrong = 0, covered = 0;
    for (int i = 0; i < 400; ++i) {
        const RandomLine line = random_line(random, tie_bits, 6);
        const PixelSet drawn = drawn_line(line, line_state(), opengl);
        covered += static_cast<int>(drawn.size());
        wrong += drawn != diamond_model(line) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 3000);
}

TEST_CASE("a wide line repeats its fragments across the longer direction") {
    Random random{2};
    RasterState state = line_state();
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const RandomLine line = random_line(random, tie_bits, 6);
        const int width = 1 + i % 7;
        state.line_width_px = static_cast<float>(width) + (i % 2 == 0 ? 0.25f : -0.25f);
        const bool by_columns = std::abs(line.b.x - line.a.x) >= std::abs(line.b.y - line.a.y);
        // The line one pixel wide, moved down (left) by half of the rest, and `width` copies of it upwards (to the
        // right). Half pixels are whole subpixels.
        const int shift = (width - 1) * (1 << tie_bits) / 2;
        RandomLine lowest = line;
        for (SubpixelPoint* p : {&lowest.a, &lowest.b}) (by_columns ? p->y : p->x) += by_columns ? shift : -shift;
        const int margin = 8;
        PixelSet expected;
        const auto offset = [&](RandomLine l) {
            for (SubpixelPoint* p : {&l.a, &l.b}) p->x += margin << tie_bits, p->y += margin << tie_bits;
            return l;
        };
        RasterState large = line_state();
        large.viewport = {0, 0, line_window + 2 * margin, line_window + 2 * margin};
        for (const auto& [x, y] : drawn_line(offset(lowest), large, opengl))
            for (int k = 0; k < width; ++k) {
                const int px = x - margin + (by_columns ? 0 : k), py = y - margin - (by_columns ? k : 0);
                if (px >= 0 && py >= 0 && px < line_window && py < line_window) expected.insert({px, py});
            }
        wrong += drawn_line(line, state, opengl) != expected ? 1 : 0;
    }
    CHECK(wrong == 0);
}
