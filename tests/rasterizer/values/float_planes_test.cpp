// Tests binary32 planes against the steps of float_planes.h's rule in rational arithmetic, each rounded to binary32 by
// definition.
#include "rasterizer/values/float_planes.h"

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] Rounded fused(Rounded a, Rounded b, Rounded c) {
    return {nearest_float(Rational{a.v} * Rational{b.v} + Rational{c.v})};
}

struct CornerOfPlane {
    Rounded x, y, value;
};
using CornersOfPlane = std::array<CornerOfPlane, 3>;

// Written directly from pipeline/reference/mesa-rasterizers.md 2.4. With samples the origin is the pixel's corner, and
// i and j are not integers (2.11).
[[nodiscard]] Rounded reciprocal_area(CornersOfPlane c, bool clockwise, bool fuses, float i, float j,
                                      float centre = 0.5f) {
    if (clockwise) std::swap(c[0], c[1]);
    const Rounded dx01 = c[0].x - c[1].x, dy01 = c[0].y - c[1].y, dx20 = c[2].x - c[0].x, dy20 = c[2].y - c[0].y;
    const Rounded ooa = Rounded{1} / (dx01 * dy20 - dy01 * dx20);
    const Rounded da01 = c[0].value - c[1].value, da20 = c[2].value - c[0].value;
    const Rounded dadx = da01 * (dy20 * ooa) - da20 * (dy01 * ooa), dady = da20 * (dx01 * ooa) - da01 * (dx20 * ooa);
    const Rounded half{centre};
    const Rounded origin = c[0].value - (dadx * (c[0].x - half) + dady * (c[0].y - half));
    const Rounded x{i}, y{j};
    return fuses ? fused(dady, y, fused(dadx, x, origin)) : (dadx * x + origin) + dady * y;
}

// pipeline/reference/mesa-rasterizers.md 3.1 and 3.3.
[[nodiscard]] Rounded least_corner(CornersOfPlane c, int i, int j) {
    std::stable_sort(c.begin(), c.end(), [](const auto& a, const auto& b) { return a.y.v < b.y.v; });
    const Rounded bot_dx = c[1].x - c[0].x, bot_dy = c[1].y - c[0].y, maj_dx = c[2].x - c[0].x,
                  maj_dy = c[2].y - c[0].y;
    const Rounded ooa = Rounded{1} / (maj_dx * bot_dy - bot_dx * maj_dy);
    const Rounded d_bot = c[1].value - c[0].value, d_maj = c[2].value - c[0].value, half{0.5f};
    const Rounded dadx = (bot_dy * d_maj - d_bot * maj_dy) * ooa, dady = (maj_dx * d_bot - d_maj * bot_dx) * ooa;
    const Rounded a0 = c[0].value - (dadx * (c[0].x - half) + dady * (c[0].y - half));
    Rounded value =
        (a0 + dadx * Rounded{static_cast<float>(i - i % 2)}) + dady * Rounded{static_cast<float>(j - j % 2)};
    if (i % 2 == 1) value = value + dadx;
    if (j % 2 == 1) value = value + dady;
    return value;
}

[[nodiscard]] Rounded value_by_rule(PlaneRule rule, const CornersOfPlane& c, bool clockwise, int i, int j) {
    if (rule == PlaneRule::least_corner) return least_corner(c, i, j);
    return reciprocal_area(c, clockwise, rule == PlaneRule::reciprocal_area_fused, static_cast<float>(i),
                           static_cast<float>(j));
}

constexpr std::array float_rules{PlaneRule::reciprocal_area, PlaneRule::reciprocal_area_fused, PlaneRule::least_corner};

[[nodiscard]] CornersOfPlane corners_of(const SetupTriangle& t, PlaneOrigin origin, auto value) {
    CornersOfPlane corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool snaps = origin == PlaneOrigin::snapped;
        corners[k].x.v = snaps ? static_cast<float>(t.p[k].x) / 256 : t.unsnapped[k][0];
        corners[k].y.v = snaps ? static_cast<float>(t.p[k].y) / 256 : t.unsnapped[k][1];
        corners[k].value = value(k);
    }
    return corners;
}

}  // namespace

