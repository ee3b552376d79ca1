// Tests float32_plane against its rule in rational arithmetic, each operation rounded once to binary32.
#include <catch2/catch.hpp>

#include "tests/rasterizer/values/quotient_triangles.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] float binary32_rounded(const Rational& v) { return nearest_float(v); }
[[nodiscard]] float binary32_plus(float a, float b) { return binary32_rounded(Rational{a} + Rational{b}); }
[[nodiscard]] float binary32_minus(float a, float b) { return binary32_rounded(Rational{a} - Rational{b}); }
[[nodiscard]] float binary32_times(float a, float b) { return binary32_rounded(Rational{a} * Rational{b}); }

// The rule of depth_paths.h, float32_plane; empty if the slopes are undefined.
[[nodiscard]] std::optional<float> model_float32_plane(const SetupTriangle& t, const Fragment& f, int bits,
                                                       PlaneAnchor anchor, PlaneOrigin origin) {
    std::array<float, 3> x, y, z;
    for (std::size_t i = 0; i < 3; ++i) {
        const bool snaps = origin == PlaneOrigin::snapped;
        x[i] = snaps ? binary32_rounded(Rational{t.p[i].x} / (1 << bits)) : t.unsnapped[i][0];
        y[i] = snaps ? binary32_rounded(Rational{t.p[i].y} / (1 << bits)) : t.unsnapped[i][1];
        z[i] = static_cast<float>(t.z[i]);
    }
    const float x1 = binary32_minus(x[1], x[0]), y1 = binary32_minus(y[1], y[0]), z1 = binary32_minus(z[1], z[0]);
    const float x2 = binary32_minus(x[2], x[0]), y2 = binary32_minus(y[2], y[0]), z2 = binary32_minus(z[2], z[0]);
    const float area = binary32_minus(binary32_times(x1, y2), binary32_times(x2, y1));
    if (area == 0) return std::nullopt;
    const float dx =
        binary32_rounded(Rational{binary32_minus(binary32_times(z1, y2), binary32_times(z2, y1))} / Rational{area});
    const float dy =
        binary32_rounded(Rational{binary32_minus(binary32_times(z2, x1), binary32_times(z1, x2))} / Rational{area});
    float base = z[0], ox = x[0], oy = y[0];
    if (anchor == PlaneAnchor::window_corner) {
        base = binary32_minus(binary32_minus(base, binary32_times(dx, ox)), binary32_times(dy, oy));
        ox = oy = 0;
    }
    const float px = static_cast<float>(f.x) + 0.5f, py = static_cast<float>(f.y) + 0.5f;
    return binary32_plus(binary32_plus(base, binary32_times(dx, binary32_minus(px, ox))),
                         binary32_times(dy, binary32_minus(py, oy)));
}

}  // namespace

TEST_CASE("float32_plane rounds its slopes and every step from its anchor to binary32", "[slow]") {
    for (const PlaneAnchor anchor : {PlaneAnchor::first_vertex, PlaneAnchor::window_corner})
        for (const auto& [bits, origin] : {std::pair{4, PlaneOrigin::snapped}, std::pair{8, PlaneOrigin::snapped},
                                           std::pair{8, PlaneOrigin::unsnapped}}) {
            RasterRules rules{.subpixel_bits = bits, .plane_origin = origin};
            rules.hypothesis.plane_anchor = anchor;
            std::uint64_t fragments = 0, wrong = 0;
            for (QuotientTriangle t : random_quotient_triangles(908, 10, bits, 1.0)) {
                for (auto& position : t.setup.unsnapped) position[0] += 0.0007f, position[1] -= 0.0011f;
                for (const Fragment& f : draw(quotient_geometry({t}, rules, DepthFormat::d32f),
                                              {DepthPath::float32_plane, DepthFormat::d32f}, quotient_needs)
                                             .fragments) {
                    const auto z = model_float32_plane(t.setup, f, bits, anchor, origin);
                    if (!z) continue;
                    wrong += f.reference_z != double{*z} || f.code != to_depth_code(*z, DepthFormat::d32f, {}) ? 1 : 0;
                    ++fragments;
                }
            }
            CHECK(fragments > 150);
            CHECK(wrong == 0);
        }
}

namespace {

[[nodiscard]] SetupTriangle rotated(const SetupTriangle& t) {
    SetupTriangle r = t;
    for (std::size_t i = 0; i < 3; ++i) {
        r.p[i] = t.p[(i + 1) % 3];
        r.unsnapped[i] = t.unsnapped[(i + 1) % 3];
        r.z[i] = t.z[(i + 1) % 3];
    }
    return r;
}

[[nodiscard]] SetupTriangle moved(const SetupTriangle& t, int pixels, int bits) {
    SetupTriangle m = t;
    for (SubpixelPoint& p : m.p) p.x += pixels << bits, p.y += pixels << bits;
    for (auto& u : m.unsnapped)
        for (float& c : u) c += static_cast<float>(pixels);
    return m;
}

// The fraction of fragments whose code changes when `change` is applied to every triangle, which then is `shift` pixels
// off.
template <class Change>
[[nodiscard]] double changed_share(DepthPath path, PlaneAnchor anchor, int shift, const Change& change) {
    constexpr int bits = 8;
    RasterRules rules{.subpixel_bits = bits};
    rules.hypothesis.plane_anchor = anchor;
    std::uint64_t fragments = 0, changed = 0;
    for (const QuotientTriangle& t : random_quotient_triangles(909, 200, bits, 1.0)) {
        const auto codes = [&](const SetupTriangle& triangle, int at) {
            Geometry g = window_geometry({triangle}, quotient_side + at, quotient_side + at, rules);
            g.state.viewport = {at, at, quotient_side + at, quotient_side + at};
            return by_pixel(draw(g, {path, DepthFormat::d32f}, {.color = false}).fragments);
        };
        const auto before = codes(t.setup, 0), after = codes(change(t.setup), shift);
        REQUIRE(before.size() == after.size());
        for (std::size_t i = 0; i < before.size(); ++i) changed += before[i].code != after[i].code ? 1 : 0;
        fragments += before.size();
    }
    CHECK(fragments > 4000);
    return static_cast<double>(changed) / static_cast<double>(fragments);
}

}  // namespace

TEST_CASE("rotating the vertices or moving the viewport changes many depths of float32_plane and none of exact") {
    const auto move = [](const SetupTriangle& t) { return moved(t, 512, 8); };
    CHECK(changed_share(DepthPath::float32_plane, PlaneAnchor::first_vertex, 0, rotated) > 0.25);
    CHECK(changed_share(DepthPath::float32_plane, PlaneAnchor::window_corner, 512, move) > 0.25);
    for (const DepthPath path : {DepthPath::exact, DepthPath::float32}) {
        CHECK(changed_share(path, PlaneAnchor::first_vertex, 0, rotated) == 0.0);
        CHECK(changed_share(path, PlaneAnchor::window_corner, 512, move) == 0.0);
    }
}
