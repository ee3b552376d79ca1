// Tests clipping by properties of its result: shared sides stay bit-identical, a ground plane has no cracks, and
// attributes stay linear.
#include "rasterizer/set_up/clip.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] ClipPolygon clipped(const Clipper& clipper, const ClipVertex& a, const ClipVertex& b,
                                  const ClipVertex& c) {
    ClipPolygon polygon{{a, b, c}, 3};
    clipper.clip(polygon, clipper.outside(a) | clipper.outside(b) | clipper.outside(c));
    return polygon;
}

[[nodiscard]] bool same(const ClipVertex& a, const ClipVertex& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w && a.front == b.front && a.back == b.back &&
           a.texcoord == b.texcoord;
}

[[nodiscard]] bool contains(const ClipPolygon& polygon, const ClipVertex& v) {
    return std::any_of(polygon.corner.begin(), polygon.corner.begin() + polygon.count,
                       [&](const ClipVertex& c) { return same(c, v); });
}

[[nodiscard]] RasterState state_with_planes() {
    RasterState state = scene_state(64, 48);
    state.clip_plane_count = 2;
    state.clip_planes[0] = {0.3f, -1, 0.2f, 0.9f};
    state.clip_planes[1] = {-1, 0.1f, 0, 0.7f};
    return state;
}

[[nodiscard]] TriangleSoup soup_of(const std::vector<ClipVertex>& vertices) {
    TriangleSoup soup;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) soup.indices.push_back(i);
    soup.runs = {{0, static_cast<std::uint32_t>(vertices.size()), 0, 0, true, false}};
    soup.vertices.assign(vertices.begin(), vertices.end());
    return soup;
}

constexpr int window_size = 64;
constexpr float near_plane = 0.5f, far_plane = 40.0f;

// The ground y = -1 seen from the origin along -z, 90 degrees, as a grid around the eye: w is from -30 to 30.
[[nodiscard]] TriangleSoup ground(Random& random) {
    constexpr int cells = 7;
    TriangleSoup soup;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const float x = -30.0f + 60.0f * static_cast<float>(i) / cells + random_float(random, -2, 2);
            const float z = -30.0f + 60.0f * static_cast<float>(j) / cells + random_float(random, -2, 2);
            ClipVertex v;
            v.x = x;
            v.y = -1;
            v.z = (z * (far_plane + near_plane) + 2 * far_plane * near_plane) / (near_plane - far_plane);
            v.w = -z;
            soup.vertices.push_back(v);
        }
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = a + cells + 1;
            for (const std::uint32_t index : {a, b, c, c, d, a}) soup.indices.push_back(index);
        }
    soup.runs = {{0, static_cast<std::uint32_t>(soup.indices.size()), 0, 0, true, false}};
    return soup;
}

struct Cracks {
    std::uint64_t inside = 0, holes = 0, doubled = 0;
};

// Whether the ground is visible at the window point: -1 not, +1 visible. y down.
[[nodiscard]] int ground_at(double px, double py, bool z_is_clipped) {
    const double nx = px / (window_size / 2.0) - 1, ny = 1 - py / (window_size / 2.0);
    if (ny >= 0) return -1;
    const double depth = -1 / ny;
    const bool in_mesh = depth < 27 && nx * depth > -27 && nx * depth < 27;
    return in_mesh && (!z_is_clipped || (depth > near_plane && depth < far_plane)) ? 1 : -1;
}

[[nodiscard]] Cracks cracks(const TriangleSoup& soup, const RasterState& state, const RasterRules& rules) {
    const Geometry geometry = set_up(soup, state, rules, 1);
    std::vector<int> count(window_size * window_size, 0);
    for (const Fragment& f : draw(geometry, {}, coverage_only).fragments)
        ++count[static_cast<std::size_t>(f.y * window_size + f.x)];
    Cracks result;
    const bool z_is_clipped = !state.depth_clamp && rules.z_clip == ZClip::per_primitive;
    for (int y = 0; y < window_size; ++y)
        for (int x = 0; x < window_size; ++x) {
            const int n = count[static_cast<std::size_t>(y * window_size + x)];
            int corners = 0;  // corners of the pixel enlarged by a margin
            for (const double dx : {-0.5, 1.5})
                for (const double dy : {-0.5, 1.5}) corners += ground_at(x + dx, y + dy, z_is_clipped);
            result.doubled += n > 1 ? 1 : 0;
            result.inside += corners == 4 ? 1 : 0;
            result.holes += corners == 4 && n == 0 ? 1 : 0;
        }
    return result;
}

}  // namespace