TEST_CASE("every binary32 plane rule gives each fragment the depth of its rounded steps from either origin", "[slow]") {
    std::uint64_t wrong = 0, fragments = 0, unlike_exact = 0;
    for (const PlaneRule rule : float_rules)
        for (const PlaneOrigin origin : {PlaneOrigin::snapped, PlaneOrigin::unsnapped}) {
            const Device device{{.plane_origin = origin, .plane_rule = rule}, {}};
            const Geometry geometry = random_triangles(501, 60, 9, device);
            Geometry exact = geometry;
            exact.rules.plane_rule = PlaneRule::exact;
            const auto triangles = triangles_of(geometry);
            const auto found = draw(geometry).fragments, other = draw(exact).fragments;
            REQUIRE(found.size() == other.size());
            for (std::size_t n = 0; n < found.size(); ++n) {
                const Fragment& f = found[n];
                const SetupTriangle& t = triangles[f.primitive];
                const auto corners =
                    corners_of(t, origin, [&](std::size_t k) { return Rounded{static_cast<float>(t.z[k])}; });
                const bool clockwise = Edge{t.p[0], t.p[1]}.at(t.p[2]) > 0;
                // The stored code is clamped, the value for programs is not.
                const float z = value_by_rule(rule, corners, clockwise, f.x, f.y).v;
                wrong += f.shader_z == z && f.code == std::bit_cast<std::uint32_t>(std::clamp(z, 0.0f, 1.0f)) ? 0 : 1;
                unlike_exact += z == other[n].shader_z ? 0 : 1;
                ++fragments;
            }
        }
    CHECK(wrong == 0);
    CHECK(fragments > 5000);
    CHECK(unlike_exact > fragments / 10);
}

TEST_CASE("planes over unsnapped corners start at the pixel's corner and are evaluated at the sample") {
    std::uint64_t wrong = 0, fragments = 0;
    for (const PlaneRule rule : {PlaneRule::reciprocal_area, PlaneRule::reciprocal_area_fused})
        for (const SamplePoint sample : {SamplePoint{6, 2}, SamplePoint{15, 9}, SamplePoint{8, 8}, SamplePoint{0, 0}})
            for (const strata::Simd simd : strata::available_simd()) {
                const strata::SimdScope scope{simd};
                const bool is_central = sample.x != 8;
                const Device device{{.plane_origin = PlaneOrigin::unsnapped,
                                     .plane_rule = rule,
                                     .perspective = PerspectiveDivide::reciprocal,
                                     .sample_divisor = is_central ? SampleDivisor::centre : SampleDivisor::sample},
                                    {}};
                Geometry geometry = random_triangles(505, 20, 9, device);
                const auto triangles = triangles_of(geometry);
                geometry.state.sample = sample;
                for (const Fragment& f : draw(geometry).fragments) {
                    const SetupTriangle& t = triangles[f.primitive];
                    const bool clockwise = Edge{t.p[0], t.p[1]}.at(t.p[2]) > 0;
                    const float x = static_cast<float>(f.x) + static_cast<float>(sample.x) / 16,
                                y = static_cast<float>(f.y) + static_cast<float>(sample.y) / 16;
                    const auto plane = [&](auto value) {
                        return reciprocal_area(corners_of(t, PlaneOrigin::unsnapped, value), clockwise,
                                               rule == PlaneRule::reciprocal_area_fused, x, y, 0.0f);
                    };
                    wrong += f.shader_z != plane([&](std::size_t k) { return Rounded{static_cast<float>(t.z[k])}; }).v;
                    const auto inverse_w = [&](std::size_t k) { return Rounded{t.inverse_w[k]}; };
                    const Rounded under = reciprocal_area(corners_of(t, PlaneOrigin::unsnapped, inverse_w), clockwise,
                                                          rule == PlaneRule::reciprocal_area_fused,
                                                          is_central ? static_cast<float>(f.x) + 0.5f : x,
                                                          is_central ? static_cast<float>(f.y) + 0.5f : y, 0.0f);
                    const Rounded over =
                        plane([&](std::size_t k) { return Rounded{t.attribute[k][2]} * Rounded{t.inverse_w[k]}; });
                    wrong += f.color[2] != (over * (Rounded{1} / under)).v ? 1 : 0;
                    ++fragments;
                }
            }
    CHECK(wrong == 0);
    CHECK(fragments > 3000);
}

