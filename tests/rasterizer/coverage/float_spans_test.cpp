// Tests float spans against pipeline/reference/mesa-rasterizers.md 3.1 and 3.2 in rational arithmetic, each operation
// rounded to binary32 by definition, pixel by pixel.
#include "rasterizer/coverage/float_spans.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;
using Pixels = std::set<std::pair<int, int>>;

struct SpanSide {
    float slope, x, y;
    int rows;
};

[[nodiscard]] float rounded(const Rational& v) { return nearest_float(v); }
[[nodiscard]] int ceiling(float v) { return -floor(-Rational{v}).convert_to<int>(); }
[[nodiscard]] int toward_zero(float v) { return static_cast<int>(v); }
[[nodiscard]] float minus(float a, float b) { return rounded(Rational{a} - Rational{b}); }
[[nodiscard]] float plus(float a, float b) { return rounded(Rational{a} + Rational{b}); }
[[nodiscard]] float times(float a, float b) { return rounded(Rational{a} * Rational{b}); }

[[nodiscard]] SpanSide side_of(const WindowPosition& from, const WindowPosition& to) {
    const float dx = minus(to[0], from[0]), dy = minus(to[1], from[1]);
    const float x = plus(from[0], 0.5f), y = minus(from[1], 0.5f), end = minus(to[1], 0.5f);
    SpanSide s{};
    s.slope = dy == 0 ? 0 : rounded(Rational{dx} / Rational{dy});
    s.y = static_cast<float>(ceiling(y));
    s.rows = ceiling(minus(end, s.y));
    s.x = plus(x, times(minus(s.y, y), s.slope));
    return s;
}

void add_part(SpanSide& left, SpanSide& right, int rows, const Rect& frame, Pixels& pixels) {
    for (int k = 0; k < rows; ++k) {
        const int y = toward_zero(left.y) + k;
        const int x0 = toward_zero(plus(left.x, times(static_cast<float>(k), left.slope)));
        const int x1 = toward_zero(plus(right.x, times(static_cast<float>(k), right.slope)));
        for (int x = std::max(x0, frame.x0); x < std::min(x1, frame.x1); ++x)
            if (y >= frame.y0 && y < frame.y1) pixels.insert({y, x});
    }
    for (SpanSide* s : {&left, &right}) {
        s->x = plus(s->x, times(static_cast<float>(rows), s->slope));
        s->y = plus(s->y, static_cast<float>(rows));
    }
}

[[nodiscard]] Pixels model_pixels(std::array<WindowPosition, 3> p, const Rect& frame) {
    // The order by the page's three comparisons of y; of two equal ones the earlier corner around the triangle comes
    // first.
    const auto [y0, y1, y2] = std::array{p[0][1], p[1][1], p[2][1]};
    if (y0 <= y1 && y1 > y2) p = y2 <= y0 ? std::array{p[2], p[0], p[1]} : std::array{p[0], p[2], p[1]};
    if (y0 > y1)
        p = y0 <= y2   ? std::array{p[1], p[0], p[2]}
            : y2 <= y1 ? std::array{p[2], p[1], p[0]}
                       : std::array{p[1], p[2], p[0]};
    const auto dx = [&](std::size_t a, std::size_t b) { return minus(p[a][0], p[b][0]); };
    const auto dy = [&](std::size_t a, std::size_t b) { return minus(p[a][1], p[b][1]); };
    const float area = minus(times(dx(2, 0), dy(1, 0)), times(dx(1, 0), dy(2, 0)));
    Pixels pixels;
    if (area == 0) return pixels;
    SpanSide bot = side_of(p[0], p[1]), maj = side_of(p[0], p[2]), top = side_of(p[1], p[2]);
    const int first = bot.rows, second = top.rows;
    add_part(area < 0 ? maj : bot, area < 0 ? bot : maj, first, frame, pixels);
    add_part(area < 0 ? maj : top, area < 0 ? top : maj, second, frame, pixels);
    return pixels;
}

[[nodiscard]] RasterRules span_rules() {
    return {.coverage = CoverageRule::float_spans, .plane_origin = PlaneOrigin::unsnapped};
}

