// Tests the outcome of each triangle (drawn, or the reason why not) against its definition from the triangle's own
// vertices, and the path for small triangles against the general path.
#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "rasterizer/set_up/setup.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] TriangleSoup fate_soup(const std::vector<ClipVertex>& vertices) {
    TriangleSoup soup;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) soup.indices.push_back(i);
    soup.vertices.assign(vertices.begin(), vertices.end());
    soup.runs = {{0, static_cast<std::uint32_t>(vertices.size()), 0, 0, true, false}};
    return soup;
}

[[nodiscard]] ClipVertex fate_vertex(float x, float y, float w = 1) { return {x * w, y * w, 0, w, {}, {}, {}}; }

// Small and large triangles, slivers and points, some in front of and some behind everything.
[[nodiscard]] TriangleSoup mixed_soup(std::uint64_t seed, int triangles) {
    Random random{seed};
    std::vector<ClipVertex> vertices;
    for (int i = 0; i < triangles; ++i) {
        const float x = random_float(random, -1.2f, 1.2f), y = random_float(random, -1.2f, 1.2f);
        const float size = std::array{0.002f, 0.01f, 0.1f, 0.3f, 2.5f}[random() % 5];
        for (int k = 0; k < 3; ++k) {
            ClipVertex v = fate_vertex(x + size * random_float(random, -1, 1), y + size * random_float(random, -1, 1),
                                       random_float(random, 0.5f, 2));
            v.z = random_float(random, -1.1f, 1.1f) * v.w;
            if (i % 17 == 0) v.w = -v.w;
            vertices.push_back(v);
        }
        if (i % 13 == 0) vertices.back() = vertices[vertices.size() - 2];
        if (i % 29 == 0) vertices.back().y = std::numeric_limits<float>::infinity();
    }
    TriangleSoup soup = fate_soup(vertices);
    const auto half = static_cast<std::uint32_t>(triangles / 2 * 3), all = static_cast<std::uint32_t>(triangles * 3);
    soup.runs = {{0, half, 7, 0, true, false}, {half, all - half, 8, 0, false, true}};
    return soup;
}

[[nodiscard]] std::vector<RasterState> fate_states() {
    std::vector<RasterState> states;
    for (const CullFace cull : {CullFace::none, CullFace::front, CullFace::back, CullFace::front_and_back})
        for (const FrontFace front : {FrontFace::counter_clockwise, FrontFace::clockwise})
            for (const bool clamp : {false, true}) {
                RasterState state = scene_state(70, 50);
                state.cull = cull;
                state.front_face = front;
                state.depth_clamp = clamp;
                state.y_direction = clamp ? YDirection::down : YDirection::up;
                states.push_back(state);
            }
    return states;
}

}  // namespace

TEST_CASE("every source triangle has one outcome and is drawn or counted once among those that are not") {
    const TriangleSoup soup = mixed_soup(631, 600);
    std::uint64_t wrong = 0;
    std::array<std::uint64_t, 5> seen{};
    for (const RasterState& state : fate_states())
        for (const WClip w_clip : {WClip::clip, WClip::drop})
            for (const int bits : {4, 8}) {
                const Geometry g = set_up(soup, state, {.subpixel_bits = bits, .w_clip = w_clip}, 1);
                std::set<std::uint32_t> drawn;
                for (const TriangleRecord& t : g.triangles) drawn.insert(t.primitive);
                const SetupCounters& c = g.counters;
                wrong += c.triangles_in != 600 ? 1 : 0;
                wrong += drawn.size() + c.culled + c.outside + c.degenerate + c.uncovered + c.non_finite != 600 ? 1 : 0;
                wrong += c.non_finite != 600 / 29 + 1 ? 1 : 0;
                seen[0] += c.culled, seen[1] += c.outside, seen[2] += c.degenerate, seen[3] += c.clipped;
                seen[4] += c.uncovered;
            }
    CHECK(wrong == 0);
    for (const std::uint64_t count : seen) CHECK(count > 100);
}