TEST_CASE("two triangles that share a side have bit-identical clipped corners on it in either direction") {
    constexpr std::uint64_t seed = 101;
    Random random{seed};
    std::uint64_t cut_sides = 0, different = 0;
    for (const int guard : {40, 100, 32768}) {
        const Clipper clipper{state_with_planes(), {.guard_band_px = guard}};
        for (int n = 0; n < 3000; ++n) {
            const auto vertex = [&] { return random_vertex(random, SoupKind::needs_clipping); };
            const ClipVertex a = vertex(), b = vertex(), c = vertex(), d = vertex();
            // The corners that clipping the degenerate triangle (a, b, b) leaves are those of the side.
            const ClipPolygon side = clipped(clipper, a, b, b), left = clipped(clipper, a, b, c),
                              right = clipped(clipper, b, a, d);
            for (int i = 0; i < side.count; ++i) {
                const ClipVertex& v = side.corner[static_cast<std::size_t>(i)];
                if (same(v, a) || same(v, b)) continue;
                ++cut_sides;
                different += contains(left, v) && contains(right, v) ? 0 : 1;
            }
        }
    }
    INFO("seed " << seed << ", corners " << cut_sides);
    CHECK(cut_sides > 1000);
    CHECK(different == 0);
}

TEST_CASE("a shared corner is bit-identical even where its values almost cancel") {
    Random random{107};
    RasterState state = scene_state(64, 64);
    state.clip_plane_count = 1;
    state.clip_planes[0] = {1, 0, 0, 0};
    const Clipper clipper{state, {}};
    std::uint64_t different = 0;
    for (int n = 0; n < 4000; ++n) {
        // Multiples of x except for their rounding: on the plane x = 0 only the rounding errors remain.
        const float x_in = random_float(random, 1, 2), x_out = -random_float(random, 1, 2),
                    k = random_float(random, 1, 2);
        const ClipVertex in{x_in, 0.25f, 0, 4, {k * x_in, x_in / k, 1, 1}, {}, {}};
        const ClipVertex out{x_out, -0.5f, 0, 4, {k * x_out, x_out / k, 1, 1}, {}, {}};
        const ClipVertex third{0.5f, 1, 0, 2, {}, {}, {}}, other{0.5f, -1, 0, 2, {}, {}, {}};
        const ClipPolygon one = clipped(clipper, in, out, third), two = clipped(clipper, out, in, other);
        REQUIRE(one.count == 4);
        different += contains(two, one.corner[1]) ? 0 : 1;  // corner 0 is `in`, corner 1 is on the shared side
    }
    CHECK(different == 0);
}

TEST_CASE("a ground around the eye has no cracks after clipping by any combination of planes") {
    constexpr std::uint64_t seed = 102;
    Random random{seed};
    for (int n = 0; n < 12; ++n) {
        const TriangleSoup soup = ground(random);
        for (const int guard : {70, 300, 32768})
            for (const bool depth_clamp : {false, true}) {
                RasterState state = scene_state(window_size, window_size);
                state.depth_clamp = depth_clamp;
                const Cracks found = cracks(soup, state, {.guard_band_px = guard});
                INFO("seed " << seed << ", mesh " << n << ", guard " << guard);
                CHECK(found.inside > 1500);
                CHECK(found.holes == 0);
                CHECK(found.doubled == 0);
            }
    }
}

TEST_CASE("a user plane and its opposite divide a mesh without overlap") {
    Random random{103};
    const TriangleSoup soup = ground(random);
    std::vector<int> count(window_size * window_size, 0), whole(window_size * window_size, 0);
    const auto add = [&](const RasterState& state, std::vector<int>& into) {
        for (const Fragment& f : draw(set_up(soup, state, {}, 1), {}, coverage_only).fragments)
            ++into[static_cast<std::size_t>(f.y * window_size + f.x)];
    };
    RasterState state = scene_state(window_size, window_size);
    add(state, whole);
    state.clip_plane_count = 1;
    for (const float side : {1.0f, -1.0f}) {
        state.clip_planes[0] = {side, 0, 0, side * 0.171875f};  // x / w = -11/64, which is at no pixel centre
        add(state, count);
    }
    CHECK(count == whole);
}

TEST_CASE("a new corner is exactly on its plane and at the near plane window z is exactly n") {
    Random random{104};
    const Clipper clipper{scene_state(64, 64), {}};
    std::uint64_t corners = 0, wrong = 0;
    for (int n = 0; n < 4000; ++n) {
        const auto vertex = [&] { return random_vertex(random, SoupKind::needs_clipping); };
        const ClipVertex a = vertex(), b = vertex(), c = vertex();
        const ClipPolygon polygon = clipped(clipper, a, b, c);
        for (int i = 0; i < polygon.count && polygon.count >= 3; ++i) {
            const ClipVertex& v = polygon.corner[static_cast<std::size_t>(i)];
            wrong += v.w < least_w ? 1 : 0;
            if (same(v, a) || same(v, b) || same(v, c) || v.w < 0x1p-7f)
                continue;  // far out the guard band may have clipped it
            ++corners;
            wrong += v.z != -v.w && v.z != v.w ? 1 : 0;
        }
    }
    CHECK(corners > 1000);
    CHECK(wrong == 0);
}

