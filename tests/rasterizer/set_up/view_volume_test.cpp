// Tests clipping at the view volume against the algorithm of pipeline/reference/mesa-rasterizers.md 1.2 in rational
// arithmetic, each operation rounded to binary32 by definition.
#include <catch2/catch.hpp>

#include "rasterizer/set_up/clip.h"
#include "rasterizer/set_up/window.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

using VertexValues = std::array<float, 14>;

[[nodiscard]] float nearest(const Rational& v) { return nearest_float(v); }

[[nodiscard]] float distance_of(int plane, const VertexValues& v) {
    const Rational w{v[3]}, axis{v[static_cast<std::size_t>(plane / 2)]};
    // x <= w, -x <= w, y <= w, -y <= w, then -z <= w before z <= w.
    const bool is_upper = plane < 4 ? plane % 2 == 0 : plane == 5;
    return nearest(is_upper ? Rational{w - axis} : Rational{w + axis});
}

[[nodiscard]] VertexValues moved(const VertexValues& from, const VertexValues& other, float t) {
    VertexValues result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const float difference = nearest(Rational{other[i]} - Rational{from[i]});
        const float product = nearest(Rational{t} * Rational{difference});
        result[i] = nearest(Rational{from[i]} + Rational{product});
    }
    return result;
}

[[nodiscard]] std::vector<VertexValues> cut_by(int plane, const std::vector<VertexValues>& from) {
    std::vector<VertexValues> to;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const VertexValues& previous = from[i];
        const VertexValues& current = from[(i + 1) % from.size()];
        const float d_previous = distance_of(plane, previous), d = distance_of(plane, current);
        if (d_previous >= 0) to.push_back(previous);
        if ((d_previous >= 0) == (d >= 0)) continue;
        const float whole = nearest(Rational{d} - Rational{d_previous});
        const float from_current = nearest(Rational{d} / Rational{whole});
        const float from_previous = nearest(Rational{-d_previous} / Rational{whole});
        const bool goes_out = d < 0;
        if (goes_out ? -d < d_previous : !(-d_previous < d))
            to.push_back(moved(current, previous, from_current));
        else
            to.push_back(moved(previous, current, from_previous));
    }
    return to;
}

[[nodiscard]] std::vector<VertexValues> model_of(std::vector<VertexValues> polygon) {
    const std::vector<VertexValues> given = polygon;
    for (int plane = 0; plane < 6 && polygon.size() >= 3; ++plane) {
        bool crosses = false;
        for (const VertexValues& v : given) crosses |= distance_of(plane, v) < 0;
        if (crosses) polygon = cut_by(plane, polygon);
    }
    return polygon.size() < 3 ? std::vector<VertexValues>{} : polygon;
}

[[nodiscard]] RasterRules view_volume() { return {.clip = ClipVolume::view_volume}; }

// The end at `from` of a line, moved by the greatest t of the planes that it is outside of, and that t.
[[nodiscard]] std::pair<VertexValues, float> moved_end(const VertexValues& from, const VertexValues& other) {
    float most = 0;
    for (int plane = 0; plane < 6; ++plane) {
        const float d = distance_of(plane, from);
        if (d >= 0) continue;
        const float whole = nearest(Rational{d} - Rational{distance_of(plane, other)});
        most = std::max(most, nearest(Rational{d} / Rational{whole}));
    }
    return {most > 0 ? moved(from, other, most) : from, most};
}

}  // namespace

