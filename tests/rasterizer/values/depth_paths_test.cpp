// The model: rationals (rational.h) with every rounding of depth_quotient.h's and depth_paths.h's rules written out.
#include "rasterizer/values/depth_paths.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

constexpr int size = 12;
constexpr FragmentNeeds depths{.color = false, .reference = true};

struct Triangle {
    SetupTriangle setup;
    std::array<float, 3> r, q;
};

[[nodiscard]] RasterRules buffer_rules(const DepthHypothesis& hypothesis = {}) {
    return {.subpixel_bits = 4,
            .window_z = WindowZ::buffer_units,
            .depth_rounding = DepthRounding::floor,
            .hypothesis = hypothesis};
}

// r / q lies within the buffer's range but for a few; q is w, and 1/w what the window has of it.
[[nodiscard]] std::vector<Triangle> random_triangles(std::uint64_t seed, int count, int bits, double units) {
    Random random{seed};
    std::vector<Triangle> triangles;
    while (static_cast<int>(triangles.size()) < count) {
        const int outside = triangles.size() % 3 == 0 ? 2000 : 4;
        const auto point = [&] { return random_point(random, size, size, bits, outside); };
        const std::array p{point(), point(), point()};
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        Triangle t;
        std::array<float, 3> inverse_w{};
        std::array<double, 3> z{};
        const bool is_flat = triangles.size() % 7 == 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const float w = is_flat ? 1.0f : random_float(random, 0.2f, 9);
            const float depth = random_float(random, -0.2f, 1.2f);
            z[i] = double{depth * static_cast<float>(units)};
            t.q[i] = w;
            t.r[i] = static_cast<float>(z[i]) * w;
            inverse_w[i] = 1.0f / w;
        }
        t.setup = window_triangle(p, bits, z, inverse_w);
        triangles.push_back(t);
    }
    return triangles;
}

[[nodiscard]] Geometry geometry_of(const std::vector<Triangle>& triangles, const RasterRules& rules,
                                   DepthFormat format) {
    std::vector<SetupTriangle> setup;
    VertexExtras extras{.stride = 2, .has_rq = true, .values = {}};
    for (const Triangle& t : triangles) {
        setup.push_back(t.setup);
        for (std::size_t i = 0; i < 3; ++i) extras.values.insert(extras.values.end(), {t.r[i], t.q[i]});
    }
    Geometry geometry = window_geometry(setup, size, size, rules);
    geometry.state.depth_format = format;
    geometry.extras = std::move(extras);
    return geometry;
}

[[nodiscard]] float to_bits(float v, int bits) {
    if (bits >= 24 || v == 0) return v;
    const Rational size_of = abs(Rational{v});
    const int unit = floor_log2(size_of) - bits + 1;
    const Rational scaled = size_of * power(-unit);
    Integer code = floor(scaled);
    const Rational rest = scaled - Rational{code};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && (code & 1) != 0)) ++code;
    return nearest_float((v < 0 ? -Rational{code} : Rational{code}) * power(unit));
}

[[nodiscard]] float model_divide(float n, float d, DivideRule rule) {
    const Rational one = Rational{1} / Rational{d};
    const Rational near{nearest_float(one)};
    switch (rule) {
        case DivideRule::exact: return nearest_float(Rational{n} / Rational{d});
        case DivideRule::cut_reciprocal: return nearest_float(Rational{n} * cut_to_bits(one, 24));
        case DivideRule::low_reciprocal: {
            const int unit = floor_log2(abs(near)) - 23;
            const bool is_power = abs(near) == power(unit + 23);  // below a power of two the unit is half as large
            const Rational step = power(is_power ? unit - 1 : unit);
            return nearest_float(Rational{n} * (near < 0 ? Rational{near + step} : Rational{near - step}));
        }
    }
    return 0;
}

[[nodiscard]] float model_coordinate(const std::array<Rational, 3>& b, const std::array<float, 3>& u,
                                     const std::array<float, 3>& inverse_w, const DepthHypothesis& h) {
    if (u[0] == u[1] && u[0] == u[2]) return to_bits(u[0], h.interpolant_bits);
    std::array<float, 3> product;
    for (std::size_t i = 0; i < 3; ++i) product[i] = nearest_float(Rational{u[i]} * Rational{inverse_w[i]});
    const float above = to_bits(nearest_float(plane_value(b, product)), h.interpolant_bits);
    if (inverse_w == std::array{1.0f, 1.0f, 1.0f}) return above;
    const float below = to_bits(nearest_float(plane_value(b, inverse_w)), h.interpolant_bits);
    return model_divide(above, below, h.divide);
}

