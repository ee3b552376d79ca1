// Tests NV2A's smooth lines and polygons against lines-and-points.md 3.2: eight samples of a pixel, the alpha of their
// number, and colours beyond ends and sides.
#include <catch2/catch.hpp>
#include <map>

#include "tests/rasterizer/lines.h"

namespace {

using namespace strata::rasterizer;

using AlphaOfPixel = std::map<std::pair<int, int>, float>;

constexpr float corner_alpha = 1.0f;

const RasterRules smooth_rules = [] {
    RasterRules rules = chip_lines;
    rules.color = ColorInterpolation::weights_8bit;
    return rules;
}();

AlphaOfPixel alphas_of(const Geometry& geometry) {
    AlphaOfPixel alphas;
    for (const Fragment& f : draw(geometry).fragments) alphas[{f.x, f.y}] = f.color[3];
    return alphas;
}

// The pixels that have a covered sample, with the alpha of their number.
template <class IsInBox, class IsCovered>
AlphaOfPixel alphas_where(const IsInBox& is_in_box, const IsCovered& is_covered) {
    AlphaOfPixel alphas;
    for (int y = 0; y < line_window; ++y)
        for (int x = 0; x < line_window; ++x) {
            int samples = 0;
            for (int k = 0; k < 8; ++k) samples += is_covered(16 * x + 2 * k, 16 * y + 2 * (3 * k % 8)) ? 1 : 0;
            if (samples == 0 || !is_in_box(x, y)) continue;
            alphas[{x, y}] = samples == 8 ? 1.0f : nearest_float(Rational{32 * samples - 1, 255});
        }
    return alphas;
}

ClipVertex colored(SubpixelPoint p, float red) {
    ClipVertex v = vertex_at(p, 4);
    v.front = v.back = {red, 1 - red, 0.5f, corner_alpha};
    return v;
}

Geometry triangle_at(const std::array<SubpixelPoint, 3>& p, const RasterState& state) {
    TriangleSoup soup;
    for (std::size_t i = 0; i < 3; ++i) soup.vertices.push_back(colored(p[i], static_cast<float>(i) / 4));
    soup.indices = {0, 1, 2};
    soup.runs = {{.index_count = 3}};
    return set_up(std::move(soup), state, smooth_rules, 1);
}

// Fill rule: a sample on a side belongs to the triangle if its inside is right of it or, on a horizontal side, below.
bool is_in_triangle(const std::array<SubpixelPoint, 3>& p, int x, int y) {
    const auto edge = [](SubpixelPoint a, SubpixelPoint b, int px, int py) -> Integer {
        return Integer{b.x - a.x} * (py - a.y) - Integer{b.y - a.y} * (px - a.x);
    };
    const Integer area = edge(p[0], p[1], p[2].x, p[2].y);
    for (std::size_t i = 0; i < 3; ++i) {
        const SubpixelPoint a = p[(i + 1) % 3], b = p[(i + 2) % 3];
        const int sign = area > 0 ? 1 : -1;
        const Integer e = sign * edge(a, b, x, y), right = -sign * (b.y - a.y), down = sign * (b.x - a.x);
        if (e < 0 || (e == 0 && !(right > 0 || (right == 0 && down > 0)))) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("smooth lines multiply alpha by the samples that their band covers") {
    Random random{11};
    RasterState state = line_state();
    state.line_style = LineStyle::smooth;
    int wrong = 0;
    std::size_t covered = 0;
    for (int i = 0; i < 600; ++i) {
        const int w = i % 3 == 0 ? random_int(random, 0, 12) : random_int(random, 0, 511);
        const RandomLine line = random_line(random, 4, 20);
        state.line_width_px = static_cast<float>(w) / 8;
        const BandModel band{line, w};
        const AlphaOfPixel drawn =
            alphas_of(shapes({colored(line.a, 0), colored(line.b, 1)}, Primitive::lines, state, smooth_rules));
        covered += drawn.size();
        wrong += drawn != alphas_where([&](int x, int y) { return band.has_in_box(x, y); },
                                       [&](int x, int y) { return band.has_within_sides(x, y); })
                     ? 1
                     : 0;
    }
    CHECK(wrong == 0);
    CHECK(covered > 20000);
}

TEST_CASE("smooth polygons multiply alpha by the samples that they cover") {
    Random random{12};
    RasterState state = line_state();
    state.smooth_polygons = true;
    int wrong = 0, outside = 0;
    for (int i = 0; i < 600; ++i) {
        const RandomLine base = random_line(random, 4, 4);
        const std::array<SubpixelPoint, 3> p{base.a, base.b, random_line(random, 4, 4).a};
        std::array<float, 3> least{1, 1, 1}, most{0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) {
            const ClipVertex v = colored({}, static_cast<float>(k) / 4);
            for (std::size_t c = 0; c < 3; ++c) {
                const float code = std::floor(v.front[c] * 255 + 0.5f) / 255.0f;
                least[c] = std::min(least[c], code), most[c] = std::max(most[c], code);
            }
        }
        const Geometry geometry = triangle_at(p, state);
        for (const Fragment& f : draw(geometry).fragments)
            for (std::size_t c = 0; c < 3; ++c) outside += f.color[c] < least[c] || f.color[c] > most[c] ? 1 : 0;
        wrong += alphas_of(geometry) != alphas_where([](int, int) { return true; },
                                                     [&](int x, int y) { return is_in_triangle(p, x, y); })
                     ? 1
                     : 0;
    }
    CHECK(wrong == 0);
    CHECK(outside == 0);
}

TEST_CASE("a smooth line's colours beyond its ends are those of its ends") {
    RasterState state = line_state();
    state.line_style = LineStyle::smooth;
    state.line_width_px = 1;
    // The ends lie between the samples and the centre of their pixels: (16 x + 8) is beyond both.
    const RandomLine line{{16 * 4 + 11, 16 * 6 + 8}, {16 * 20 + 5, 16 * 6 + 8}};
    std::map<int, std::array<float, 4>> colors;
    for (const Fragment& f :
         draw(shapes({colored(line.a, 0.25f), colored(line.b, 0.75f)}, Primitive::lines, state, smooth_rules))
             .fragments)
        colors[f.x] = {f.color[0], f.color[1], f.color[2], f.color[3]};
    const auto code = [](float v) { return std::floor(v * 255 + 0.5f) / 255.0f; };
    REQUIRE(colors.size() == 17);
    CHECK(colors[4][0] == code(0.25f));
    CHECK(colors[4][1] == code(0.75f));
    CHECK(colors[20][0] == code(0.75f));
    CHECK(colors[20][1] == code(0.25f));
}