TEST_CASE("the view volume clips a triangle to the corners of the rule in its order with each step rounded", "[slow]") {
    const RasterState state = scene_state(64, 48);
    const Clipper clipper{state, view_volume()};
    Random random{511};
    std::uint64_t wrong = 0, cut = 0, gone = 0, on_plane = 0;
    for (int n = 0; n < 3000; ++n) {
        ClipPolygon polygon{};
        polygon.count = 3;
        std::vector<VertexValues> given;
        std::uint32_t any = 0, all = ~0u;
        for (std::size_t i = 0; i < 3; ++i) {
            polygon.corner[i] = random_vertex(random, SoupKind::needs_clipping);
            // Some corners are exactly on a plane; those add a separate corner next to them.
            if (n % 5 == 0 && i == 0) polygon.corner[i].x = polygon.corner[i].w, ++on_plane;
            given.push_back(std::bit_cast<VertexValues>(polygon.corner[i]));
            any |= clipper.outside(polygon.corner[i]);
            all &= clipper.outside(polygon.corner[i]);
        }
        if (all != 0) continue;
        clipper.clip(polygon, any);
        const std::vector<VertexValues> expected = model_of(given);
        const auto count = static_cast<std::size_t>(polygon.count);
        gone += expected.empty() ? 1 : 0;
        cut += expected.size() > 3 ? 1 : 0;
        if (expected.empty() || count < 3) {
            wrong += expected.empty() == (count < 3) ? 0 : 1;
            continue;
        }
        bool same = count == expected.size();
        for (std::size_t i = 0; same && i < count; ++i) {
            same = std::bit_cast<VertexValues>(polygon.corner[i]) == expected[i];
            // A corner that clipping added next to one on the plane may equal it.
            same &= polygon.is_new[i] || std::ranges::find(given, expected[i]) != given.end();
        }
        wrong += same ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(cut > 300);
    CHECK(gone > 10);
    CHECK(on_plane > 100);
}

namespace {

// pipeline/reference/swiftshader-rasterizer.md 1.2: near, far, left, right, top, bottom.
[[nodiscard]] float distance_depth_first(int plane, const VertexValues& v) {
    const Rational w{v[3]};
    constexpr std::array<std::size_t, 6> axis{2, 2, 0, 0, 1, 1};
    constexpr std::array sign{1, -1, 1, -1, -1, 1};
    const auto p = static_cast<std::size_t>(plane);
    return nearest(w + Rational{sign[p]} * Rational{v[axis[p]]});
}

[[nodiscard]] VertexValues between(const VertexValues& in, float d_in, const VertexValues& out, float d_out) {
    const Rounded i{d_in}, o{d_out}, reciprocal = Rounded{1} / (o - i);
    VertexValues corner;
    for (std::size_t k = 0; k < corner.size(); ++k)
        corner[k] = ((o * Rounded{in[k]} - i * Rounded{out[k]}) * reciprocal).v;
    return corner;
}

[[nodiscard]] std::vector<VertexValues> clip_depth_first(const std::vector<VertexValues>& given) {
    std::vector<VertexValues> polygon = given;
    for (int plane = 0; plane < 6; ++plane) {
        const auto is_out = [&](const VertexValues& v) { return distance_depth_first(plane, v) < 0; };
        if (std::ranges::none_of(given, is_out)) continue;
        std::vector<VertexValues> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const VertexValues &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            const float da = distance_depth_first(plane, a), db = distance_depth_first(plane, b);
            if (da >= 0) kept.push_back(a);
            if (da >= 0 && db < 0) kept.push_back(between(a, da, b, db));
            if (da < 0 && db > 0) kept.push_back(between(b, db, a, da));
        }
        polygon = kept;
        if (polygon.size() < 3) return {};
    }
    return polygon;
}

}  // namespace

TEST_CASE("depth first the view volume clips by near and far and weights new corners by both distances",
          "[long][slow]") {
    const Clipper clipper{scene_state(64, 48), {.clip = ClipVolume::view_volume_depth_first}};
    Random random{513};
    std::uint64_t wrong = 0, cut = 0, gone = 0, unlike = 0;
    for (int n = 0; n < 3000; ++n) {
        ClipPolygon polygon{};
        polygon.count = 3;
        std::vector<VertexValues> given;
        std::uint32_t any = 0, all = ~0u;
        for (std::size_t i = 0; i < 3; ++i) {
            polygon.corner[i] = random_vertex(random, SoupKind::needs_clipping);
            if (n % 5 == 0 && i == 0) polygon.corner[i].z = polygon.corner[i].w;
            given.push_back(std::bit_cast<VertexValues>(polygon.corner[i]));
            any |= clipper.outside(polygon.corner[i]);
            all &= clipper.outside(polygon.corner[i]);
        }
        if (all != 0) continue;
        clipper.clip(polygon, any);
        const std::vector<VertexValues> expected = clip_depth_first(given);
        std::vector<VertexValues> found;
        for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i)
            found.push_back(std::bit_cast<VertexValues>(polygon.corner[i]));
        if (found.size() < 3) found.clear();
        wrong += found == expected ? 0 : 1;
        unlike += expected == model_of(given) ? 0 : 1;
        cut += expected.size() > 3 ? 1 : 0;
        gone += expected.empty() ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(cut > 300);
    CHECK(gone > 10);
    CHECK(unlike > 300);
}

TEST_CASE("the fan of a triangle clipped by the view volume has its common corner last") {
    TriangleSoup soup;
    for (const auto& [x, y] : {std::array{-0.5f, -0.5f}, {2.0f, -0.5f}, {-0.5f, 0.5f}}) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
        soup.vertices.push_back({x, y, 0, 1, {}, {}, {}});
    }
    soup.runs = {{0, 3, 0, 0, true, false}};
    const Geometry ours = set_up(soup, scene_state(64, 48), view_volume(), 1);
    REQUIRE(ours.triangles.size() == 2);
    CHECK(ours.triangles[0].vertex[2] == ours.triangles[1].vertex[2]);
    CHECK(ours.triangles[0].vertex[1] == ours.triangles[1].vertex[0]);
    // The guard band contains this triangle, so it is not clipped.
    CHECK(set_up(soup, scene_state(64, 48), {}, 1).triangles.size() == 1);
}