// R in the units of r.
[[nodiscard]] float model_quotient(const Triangle& t, const Fragment& f, int bits, const DepthHypothesis& h) {
    const std::array<Rational, 3> b = barycentric(t.setup.p, f.x, f.y, bits);
    return model_divide(model_coordinate(b, t.r, t.setup.inverse_w, h), model_coordinate(b, t.q, t.setup.inverse_w, h),
                        h.divide);
}

[[nodiscard]] std::uint32_t model_floor(const Rational& v, std::uint32_t max) {
    if (v <= 0) return 0;
    return v >= max ? max : floor(v).convert_to<std::uint32_t>();
}

struct Tally {
    std::uint64_t fragments = 0, wrong = 0;
};

// Fragments whose compared R is not the model's.
[[nodiscard]] Tally compare_quotients(std::uint64_t seed, const DepthHypothesis& hypothesis, DepthFormat format) {
    Tally tally;
    const int count = hypothesis == DepthHypothesis{} ? 30 : 10;
    for (const Triangle& t : random_triangles(seed, count, 4, max_code(format)))
        for (const Fragment& f :
             draw(geometry_of({t}, buffer_rules(hypothesis), format), {DepthPath::perspective_rq, format}, depths)
                 .fragments) {
            const float r = model_quotient(t, f, 4, hypothesis);
            tally.wrong += f.reference_z != double{r} ||
                                   f.reference_code != model_floor(Rational{r}, max_code(format)) ||
                                   f.code != f.reference_code
                               ? 1
                               : 0;
            ++tally.fragments;
        }
    return tally;
}

}  // namespace

TEST_CASE("the compared depth is comparison (4): planes of r/w, q/w and 1/w and three divides, each rounded once",
          "[slow]") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
        const Tally tally = compare_quotients(901, {}, format);
        CHECK(tally.fragments > 500);
        CHECK(tally.wrong == 0);
    }
}

TEST_CASE("fewer bits of the interpolants and divides by a reciprocal change what their hypothesis says", "[slow]") {
    for (const int bits : {16, 17, 20, 23})
        CHECK(compare_quotients(902, {.interpolant_bits = bits}, DepthFormat::d24).wrong == 0);
    for (const DivideRule rule : {DivideRule::cut_reciprocal, DivideRule::low_reciprocal})
        CHECK(compare_quotients(903, {.divide = rule}, DepthFormat::d24).wrong == 0);
    CHECK(compare_quotients(904, {.interpolant_bits = 18, .divide = DivideRule::low_reciprocal}, DepthFormat::d24)
              .wrong == 0);
}

TEST_CASE("with full double interpolants R is the true quotient of the vertex products but for 2^-45 of it") {
    std::uint64_t fragments = 0, far = 0;
    for (const Triangle& t : random_triangles(905, 60, 4, 0xffffff)) {
        const RasterRules rules = buffer_rules({.interpolant_bits = full_double});
        for (const Fragment& f :
             draw(geometry_of({t}, rules, DepthFormat::d24), {DepthPath::perspective_rq, DepthFormat::d24}, depths)
                 .fragments) {
            const std::array<Rational, 3> b = barycentric(t.setup.p, f.x, f.y, 4);
            std::array<Rational, 3> r, q;
            for (std::size_t i = 0; i < 3; ++i) {
                r[i] = Rational{t.r[i]} * Rational{t.setup.inverse_w[i]};
                q[i] = Rational{t.q[i]} * Rational{t.setup.inverse_w[i]};
            }
            const Rational exact = plane_value(b, r) / plane_value(b, q);
            far += abs(Rational{f.reference_z} - exact) > power(-45) * 0x1000000 ? 1 : 0;
            ++fragments;
        }
    }
    CHECK(fragments > 150);
    CHECK(far == 0);
}

TEST_CASE("depth replace stores the depth that perspective_rq compares, and drops what leaves the depth range",
          "[slow]") {
    struct Case {
        DepthFormat format;
        RasterRules rules;
        double units;
    };
    for (const auto& [format, rules, units] :
         {Case{DepthFormat::d16, buffer_rules(), 65535.0}, Case{DepthFormat::d24, buffer_rules(), 16777215.0},
          Case{DepthFormat::d32f, {.subpixel_bits = 4}, 1.0}, Case{DepthFormat::d24, {.subpixel_bits = 4}, 1.0}}) {
        std::uint64_t kept = 0, dropped = 0, wrong = 0;
        for (const Triangle& t : random_triangles(906, 30, 4, units)) {
            const Geometry geometry = geometry_of({t}, rules, format);
            const DepthRequest replaced{DepthPath::depth_replace, format, DepthPath::perspective_rq};
            const auto stored = draw(geometry, replaced, depths).fragments;
            const auto coverage = draw(geometry, replaced, coverage_only).fragments;
            for (const Fragment& f : stored) wrong += f.code != f.reference_code ? 1 : 0;
            std::uint64_t inside = 0;
            const auto all = draw(geometry, {DepthPath::perspective_rq, format}, depths).fragments;
            for (const Fragment& f : all) {
                const float r = model_quotient(t, f, 4, {});
                inside += r >= 0 && double{r} <= units ? 1 : 0;
            }
            wrong += stored.size() != inside || coverage.size() != inside ? 1 : 0;
            kept += inside;
            dropped += all.size() - inside;
        }
        CHECK(kept > 300);
        CHECK(dropped > 10);
        CHECK(wrong == 0);
    }
}