TEST_CASE("attributes by binary32 planes are the plane of a/w over the plane of 1/w or times its reciprocal",
          "[slow]") {
    std::uint64_t wrong = 0, multiplied = 0;
    for (const PlaneRule rule : float_rules)
        for (const PerspectiveDivide divide : {PerspectiveDivide::quotient, PerspectiveDivide::reciprocal}) {
            const Device device{{.plane_origin = PlaneOrigin::unsnapped, .plane_rule = rule, .perspective = divide},
                                {}};
            const Geometry geometry = random_triangles(502, 30, 9, device);
            const auto triangles = triangles_of(geometry);
            for (const Fragment& f : draw(geometry).fragments) {
                const SetupTriangle& t = triangles[f.primitive];
                const bool clockwise = Edge{t.p[0], t.p[1]}.at(t.p[2]) > 0;
                const auto plane = [&](auto value) {
                    return value_by_rule(rule, corners_of(t, PlaneOrigin::unsnapped, value), clockwise, f.x, f.y);
                };
                const Rounded under = plane([&](std::size_t k) { return Rounded{t.inverse_w[k]}; });
                for (std::size_t a = 0; a < 6; ++a) {
                    const Rounded over =
                        plane([&](std::size_t k) { return Rounded{t.attribute[k][a]} * Rounded{t.inverse_w[k]}; });
                    const Rounded quotient = over / under, product = over * (Rounded{1} / under);
                    const float expected = divide == PerspectiveDivide::quotient ? quotient.v : product.v;
                    wrong += (a < 4 ? f.color[a] : f.texcoord[a - 4]) == expected ? 0 : 1;
                    multiplied += quotient.v == product.v ? 0 : 1;
                }
            }
        }
    CHECK(wrong == 0);
    CHECK(multiplied > 100);
}