TEST_CASE("small triangles get the same records and counts as on the general path") {
    // Polygon offset, even an offset of 0, forces the general path.
    const TriangleSoup soup = mixed_soup(632, 900);
    std::uint64_t wrong = 0, triangles = 0;
    for (const RasterState& state : fate_states())
        for (const int bits : {4, 8, 12}) {
            const RasterRules rules{.subpixel_bits = bits};
            RasterState general = state;
            general.polygon_offset = {true, 0.0f, 0.0f};
            const Geometry a = set_up(soup, state, rules, 1), b = set_up(soup, general, rules, 1);
            wrong += a.counters == b.counters ? 0 : 1;
            REQUIRE(a.triangles.size() == b.triangles.size());
            for (std::size_t i = 0; i < a.triangles.size(); ++i, ++triangles) {
                const TriangleRecord &s = a.triangles[i], &t = b.triangles[i];
                const bool same = s.vertex == t.vertex && s.primitive == t.primitive && s.material == t.material &&
                                  s.front_facing == t.front_facing && s.box.x0 == t.box.x0 && s.box.y0 == t.box.y0 &&
                                  s.box.x1 == t.box.x1 && s.box.y1 == t.box.y1;
                wrong += same && a.depths(i) == b.depths(i) ? 0 : 1;
            }
        }
    CHECK(triangles > 4000);
    CHECK(wrong == 0);
}

TEST_CASE("a triangle's box has exactly the pixels of the viewport whose centres are between its outermost corners") {
    const TriangleSoup soup = mixed_soup(633, 600);
    RasterState state;
    state.viewport = {11, 5, 81, 55};
    std::uint64_t wrong = 0, boxes = 0;
    for (const int bits : {4, 8}) {
        const Geometry g = set_up(soup, state, {.subpixel_bits = bits}, 1);
        for (const TriangleRecord& t : g.triangles) {
            const auto p = g.points(t);
            const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
            const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
            int columns = 0, rows = 0, first_column = -1, first_row = -1;
            for (int x = 0; x < 70; ++x) {
                const int at = model_centre(x + 11, 0, bits).x;
                if (at < left || at > right) continue;
                if (columns++ == 0) first_column = x;
            }
            for (int y = 0; y < 50; ++y) {
                const int at = model_centre(0, y + 5, bits).y;
                if (at < top || at > bottom) continue;
                if (rows++ == 0) first_row = y;
            }
            ++boxes;
            wrong += t.box.x0 != first_column || t.box.y0 != first_row || t.box.x1 - t.box.x0 != columns ||
                             t.box.y1 - t.box.y0 != rows
                         ? 1
                         : 0;
        }
    }
    CHECK(boxes > 300);
    CHECK(wrong == 0);
}

TEST_CASE("a colour over w that is not finite drops the triangle only on the side that shows it") {
    for (const bool reversed : {false, true})
        for (const bool bad_front : {false, true})
            for (const float size : {0.02f, 1.0f}) {  // few pixels, or many
                std::vector<ClipVertex> v{fate_vertex(-size, -size, 0x1p-40f), fate_vertex(size, -size, 0x1p-40f),
                                          fate_vertex(0, size, 0x1p-40f)};
                (bad_front ? v[1].front : v[1].back)[2] = 0x1p100f;
                TriangleSoup soup = fate_soup(v);
                if (reversed) std::swap(soup.indices[0], soup.indices[1]);
                const Geometry g = set_up(soup, scene_state(200, 200), {}, 1);
                const bool shows_front = !reversed;
                CHECK(g.counters.non_finite == (shows_front == bad_front ? 1u : 0u));
                CHECK(g.triangles.size() == (shows_front == bad_front ? 0u : 1u));
            }
}