TEST_CASE("with depth clamp a replaced depth outside the range is clamped, not dropped") {
    for (const Triangle& t : random_triangles(907, 20, 4, 65535)) {
        Geometry geometry = geometry_of({t}, buffer_rules(), DepthFormat::d16);
        geometry.state.depth_clamp = true;
        const auto replaced = draw(geometry, {DepthPath::depth_replace, DepthFormat::d16}, depths).fragments;
        CHECK(replaced == draw(geometry, {DepthPath::perspective_rq, DepthFormat::d16}, depths).fragments);
    }
}

namespace {

[[nodiscard]] float rounded(const Rational& v) { return nearest_float(v); }
[[nodiscard]] float plus(float a, float b) { return rounded(Rational{a} + Rational{b}); }
[[nodiscard]] float minus(float a, float b) { return rounded(Rational{a} - Rational{b}); }
[[nodiscard]] float times(float a, float b) { return rounded(Rational{a} * Rational{b}); }

// depth_paths.h, float32_plane; false where the slopes do not exist.
[[nodiscard]] std::optional<float> model_float32_plane(const SetupTriangle& t, const Fragment& f, int bits,
                                                       PlaneAnchor anchor, PlaneOrigin origin) {
    std::array<float, 3> x, y, z;
    for (std::size_t i = 0; i < 3; ++i) {
        const bool snaps = origin == PlaneOrigin::snapped;
        x[i] = snaps ? rounded(Rational{t.p[i].x} / (1 << bits)) : t.unsnapped[i][0];
        y[i] = snaps ? rounded(Rational{t.p[i].y} / (1 << bits)) : t.unsnapped[i][1];
        z[i] = static_cast<float>(t.z[i]);
    }
    const float x1 = minus(x[1], x[0]), y1 = minus(y[1], y[0]), z1 = minus(z[1], z[0]);
    const float x2 = minus(x[2], x[0]), y2 = minus(y[2], y[0]), z2 = minus(z[2], z[0]);
    const float area = minus(times(x1, y2), times(x2, y1));
    if (area == 0) return std::nullopt;
    const float dx = rounded(Rational{minus(times(z1, y2), times(z2, y1))} / Rational{area});
    const float dy = rounded(Rational{minus(times(z2, x1), times(z1, x2))} / Rational{area});
    float base = z[0], ox = x[0], oy = y[0];
    if (anchor == PlaneAnchor::window_corner) {
        base = minus(minus(base, times(dx, ox)), times(dy, oy));
        ox = oy = 0;
    }
    const float px = static_cast<float>(f.x) + 0.5f, py = static_cast<float>(f.y) + 0.5f;
    return plus(plus(base, times(dx, minus(px, ox))), times(dy, minus(py, oy)));
}

}  // namespace