TEST_CASE("attributes of new corners are linear in clip space and equal values stay bit-identical") {
    Random random{105};
    const Clipper clipper{scene_state(64, 64), {}};
    std::uint64_t corners = 0, wrong = 0;
    for (int n = 0; n < 1000; ++n) {
        ClipVertex a = random_vertex(random, SoupKind::needs_clipping),
                   b = random_vertex(random, SoupKind::needs_clipping);
        ClipVertex c = random_vertex(random, SoupKind::needs_clipping);
        for (ClipVertex* v : {&a, &b, &c}) {
            v->front = {0.1f, v->x, v->w, 0.7f};  // functions of the position stay functions of the position
            v->texcoord = {0.3f, v->y};
        }
        const ClipPolygon polygon = clipped(clipper, a, b, c);
        for (int i = 0; i < polygon.count; ++i) {
            const ClipVertex& v = polygon.corner[static_cast<std::size_t>(i)];
            ++corners;
            wrong += v.front[0] != 0.1f || v.front[3] != 0.7f || v.texcoord[0] != 0.3f ? 1 : 0;
            wrong += v.front[1] != v.x || v.texcoord[1] != v.y ? 1 : 0;
        }
    }
    CHECK(corners > 500);
    CHECK(wrong == 0);
}

TEST_CASE("triangles behind the eye are outside and a vertex at zero is clipped or drops the triangle") {
    const ClipVertex a{-1, -1, 0, 1, {}, {}, {}}, b{1, -1, 0, 1, {}, {}, {}}, zero{0, 0, 0, 0, {}, {}, {}};
    const ClipVertex behind{0, 1, 0, -1, {}, {}, {}}, tiny{0, 0, 0, 0x1p-70f, {}, {}, {}};
    RasterState state = scene_state(32, 32);
    const auto counters = [&](const std::vector<ClipVertex>& v, WClip rule) {
        return set_up(soup_of(v), state, {.w_clip = rule}, 1).counters;
    };
    for (const bool depth_clamp : {false, true}) {
        state.depth_clamp = depth_clamp;
        CHECK(counters({zero, zero, zero}, WClip::clip).outside == 1);
        CHECK(counters({behind, behind, behind}, WClip::clip).outside == 1);
        CHECK(counters({tiny, tiny, tiny}, WClip::clip).outside == 1);
        for (const ClipVertex& v : {zero, behind, tiny}) {
            CHECK(counters({a, b, v}, WClip::drop).outside == 1);
            const SetupCounters cut = counters({a, b, v}, WClip::clip);
            CHECK(cut.non_finite == 0);
            CHECK(cut.clipped + cut.outside == 1);
        }
    }
    CHECK(counters({a, b, behind}, WClip::clip).clipped == 1);
    CHECK(counters({a, b, {0, 1, 0, 1, {}, {}, {}}}, WClip::drop).outside == 0);
}

TEST_CASE("far outside the window positions are clipped to the guard band and never wrap around") {
    Random random{106};
    std::uint64_t wrong = 0, pieces = 0;
    for (const int guard : {64, 1000, 32768})
        for (int n = 0; n < 500; ++n) {
            std::vector<ClipVertex> v;
            for (int i = 0; i < 3; ++i) {
                v.push_back(random_vertex(random, SoupKind::flat));
                v.back().x *= 1e6f;
                v.back().y *= random_float(random, 0, 1e7f);
            }
            const RasterRules rules{.subpixel_bits = 12, .guard_band_px = guard};
            for (const SetupTriangle& t : triangles_of(set_up(soup_of(v), scene_state(32, 32), rules, 1))) {
                ++pieces;
                for (const SubpixelPoint& p : t.p)
                    wrong += std::abs(p.x) > guard << 12 || std::abs(p.y) > guard << 12 ? 1 : 0;
            }
        }
    CHECK(pieces > 500);
    CHECK(wrong == 0);
}

TEST_CASE("near and far do not clip with depth clamp or per-fragment z clip") {
    const TriangleSoup soup =
        soup_of({{-1, -1, -3, 1, {}, {}, {}}, {1, -1, 3, 1, {}, {}, {}}, {0, 1, 0, 1, {}, {}, {}}});
    RasterState state = scene_state(16, 16);
    CHECK(set_up(soup, state, {}, 1).counters.clipped == 1);
    CHECK(set_up(soup, state, {.z_clip = ZClip::per_fragment}, 1).counters.clipped == 0);
    state.depth_clamp = true;
    CHECK(set_up(soup, state, {}, 1).counters.clipped == 0);
}