TEST_CASE("a clipped triangle counts as clipped if a piece is kept or culled and as outside if nothing is left") {
    const auto counters = [](const std::vector<ClipVertex>& v, CullFace cull = CullFace::none) {
        TriangleSoup soup = fate_soup(v);
        soup.runs[0].double_sided = false;
        RasterState state = scene_state(32, 32);
        state.cull = cull;
        state.clip_plane_count = 1;
        state.clip_planes[0] = {1, 0, 0, 0};  // x >= 0
        return set_up(soup, state, {}, 1).counters;
    };
    const std::vector<ClipVertex> across{fate_vertex(-0.5f, -0.5f), fate_vertex(0.5f, -0.5f), fate_vertex(0.25f, 0.5f)};
    CHECK(counters(across) == SetupCounters{.triangles_in = 1, .clipped = 1});
    CHECK(counters(across, CullFace::front) == SetupCounters{.triangles_in = 1, .culled = 1, .clipped = 1});
    // The remaining piece is between pixel centres.
    const std::vector<ClipVertex> barely{fate_vertex(-0.5f, 0.1f), fate_vertex(0.01f, 0.11f), fate_vertex(-0.5f, 0.2f)};
    CHECK(counters(barely) == SetupCounters{.triangles_in = 1, .outside = 1});
    const std::vector<ClipVertex> beyond{fate_vertex(-0.5f, 0.1f), fate_vertex(-0.1f, 0.1f), fate_vertex(-0.5f, 0.2f)};
    CHECK(counters(beyond) == SetupCounters{.triangles_in = 1, .outside = 1});
}

TEST_CASE("a clipped triangle is kept if any piece is drawn regardless of its other pieces") {
    Random random{634};
    std::uint64_t wrong = 0, in_parts = 0, slivers = 0;
    for (int n = 0; n < 4000; ++n) {
        std::vector<ClipVertex> v;
        for (int k = 0; k < 3; ++k) {
            const float x = random_float(random, -9, 9), y = random_float(random, -9, 9);
            v.push_back(fate_vertex(x, y));
        }
        RasterState state = scene_state(4, 4);
        state.clip_plane_count = 2;
        state.clip_planes[0] = {1, 0, 0, 1};
        state.clip_planes[1] = {0, 1, 0, 1};
        const Geometry g = set_up(fate_soup(v), state, {.guard_band_px = 6}, 1);
        // A sliver whose pieces all snap to no area is degenerate, and is also counted as clipped.
        const SetupCounters kept{.triangles_in = 1, .clipped = 1}, outside{.triangles_in = 1, .outside = 1},
            sliver{.triangles_in = 1, .clipped = 1, .degenerate = 1},
            between{.triangles_in = 1, .clipped = 1, .uncovered = 1};
        const bool is_lost = g.counters == outside || g.counters == sliver || g.counters == between;
        const bool is_right = g.triangles.empty() ? is_lost : g.counters == kept;
        slivers += g.counters == sliver ? 1 : 0;
        if (g.counters.clipped == 0 && !g.triangles.empty()) continue;  // not clipped
        in_parts += g.triangles.size() > 1 ? 1 : 0;
        wrong += is_right ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(in_parts > 100);
    CHECK(slivers < 10);
}

TEST_CASE(
    "window positions are snapped and limited to the guard band with z unchanged and w used for attributes only") {
    RasterState state;
    state.viewport = {10, 20, 74, 68};
    state.window_positions = true;
    state.depth_near = 0.25f;
    for (const Snap snap_rule : {Snap::toward_zero, Snap::nearest_even})
        for (const YDirection y : {YDirection::up, YDirection::down}) {
            state.y_direction = y;
            const std::vector<ClipVertex> v{{.x = 12.34f, .y = 21.07f, .z = -7.5f, .w = 4},
                                            {.x = 60.93f, .y = 30.56f, .z = 0.125f, .w = 0.5f},
                                            {.x = 20.0f, .y = 5000.0f, .z = 99.0f, .w = 2}};
            const Geometry g =
                set_up(fate_soup(v), state, {.subpixel_bits = 4, .snap = snap_rule, .guard_band_px = 300}, 1);
            REQUIRE(g.triangles.size() == 1);
            const SetupTriangle t = g.triangle(0);
            const bool nearest = snap_rule == Snap::nearest_even;
            CHECK(t.p[0] == SubpixelPoint{197, 337});                                  // 197.44, 337.12
            CHECK(t.p[1] == SubpixelPoint{nearest ? 975 : 974, nearest ? 489 : 488});  // 974.88, 488.96
            CHECK(t.p[2] == SubpixelPoint{320, 4800});
            CHECK(t.z == std::array{-7.5, 0.125, 99.0});
            CHECK(t.inverse_w == std::array{0.25f, 2.0f, 0.5f});
            CHECK(t.unsnapped[1] == std::array{60.93f, 30.56f});
            CHECK(t.unsnapped[2] == std::array{20.0f, 300.0f});
        }
}