TEST_CASE("float32_plane rounds its slopes and every step from its anchor to binary32", "[slow]") {
    for (const PlaneAnchor anchor : {PlaneAnchor::first_vertex, PlaneAnchor::window_corner})
        for (const auto& [bits, origin] : {std::pair{4, PlaneOrigin::snapped}, std::pair{8, PlaneOrigin::snapped},
                                           std::pair{8, PlaneOrigin::unsnapped}}) {
            RasterRules rules{.subpixel_bits = bits, .plane_origin = origin};
            rules.hypothesis.plane_anchor = anchor;
            std::uint64_t fragments = 0, wrong = 0;
            for (Triangle t : random_triangles(908, 10, bits, 1.0)) {
                for (auto& position : t.setup.unsnapped) position[0] += 0.0007f, position[1] -= 0.0011f;
                for (const Fragment& f : draw(geometry_of({t}, rules, DepthFormat::d32f),
                                              {DepthPath::float32_plane, DepthFormat::d32f}, depths)
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

// The share of fragments whose code changes when `change` is done to every triangle, which then lies `shift` pixels off.
template <class Change>
[[nodiscard]] double changed_share(DepthPath path, PlaneAnchor anchor, int shift, const Change& change) {
    constexpr int bits = 8;
    RasterRules rules{.subpixel_bits = bits};
    rules.hypothesis.plane_anchor = anchor;
    std::uint64_t fragments = 0, changed = 0;
    for (const Triangle& t : random_triangles(909, 200, bits, 1.0)) {
        const auto codes = [&](const SetupTriangle& triangle, int at) {
            Geometry g = window_geometry({triangle}, size + at, size + at, rules);
            g.state.viewport = {at, at, size + at, size + at};
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

TEST_CASE("a reference is to the bit the depth that a pass storing by that path would store") {
    constexpr std::array paths{DepthPath::window_z, DepthPath::perspective_rq, DepthPath::float32,
                               DepthPath::float32_plane, DepthPath::exact};
    for (const WindowZRule rule : {WindowZRule::chip, WindowZRule::exact, WindowZRule::float32}) {
        std::vector<Triangle> triangles = random_triangles(910, 40, 4, 0xffffff);
        const Geometry geometry = geometry_of(triangles, buffer_rules({.window_z = rule}), DepthFormat::d24);
        std::uint64_t pairs = 0, wrong = 0, unlike = 0;
        for (const DepthPath stored : paths)
            for (const DepthPath compared : paths) {
                const auto both = draw(geometry, {stored, DepthFormat::d24, compared}, depths).fragments;
                const auto alone = draw(geometry, {compared, DepthFormat::d24}, depths).fragments;
                for (std::size_t i = 0; i < both.size(); ++i) {
                    wrong +=
                        both[i].reference_code != alone[i].code || alone[i].reference_code != alone[i].code ? 1 : 0;
                    const auto floored = model_floor(Rational{both[i].reference_z}, 0xffffff);
                    unlike += floored != both[i].reference_code ? 1 : 0;
                }
                pairs += both.size();
            }
        CHECK(pairs > 15000);
        CHECK(wrong == 0);
        CHECK(unlike < pairs / 10000);  // exact: its binary64 value may lie on the other side of an integer
    }
}

TEST_CASE("window_z from the exact plane is path exact, and from binary32 the plane rounded once, then floored") {
    std::uint64_t fragments = 0, wrong = 0;
    for (const Triangle& t : random_triangles(911, 60, 4, 0xffffff)) {
        const auto by = [&](WindowZRule rule, DepthPath path) {
            return draw(geometry_of({t}, buffer_rules({.window_z = rule}), DepthFormat::d24), {path, DepthFormat::d24},
                        depths)
                .fragments;
        };
        const auto exact = by(WindowZRule::exact, DepthPath::window_z), truth = by(WindowZRule::chip, DepthPath::exact);
        for (std::size_t i = 0; i < exact.size(); ++i) wrong += exact[i].code != truth[i].code ? 1 : 0;
        for (const Fragment& f : by(WindowZRule::float32, DepthPath::window_z)) {
            const float z = nearest_float(plane_value(barycentric(t.setup.p, f.x, f.y, 4), t.setup.z));
            wrong += f.code != model_floor(Rational{z}, 0xffffff) ? 1 : 0;
            ++fragments;
        }
    }
    CHECK(fragments > 150);
    CHECK(wrong == 0);
}

TEST_CASE("r and q are clipped with their vertex and drop a triangle over whose w they are not finite") {
    RasterState state = scene_state(16, 16);
    TriangleSoup soup;
    soup.vertices = {
        {.x = -1, .y = -1, .z = 0, .w = 1}, {.x = 1, .y = -1, .z = 0, .w = 1}, {.x = 0, .y = 3, .z = 4, .w = 2}};
    soup.indices = {0, 1, 2};
    soup.runs = {{0, 3, 0, 0, true, false}};
    add_rq(soup, state, {});
    CHECK(soup.extras.values == std::vector<float>{0.5f, 1, 0.5f, 1, 3, 2});  // (z + w) / 2
    const Geometry clipped = set_up(soup, state, {}, 1);                      // cut where z = w, at t = 1/3
    REQUIRE(clipped.counters.clipped == 1);
    REQUIRE(clipped.extras.values.size() == 2 * clipped.vertices.size());
    for (std::size_t i = 0; i < clipped.vertices.size(); ++i) {
        const ClipVertex& v = clipped.vertices[i];
        CHECK(clipped.extras.of(i)[1] == Approx(v.w));
        CHECK(clipped.extras.of(i)[0] == Approx((v.z + v.w) / 2));
    }
    soup.extras.values[0] = 0x1p120f;
    soup.vertices[0].w = 0x1p-20f;
    soup.vertices[0].x = soup.vertices[0].y = 0;
    CHECK(set_up(soup, state, {}, 1).counters.non_finite == 1);
}
