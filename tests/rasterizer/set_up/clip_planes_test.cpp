// Tests clip planes against the inequalities of clip.h's rule in rational arithmetic, and single crossings whose
// arithmetic is exact.
#include <bit>
#include <catch2/catch.hpp>

#include "rasterizer/set_up/clip.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

struct PlaneCase {
    RasterState state;
    RasterRules rules;
};

// Number of the rule's planes that a vertex is outside of.
[[nodiscard]] int planes_missed(const PlaneCase& c, const ClipVertex& v) {
    const Rational x{v.x}, y{v.y}, z{v.z}, w{v.w}, guard{c.rules.guard_band_px};
    const Rect& port = c.state.viewport;
    int missed = w < power(-64) ? 1 : 0;
    if (!c.state.depth_clamp && c.rules.z_clip == ZClip::per_primitive) {
        missed += z < (c.state.clip_depth == ClipDepth::minus_one_to_one ? Rational{-w} : Rational{0}) ? 1 : 0;
        missed += z > w ? 1 : 0;
    }
    const bool up = c.state.y_direction == YDirection::up;
    const Rational half_x{port.x1 - port.x0, 2}, half_y{port.y1 - port.y0, 2};
    // Window position times w: the inequality is that of clip space for w of either sign.
    const Rational column = (half_x + port.x0) * w + half_x * x;
    const Rational row = (half_y + port.y0) * w + (up ? Rational{-half_y} : half_y) * y;
    for (const Rational& at : {column, row}) missed += (at > guard * w ? 1 : 0) + (at < -guard * w ? 1 : 0);
    for (int i = 0; i < c.state.clip_plane_count; ++i) {
        const ClipPlane& p = c.state.clip_planes[static_cast<std::size_t>(i)];
        missed += Rational{p.a} * x + Rational{p.b} * y + Rational{p.c} * z + Rational{p.d} * w < 0 ? 1 : 0;
    }
    return missed;
}

[[nodiscard]] std::vector<PlaneCase> plane_cases() {
    std::vector<PlaneCase> cases;
    for (const int guard : {40, 96, 1000, 32768})
        for (const YDirection y : {YDirection::up, YDirection::down})
            for (const ClipDepth depth : {ClipDepth::minus_one_to_one, ClipDepth::zero_to_one})
                for (const int variant : {0, 1, 2, 3}) {
                    PlaneCase c;
                    c.state.viewport = variant % 2 == 0 ? Rect{0, 0, 64, 48} : Rect{17, 60, 90, 91};
                    c.state.y_direction = y;
                    c.state.clip_depth = depth;
                    c.state.depth_clamp = variant == 3;
                    c.rules.guard_band_px = guard;
                    c.rules.z_clip = variant == 2 ? ZClip::per_fragment : ZClip::per_primitive;
                    c.state.clip_plane_count = variant == 1 ? 6 : 0;
                    for (std::size_t i = 0; i < 6; ++i) {
                        const auto k = static_cast<float>(i);
                        c.state.clip_planes[i] = {1 - k, k - 2, 0.5f * k, 0.25f};
                    }
                    cases.push_back(c);
                }
    return cases;
}

// Few bits, so that every product and sum of four is exact; often on a plane.
[[nodiscard]] ClipVertex plane_vertex(Random& random) {
    const auto eighths = [&](int reach) { return static_cast<float>(random_int(random, -reach, reach)) / 8.0f; };
    ClipVertex v{.x = eighths(40), .y = eighths(40), .z = eighths(20), .w = eighths(16)};
    if (random_int(random, 0, 3) == 0) v.w = std::array{0.0f, 0x1p-64f, 0x1p-65f, 1.0f}[random() % 4];
    if (random_int(random, 0, 3) == 0) (random_int(random, 0, 1) == 0 ? v.x : v.y) *= 300.0f;
    if (random_int(random, 0, 3) == 0) v.z = std::array{v.w, -v.w, 0.0f, -0.0f}[random() % 4];
    return v;
}

[[nodiscard]] ClipPolygon cut_once(const Clipper& clipper, const ClipVertex& in, const ClipVertex& out) {
    ClipPolygon polygon{{in, out, in}, 3};
    clipper.clip(polygon, clipper.outside(out));
    return polygon;
}

}  // namespace

TEST_CASE("a disabled clip plane keeps everything in front of the eye") {
    CHECK(ClipPlane{} == ClipPlane{.a = 0, .b = 0, .c = 0, .d = 1});
}