[[nodiscard]] ClipVertex vertex_at(float x, float y, int width, int height) {
    ClipVertex v;
    v.x = 2 * x / static_cast<float>(width) - 1;
    v.y = 1 - 2 * y / static_cast<float>(height);
    return v;
}

}  // namespace

TEST_CASE("float spans cover the pixels of the rule's rounded steps for any tiles", "[slow]") {
    constexpr int width = 96, height = 64;
    Random random{521};
    TriangleSoup soup;
    for (int n = 0; n < 300; ++n)
        for (int k = 0; k < 3; ++k) {
            // Every third triangle has corners on pixel centres, where ties decide.
            const float unit = n % 3 == 0 ? 1.0f : 0.0f;
            float x = random_float(random, 0, width), y = random_float(random, 0, height);
            if (unit != 0)
                x = static_cast<float>(static_cast<int>(x)) + 0.5f, y = static_cast<float>(static_cast<int>(y)) + 0.5f;
            soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
            soup.vertices.push_back(vertex_at(x, y, width, height));
        }
    soup.runs = {{0, static_cast<std::uint32_t>(soup.indices.size()), 0, 0, true, false}};
    Geometry geometry = set_up(soup, scene_state(width, height), span_rules(), 1);
    std::vector<Pixels> expected(300), found(300), tiled(300);
    std::size_t pixels = 0;
    for (const TriangleRecord& t : geometry.triangles) {
        expected[t.primitive] = model_pixels(geometry.positions(t), geometry.state.viewport);
        pixels += expected[t.primitive].size();
    }
    for (const Fragment& f : draw(geometry, {}, coverage_only).fragments) found[f.primitive].insert({f.y, f.x});
    bin_triangles(geometry, 16);
    for (std::size_t tile = 0; tile + 1 < geometry.bin_start.size(); ++tile) {
        const DrawResult part = draw(geometry, {}, coverage_only, tile_rect(geometry, tile), geometry.bin(tile));
        CHECK(part.batches_are_sound);
        for (const Fragment& f : part.fragments) tiled[f.primitive].insert({f.y, f.x});
    }
    CHECK(found == expected);
    CHECK(tiled == expected);
    CHECK(pixels > 50000);
}

TEST_CASE("a small triangle's record has the box of its pixels and one in a small box without pixels has no record") {
    constexpr int width = 96, height = 64;
    Random random{523};
    TriangleSoup soup;
    std::vector<std::array<WindowPosition, 3>> corners;
    for (int n = 0; n < 3000; ++n) {
        const float size = n % 4 == 0 ? 12.0f : 3.0f;  // boxes of up to 16 pixels
        const float x = random_float(random, 4, width - 4 - size), y = random_float(random, 4, height - 4 - size);
        for (int k = 0; k < 3; ++k) {
            soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
            soup.vertices.push_back(
                vertex_at(x + random_float(random, 0, size), y + random_float(random, 0, size), width, height));
        }
    }
    soup.runs = {{0, static_cast<std::uint32_t>(soup.indices.size()), 0, 0, true, false}};
    const Geometry geometry = set_up(soup, scene_state(width, height), span_rules(), 1);
    std::vector<const TriangleRecord*> record(soup.indices.size() / 3);
    for (const TriangleRecord& t : geometry.triangles) record[t.primitive] = &t;
    std::uint64_t wrong = 0, boxes = 0, uncovered = 0, large = 0;
    for (std::size_t i = 0; i < record.size(); ++i) {
        std::array<WindowPosition, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = geometry.corners[soup.indices[3 * i + k]].unsnapped;
        // The corners' pixels and two more on every side.
        const auto extent = [&](std::size_t axis) {
            const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
            return toward_zero(high) - toward_zero(low) + 5;
        };
        const Pixels pixels = model_pixels(p, geometry.state.viewport);
        if (std::max(extent(0), extent(1)) > 12) {
            wrong += record[i] == nullptr ? 1 : 0;
            ++large;
        } else if (pixels.empty()) {
            wrong += record[i] == nullptr ? 0 : 1;
            ++uncovered;
        } else {
            Rect box{width, height, 0, 0};
            for (const auto& [y, x] : pixels)
                box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
            const bool is_box = record[i] != nullptr && record[i]->box.x0 == box.x0 && record[i]->box.y0 == box.y0 &&
                                record[i]->box.x1 == box.x1 && record[i]->box.y1 == box.y1;
            wrong += is_box ? 0 : 1;
            ++boxes;
        }
    }
    CHECK(wrong == 0);
    CHECK(geometry.counters.uncovered == uncovered);
    CHECK((boxes > 1000 && uncovered > 500 && large > 100));
}

