// Tests the texture coordinates of point sprites against lines-and-points.md 5.1, in rationals.
#include <catch2/catch.hpp>

#include "tests/rasterizer/lines.h"

namespace {

using namespace strata::rasterizer;

RasterState sprite_state(float size) {
    RasterState state = line_state();
    state.point_size_px = size;
    state.point_sprites = true;
    return state;
}

std::vector<Fragment> drawn_point(SubpixelPoint p, int bits, const RasterState& state, const RasterRules& rules) {
    ClipVertex vertex = vertex_at(p, bits);
    vertex.texcoord = {7, -3};
    return draw(shapes({vertex}, Primitive::points, state, rules)).fragments;
}

}  // namespace

TEST_CASE("a square point's texture coordinates are distances from its upper left corner") {
    Random random{21};
    const RasterRules rules{.points = PointRule::square};
    int wrong = 0, fragments = 0;
    for (int i = 0; i < 300; ++i) {
        const float size = i % 2 == 0 ? static_cast<float>(random_int(random, 1, 40)) : random_float(random, 0.5f, 40);
        const SubpixelPoint p{random_int(random, -2000, 14000), random_int(random, 0, 12000)};
        const auto coordinate = [&](int pixel, int at) {
            return nearest_float(Rational{1, 2} + (pixel + Rational{1, 2} - Rational{at, 256}) / Rational{size});
        };
        for (const Fragment& f : drawn_point(p, 8, sprite_state(size), rules)) {
            wrong += f.texcoord[0] != coordinate(f.x, p.x) || f.texcoord[1] != coordinate(f.y, p.y) ? 1 : 0;
            ++fragments;
        }
    }
    CHECK(wrong == 0);
    CHECK(fragments > 20000);
}

TEST_CASE("NV2A's points have the coordinates of their coverage, cut to 24 bits") {
    Random random{22};
    int wrong = 0;
    for (int size = 0; size <= 511; ++size) {
        const SubpixelPoint p{random_int(random, -200, 900), random_int(random, -200, 900)};
        const auto coordinate = [&](int pixel, int at) {
            if (size == 0) return Rational{1, 2};
            const Rational reciprocal = truncate_to_bits(Rational{1, size}, 24);
            return truncate_to_bits(Rational{1, 2} + (16 * pixel + 8 - at) * reciprocal / 2, 24);
        };
        const RasterState state = sprite_state(static_cast<float>(size) / 8);
        for (const Fragment& f : drawn_point(p, 4, state, chip_lines))
            wrong += Rational{f.texcoord[0]} != coordinate(f.x, p.x) || Rational{f.texcoord[1]} != coordinate(f.y, p.y)
                         ? 1
                         : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("only points are sprites, and only where they are asked for") {
    const SubpixelPoint p{16 * 20, 16 * 20};
    RasterState state = sprite_state(4);
    state.point_sprites = false;
    for (const Fragment& f : drawn_point(p, 4, state, chip_lines)) CHECK(f.texcoord == std::array{7.0f, -3.0f});
    state.point_sprites = true;
    ClipVertex a = vertex_at(p, 4), b = vertex_at({16 * 30, 16 * 24}, 4);
    a.texcoord = b.texcoord = {7, -3};
    for (const Fragment& f : draw(shapes({a, b}, Primitive::lines, state, chip_lines)).fragments)
        CHECK(f.texcoord == std::array{7.0f, -3.0f});
}