TEST_CASE(
    "a vertex is outside as many planes as the rule's inequalities say for every state and bit 0 is the plane of w",
    "[slow]") {
    Random random{621};
    std::uint64_t wrong = 0, inside = 0, vertices = 0;
    for (const PlaneCase& c : plane_cases()) {
        const Clipper clipper{c.state, c.rules};
        for (int n = 0; n < 400; ++n, ++vertices) {
            const ClipVertex v = plane_vertex(random);
            const std::uint32_t mask = clipper.outside(v);
            wrong += std::popcount(mask) != planes_missed(c, v) ? 1 : 0;
            wrong += (mask & 1u) != (v.w < 0x1p-64f ? 1u : 0u) ? 1 : 0;
            inside += mask == 0 ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    CHECK(inside > vertices / 20);
    CHECK(inside < vertices / 2);
}

TEST_CASE("the view volume needs no plane tests if the guard band contains it and no user plane is enabled") {
    for (const PlaneCase& c : plane_cases()) {
        const Rect& port = c.state.viewport;
        const int reach = std::max({port.x1, port.y1, -port.x0, -port.y0});
        CHECK(Clipper{c.state, c.rules}.holds_view_volume() ==
              (reach <= c.rules.guard_band_px && c.state.clip_plane_count == 0));
    }
    RasterState state = scene_state(40, 41);
    CHECK_FALSE(Clipper{state, {.guard_band_px = 40}}.holds_view_volume());
    CHECK(Clipper{state, {.guard_band_px = 41}}.holds_view_volume());
    state.viewport = {0, 0, 41, 40};
    CHECK_FALSE(Clipper{state, {.guard_band_px = 40}}.holds_view_volume());
}

TEST_CASE("no vertex of window positions is outside of any plane") {
    RasterState state = scene_state(64, 48);
    state.window_positions = true;
    state.clip_plane_count = 1;
    state.clip_planes[0] = {0, 0, 0, -1};
    const Clipper clipper{state, {.guard_band_px = 40}};
    Random random{622};
    std::uint32_t any = 0;
    for (int n = 0; n < 1000; ++n) any |= clipper.outside(plane_vertex(random));
    CHECK(any == 0);
}

TEST_CASE(
    "with depths from 0 a new corner at the near plane has z = +0 and at the far plane z = w at an exact fraction") {
    RasterState state = scene_state(64, 64);
    state.clip_depth = ClipDepth::zero_to_one;
    const Clipper clipper{state, {}};
    // Distances 3 inside and 1 outside: the crossing is a quarter of the way before the outside end. 0.1f and 0.7f make
    // the rounded z differ from 0.
    const ClipVertex in{.x = 4, .y = -8, .z = 3 * 0.1f, .w = 16}, out{.x = 8, .y = 4, .z = -0.1f, .w = 16};
    const ClipPolygon near = cut_once(clipper, in, out);
    REQUIRE(near.count == 4);
    CHECK(std::bit_cast<std::uint32_t>(near.corner[1].z) == 0);
    CHECK(near.corner[1].w == 16.0f);
    CHECK(near.corner[1].x == Approx(7).epsilon(1e-6));
    const ClipVertex behind{.x = 8, .y = 4, .z = 20, .w = 16}, before{.x = 4, .y = -8, .z = 12, .w = 16};
    const ClipPolygon far = cut_once(clipper, before, behind);
    REQUIRE(far.count == 4);
    CHECK(far.corner[1].z == far.corner[1].w);
    CHECK(far.corner[1].x == 6.0f);
    CHECK(far.corner[1].y == -2.0f);
}

TEST_CASE("a crossing divides every component and extra in the ratio of the distances to the plane") {
    RasterState state = scene_state(64, 64);
    state.clip_plane_count = 1;
    state.clip_planes[0] = {1, 0, 0, 0};  // x >= 0
    const Clipper clipper{state, {}};
    const ClipVertex in{6, 1, 2, 32, {0, 8, 16, 24}, {32, 40, 48, 56}, {64, 72}};
    const ClipVertex out{-2, 9, 10, 16, {8, 0, 24, 8}, {0, 8, 80, 120}, {0, -8}};
    ClipPolygon polygon{{in, out, in}, 3, 3, {}};
    polygon.extra[0] = polygon.extra[2] = {4, -4, 100};
    polygon.extra[1] = {8, 4, 0};
    clipper.clip(polygon, clipper.outside(out));
    REQUIRE(polygon.count == 4);
    const ClipVertex& v = polygon.corner[1];  // three quarters along
    CHECK(v.x == 0.0f);
    CHECK(v.y == 7.0f);
    CHECK(v.z == 8.0f);
    CHECK(v.w == 20.0f);
    CHECK(v.front == std::array{6.0f, 2.0f, 22.0f, 12.0f});
    CHECK(v.back == std::array{8.0f, 16.0f, 72.0f, 104.0f});
    CHECK(v.texcoord == std::array{16.0f, 12.0f});
    for (const std::size_t corner : {std::size_t{1}, std::size_t{2}}) {
        CHECK(polygon.extra[corner][0] == 7.0f);
        CHECK(polygon.extra[corner][1] == 2.0f);
        CHECK(polygon.extra[corner][2] == 25.0f);
    }
    CHECK(polygon.extra[0][2] == 100.0f);
    CHECK(polygon.extra[3][2] == 100.0f);
}

TEST_CASE("a corner on a plane is kept and adds no second corner there") {
    RasterState state = scene_state(64, 64);
    state.clip_plane_count = 1;
    state.clip_planes[0] = {1, 0, 0, 0};
    const Clipper clipper{state, {}};
    const ClipVertex on{0, 1, 0, 4, {}, {}, {}}, in{2, 0, 0, 4, {}, {}, {}}, out{-2, 0, 0, 4, {}, {}, {}};
    ClipPolygon half{{on, out, in}, 3};
    clipper.clip(half, clipper.outside(out));
    CHECK(half.count == 3);
    CHECK(half.corner[0].y == 1.0f);
    ClipPolygon touching{{on, out, out}, 3};
    clipper.clip(touching, clipper.outside(out));
    CHECK(touching.count < 3);
    ClipPolygon untouched{{on, in, in}, 3};
    clipper.clip(untouched, 0);
    CHECK(untouched.count == 3);
}