// With the library's assertions (in the sanitized builds) a walk over the columns of an empty box would end the test.
TEST_CASE("a triangle next to a region draws nothing in it because its box has no columns or no rows there") {
    const FloatSpans spans{{{{10, 10}, {10, 30}, {40.25f, 20}}}};
    int whole = 0, rows = 0;
    spans.visit({0, 0, 64, 64}, [&](int, int x0, int x1) { whole += x1 - x0; });
    CHECK(whole == 310);  // 2, 5, 8 .. 29 centres per row, and the same upwards from row 29
    for (const Rect& beside : {Rect{50, 0, 40, 64}, {48, 0, 43, 64}, {12, 0, 12, 64}, {0, 40, 64, 33}, {0, 20, 64, 20}})
        spans.visit(beside, [&](int, int, int) { ++rows; });
    CHECK(rows == 0);
}

TEST_CASE("corners of equal height keep the order that the rule's comparisons give them") {
    using Order = std::array<std::size_t, 3>;
    const auto order = [](float y0, float y1, float y2) { return by_height({{{0, y0}, {1, y1}, {2, y2}}}); };
    CHECK(order(1, 1, 1) == Order{0, 1, 2});
    CHECK(order(1, 1, 2) == Order{0, 1, 2});
    CHECK(order(1, 2, 2) == Order{0, 1, 2});
    CHECK(order(1, 2, 1) == Order{2, 0, 1});
    CHECK(order(2, 2, 1) == Order{2, 0, 1});
    CHECK(order(2, 1, 2) == Order{1, 0, 2});
    CHECK(order(2, 1, 1) == Order{2, 1, 0});
    CHECK(order(1, 3, 2) == Order{0, 2, 1});
    CHECK(order(2, 1, 3) == Order{1, 0, 2});
    CHECK(order(3, 1, 2) == Order{1, 2, 0});
    CHECK(order(3, 2, 1) == Order{2, 1, 0});
}

TEST_CASE("a triangle without a finite reciprocal area covers nothing and is counted as degenerate") {
    const std::array<WindowPosition, 3> line{{{1, 1}, {3, 3}, {2, 2}}};
    CHECK_FALSE(FloatSpans{line}.is_drawn());
    TriangleSoup soup;
    for (const auto& [x, y] : line) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
        soup.vertices.push_back(vertex_at(x, y, 8, 8));
    }
    soup.runs = {{0, 3, 0, 0, true, false}};
    const Geometry geometry = set_up(soup, scene_state(8, 8), span_rules(), 1);
    CHECK(geometry.triangles.empty());
    CHECK(geometry.counters.degenerate == 1);
}

TEST_CASE("the area whose sign is a triangle's facing is twice the exact one in whole pixels") {
    Random random{509};
    int wrong = 0;
    for (int i = 0; i < 1000; ++i) {
        std::array<WindowPosition, 3> p;
        std::array<SubpixelPoint, 3> whole;
        for (std::size_t k = 0; k < 3; ++k) {
            const int x = random_int(random, -900, 900);
            const int y = random_int(random, -900, 900);
            p[k] = {static_cast<float>(x), static_cast<float>(y)};
            whole[k] = {x, y};
        }
        wrong += Integer{static_cast<int>(float_area(p))} != doubled_area(whole[0], whole[1], whole[2]) ? 1 : 0;
    }
    CHECK(wrong == 0);
}