TEST_CASE("vertices are projected with one rounding or two and those that clipping added by their own rule", "[slow]") {
    Random random{512};
    const RasterState state = scene_state(333, 77);
    std::uint64_t wrong = 0, fused_once = 0;
    for (int n = 0; n < 4000; ++n) {
        ClipVertex v;
        v.w = random_float(random, 0.5f, 7);
        v.x = random_float(random, -1, 1) * v.w;
        const float q = nearest(Rational{1} / Rational{v.w}), divided = nearest(Rational{v.x} * Rational{q});
        const Rational scale{333, 2};
        const float once = nearest(Rational{divided} * scale + scale);
        const float twice = nearest(Rational{nearest(Rational{divided} * scale)} + scale);
        fused_once += once == twice ? 0 : 1;
        for (const ViewportArithmetic rule :
             {ViewportArithmetic::separate, ViewportArithmetic::fused, ViewportArithmetic::fused_given}) {
            const WindowTransform window{state, {.w_divide = WDivide::reciprocal, .viewport = rule}};
            const float given = window.project(v).x, made = window.project(v, VertexOrigin::made_by_clip).x;
            wrong += given == (rule == ViewportArithmetic::separate ? twice : once) ? 0 : 1;
            wrong += made == (rule == ViewportArithmetic::fused ? once : twice) ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(fused_once > 100);
}

TEST_CASE("a corner that clipping added is projected as such and the others of its polygon as given") {
    const ClipVolume volume = GENERATE(ClipVolume::view_volume, ClipVolume::guard_band);
    std::uint64_t unlike = 0, wrong = 0, given = 0;
    RasterRules rules{.clip = volume, .w_divide = WDivide::reciprocal, .viewport = ViewportArithmetic::fused_given};
    const RasterState state = scene_state(333, 77);
    const TriangleSoup soup = random_soup(513, 200, SoupKind::needs_clipping);
    const Geometry geometry = set_up(soup, state, rules, 1);
    const WindowTransform window{state, rules};
    for (std::size_t v = soup.vertices.size(); v < geometry.vertices.size(); ++v) {
        const ClipVertex& corner = geometry.vertices[v];
        const bool is_given = std::ranges::any_of(soup.vertices, [&](const ClipVertex& other) {
            return std::bit_cast<VertexValues>(other) == std::bit_cast<VertexValues>(corner);
        });
        const float once = window.project(corner).x, twice = window.project(corner, VertexOrigin::made_by_clip).x;
        wrong += geometry.corners[v].unsnapped[0] == (is_given ? once : twice) ? 0 : 1;
        unlike += once == twice ? 0 : 1;
        given += is_given ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(unlike > 10);
    CHECK(given > 10);
}

TEST_CASE("the view volume moves the ends of a line to the last plane that each is outside of, or drops the line") {
    const Clipper clipper{scene_state(64, 48), view_volume()};
    Random random{19};
    int wrong = 0, cut = 0, gone = 0;
    for (int n = 0; n < 3000; ++n) {
        ClipPolygon line{};
        std::array<VertexValues, 2> given;
        std::array<std::uint32_t, 2> outside;
        for (std::size_t i = 0; i < 2; ++i) {
            line.corner[i] = random_vertex(random, SoupKind::needs_clipping);
            given[i] = std::bit_cast<VertexValues>(line.corner[i]);
            outside[i] = clipper.outside(line.corner[i]);
        }
        if ((outside[0] & outside[1]) != 0) continue;
        const auto first = moved_end(given[0], given[1]), second = moved_end(given[1], given[0]);
        const bool is_left = nearest(Rational{first.second} + Rational{second.second}) < 1.0f;
        const bool is_kept = clipper.clip_line(line, outside[0] | outside[1]);
        gone += is_left ? 0 : 1;
        cut += is_left && (outside[0] | outside[1]) != 0 ? 1 : 0;
        wrong += is_kept == is_left ? 0 : 1;
        if (!is_left) continue;
        wrong += std::bit_cast<VertexValues>(line.corner[0]) == first.first ? 0 : 1;
        wrong += std::bit_cast<VertexValues>(line.corner[1]) == second.first ? 0 : 1;
        wrong += line.is_new[0] == (outside[0] != 0) && line.is_new[1] == (outside[1] != 0) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(cut > 300);
    CHECK(gone > 10);
}