TEST_CASE("only colours that are equal at all corners are kept if the rules say so") {
    std::uint64_t kept = 0, wrong = 0, moved = 0;
    for (const PlaneRule rule : float_rules) {
        const Device device{
            {.plane_origin = PlaneOrigin::unsnapped, .plane_rule = rule, .perspective = PerspectiveDivide::reciprocal},
            {}};
        const Geometry geometry = random_triangles(504, 120, 9, device);
        Geometry keeping = geometry;
        keeping.rules.equal_colors = EqualColors::kept;
        const auto triangles = triangles_of(geometry);
        const auto before = draw(geometry).fragments, found = draw(keeping).fragments;
        REQUIRE(found.size() == before.size());
        for (std::size_t n = 0; n < found.size(); ++n) {
            wrong += found[n].texcoord == before[n].texcoord && found[n].code == before[n].code ? 0 : 1;
            const SetupTriangle& t = triangles[found[n].primitive];
            for (std::size_t c = 0; c < 4; ++c) {
                const float value = t.attribute[0][c];
                const bool is_equal = t.attribute[1][c] == value && t.attribute[2][c] == value;
                wrong += found[n].color[c] == (is_equal ? value : before[n].color[c]) ? 0 : 1;
                kept += is_equal ? 1 : 0;
                moved += is_equal && before[n].color[c] != value ? 1 : 0;
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(kept > 1000);
    CHECK(moved > 100);
}

TEST_CASE("a fused multiply-add is bit-identical to the host's std::fma") {
    Random random{503};
    std::uint64_t wrong = 0, unfused = 0;
    for (int n = 0; n < 200000; ++n) {
        const float a = random_float(random, -2, 2), b = random_float(random, 0, 2048), c = random_float(random, -1, 1);
        const float product = a * b, rounded_twice = product + c;
        wrong += fused_multiply_add(a, b, c) == std::fma(a, b, c) ? 0 : 1;
        unfused += rounded_twice == std::fma(a, b, c) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(unfused > 1000);
}

// 1 + 2^-23 + 2^-24 -+ 2^-60: in binary64 only the midpoint of two binary32 remains, so the lost part decides up or
// down.
TEST_CASE("a fused multiply-add next to the midpoint of two numbers is rounded to its own side for any signs") {
    const float least = 1.0f + 0x1p-23f, next = 1.0f + 0x1p-22f;
    const float below = 1.0f - 0x1p-18f, above = 0x1p-24f * (1.0f + 0x1p-18f);  // their product: 2^-24 - 2^-60
    CHECK(fused_multiply_add(below, above, least) == least);
    CHECK(fused_multiply_add(-below, above, -least) == -least);
    const float up = 1.0f + 0x1p-18f;  // up * above: slightly more than 2^-24
    CHECK(fused_multiply_add(up, above, 1.0f) == least);
    CHECK(fused_multiply_add(-up, above, -1.0f) == -least);
    CHECK(fused_multiply_add(below, above, 1.0f) == 1.0f);
    CHECK(fused_multiply_add(-below, above, -1.0f) == -1.0f);
    CHECK(fused_multiply_add(up, above, least) == next);
}

// 8815417 * 15964927 = 2^47 + 2^19 - 57. The sum 1 + 2^-24 + 2^-52 - 57 * 2^-71 rounds to an odd binary64 above the
// midpoint of two binary32, and must stay there: one step lower is that midpoint, which rounds to 1.
TEST_CASE("a fused multiply-add keeps a sum that is odd already") {
    const float a = 8815417 * 0x1p-24f, b = 15964927 * 0x1p-47f;
    CHECK(fused_multiply_add(a, b, 1.0f) == 1.0f + 0x1p-23f);
    CHECK(fused_multiply_add(-a, b, -1.0f) == -1.0f - 0x1p-23f);
    CHECK(std::fma(a, b, 1.0f) == 1.0f + 0x1p-23f);
}

TEST_CASE("a fused multiply-add of every three special values is that of std::fma") {
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    constexpr std::array<float, 13> special{inf,    -inf,   0.0f,    -0.0f,          1.0f, -1.0f, 3e38f,
                                            -3e38f, 1e-45f, -1e-45f, 1.1754944e-38f, 3.5f, nan};
    std::uint64_t wrong = 0, infinite = 0;
    for (const float a : special)
        for (const float b : special)
            for (const float c : special) {
                const float found = fused_multiply_add(a, b, c), expected = std::fma(a, b, c);
                const bool same = std::bit_cast<std::uint32_t>(found) == std::bit_cast<std::uint32_t>(expected);
                wrong += same || (std::isnan(found) && std::isnan(expected)) ? 0 : 1;
                infinite += std::isinf(expected) ? 1 : 0;
            }
    CHECK(wrong == 0);
    CHECK(infinite > 100);
}

TEST_CASE("clockwise corners are swapped so that each winding of a triangle has its own planes") {
    const std::array<WindowPosition, 3> p{{{3.3f, 1.7f}, {17.9f, 5.1f}, {6.2f, 21.4f}}};
    const std::array<float, 3> z{0.1f, 0.7f, 0.4f};
    const FloatPlane kept = FloatPlanes{PlaneRule::reciprocal_area, p, false}.plane(z);
    const FloatPlane turned = FloatPlanes{PlaneRule::reciprocal_area, p, true}.plane(z);
    const std::array<WindowPosition, 3> exchanged{p[1], p[0], p[2]};
    const FloatPlane by_hand = FloatPlanes{PlaneRule::reciprocal_area, exchanged, false}.plane({z[1], z[0], z[2]});
    CHECK(turned.origin == by_hand.origin);
    CHECK(turned.dx == by_hand.dx);
    CHECK(kept.origin != turned.origin);
}
