// Tests attributes against rationals (rational.h) with the roundings of rasterizer/reference/attributes.md 1.1 written
// out: product, plane, plane of 1/w, quotient.
#include "rasterizer/values/fragment_values.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] std::vector<SetupTriangle> random_triangles(Random& random, int count, int size, int bits) {
    std::vector<SetupTriangle> triangles;
    while (static_cast<int>(triangles.size()) < count) {
        const int outside = triangles.size() % 3 == 0 ? 20000 : 4;
        const std::array p{random_point(random, size, size, bits, outside),
                           random_point(random, size, size, bits, outside),
                           random_point(random, size, size, bits, outside)};
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        const auto w = [&] { return random_float(random, 0.05f, 8); };
        const auto z = [&] { return double{random_float(random, 0, 1)}; };
        SetupTriangle t = window_triangle(p, bits, {z(), z(), z()}, {w(), w(), w()});
        for (std::size_t a = 0; a < attribute_count; ++a)
            for (std::size_t i = 0; i < 3; ++i)
                t.attribute[i][a] = random_float(random, a < 4 ? 0 : -1, 1) * (a == 5 ? 300 : 1);
        triangles.push_back(t);
    }
    return triangles;
}

[[nodiscard]] float model_attribute(const std::array<Rational, 3>& b, const std::array<float, 3>& u,
                                    const std::array<float, 3>& inverse_w) {
    std::array<float, 3> product;
    for (std::size_t i = 0; i < 3; ++i) product[i] = nearest_float(Rational{u[i]} * Rational{inverse_w[i]});
    const float above = nearest_float(plane_value(b, product)), below = nearest_float(plane_value(b, inverse_w));
    return nearest_float(Rational{above} / Rational{below});
}

[[nodiscard]] float attribute_of(const Fragment& f, std::size_t a) { return a < 4 ? f.color[a] : f.texcoord[a - 4]; }

[[nodiscard]] std::array<float, 3> corner_values(const SetupTriangle& t, std::size_t a) {
    return {t.attribute[0][a], t.attribute[1][a], t.attribute[2][a]};
}

struct Compared {
    std::uint64_t values = 0, wrong = 0;
};

// Compares all attributes of the triangle's fragments with the model's.
void compare(const SetupTriangle& t, Compared& found) {
    for (const Fragment& f : draw(window_geometry({t}, 12, 12, {})).fragments) {
        const std::array<Rational, 3> b = barycentric(t.p, f.x, f.y, 8);
        for (std::size_t a = 0; a < attribute_count; ++a, ++found.values)
            found.wrong += attribute_of(f, a) != model_attribute(b, corner_values(t, a), t.inverse_w) ? 1 : 0;
    }
}

}  // namespace

TEST_CASE("attributes are perspective-correct with every rounding of the rule for every subpixel setting", "[slow]") {
    constexpr std::uint64_t seed = 71;
    Random random{seed};
    std::uint64_t values = 0, wrong = 0;
    for (const int bits : {4, 8, 12})
        for (const SetupTriangle& t : random_triangles(random, 60, 12, bits))
            for (const Fragment& f : draw(window_geometry({t}, 12, 12, {.subpixel_bits = bits})).fragments) {
                const std::array<Rational, 3> b = barycentric(t.p, f.x, f.y, bits);
                for (std::size_t a = 0; a < attribute_count; ++a, ++values)
                    wrong += attribute_of(f, a) != model_attribute(b, corner_values(t, a), t.inverse_w) ? 1 : 0;
            }
    INFO("seed " << seed << ", values " << values);
    CHECK(values > 20000);
    CHECK(wrong == 0);
}

TEST_CASE("with w = 1 the division is skipped and nothing changes", "[slow]") {
    Random random{72};
    Compared found;
    for (SetupTriangle t : random_triangles(random, 60, 12, 8)) {
        t.inverse_w = {1, 1, 1};
        compare(t, found);
    }
    CHECK(found.values > 3000);
    CHECK(found.wrong == 0);
}

TEST_CASE("the division is made if any vertex has a w other than 1 in any combination", "[slow]") {
    Random random{73};
    Compared found;
    for (SetupTriangle t : random_triangles(random, 6, 12, 8))
        for (int others = 1; others < 8; ++others) {  // bit i: w of vertex i is not 1
            for (std::size_t i = 0; i < 3; ++i)
                t.inverse_w[i] = (others >> i & 1) != 0 ? 0.3f + 0.2f * static_cast<float>(i) : 1;
            compare(t, found);
        }
    CHECK(found.values > 1000);
    CHECK(found.wrong == 0);
}

TEST_CASE("three equal vertex values are that constant for any w") {
    Random random{73};
    std::uint64_t wrong = 0, fragments = 0;
    for (SetupTriangle t : random_triangles(random, 60, 12, 8)) {
        const float c = random_float(random, 0, 1);
        for (std::size_t i = 0; i < 3; ++i) t.attribute[i][3] = c;
        for (const Fragment& f : draw(window_geometry({t}, 12, 12, {})).fragments) {
            ++fragments;
            wrong += f.color[3] != c ? 1 : 0;
        }
    }
    CHECK(fragments > 500);
    CHECK(wrong == 0);
}

// Red increases by one unit in the last place per pixel, so that every pixel centre is half way between two numbers;
// green increases by two.
TEST_CASE("a value half way between two numbers is decided exactly once per fragment and a representable one never") {
    SetupTriangle t = window_triangle({{{0, 0}, {16 << 8, 0}, {0, 16 << 8}}}, 8);
    for (std::size_t i = 0; i < 3; ++i) t.attribute[i] = {1, 1, 1, 1, 0, 0};
    t.attribute[1][0] = 1.0f + 0x1p-19f;
    t.attribute[1][1] = 1.0f + 0x1p-18f;
    constexpr FragmentNeeds colors{false, false, false, true, false, false};
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope kernels{simd};
        const DrawResult result = draw(window_geometry({t}, 12, 12, {}), {}, colors);
        CHECK(result.fragments.size() > 100);
        CHECK(result.exact_fallbacks == result.fragments.size());
        int wrong = 0;
        for (const Fragment& f : result.fragments) {
            const int even = f.x + f.x % 2;
            wrong += f.color[0] != 1.0f + static_cast<float>(even) * 0x1p-23f ? 1 : 0;
            wrong += f.color[1] != 1.0f + static_cast<float>(2 * f.x + 1) * 0x1p-23f ? 1 : 0;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("attribute planes can start at the unsnapped positions and then extrapolate") {
    Random random{74};
    std::uint64_t wrong = 0, changed = 0, fragments = 0;
    for (SetupTriangle t : random_triangles(random, 90, 12, 4)) {
        std::array<std::array<Rational, 2>, 3> q;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 2; ++k) {
                t.unsnapped[i][k] += random_float(random, 0, 0.06f);
                q[i][k] = Rational{t.unsnapped[i][k]};
            }
        const auto cross = [](const auto& a, const auto& b, const auto& c) -> Rational {
            return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        };
        const Rational area = cross(q[0], q[1], q[2]);
        if (abs(area) < 8) continue;  // slivers would only test the tolerance
        RasterRules rules{.subpixel_bits = 4, .plane_origin = PlaneOrigin::unsnapped};
        const auto unsnapped = draw(window_geometry({t}, 12, 12, rules)).fragments;
        rules.plane_origin = PlaneOrigin::snapped;
        const auto snapped = draw(window_geometry({t}, 12, 12, rules)).fragments;
        REQUIRE(unsnapped.size() == snapped.size());  // coverage is that of the snapped triangle
        for (std::size_t n = 0; n < unsnapped.size(); ++n) {
            const Fragment& f = unsnapped[n];
            const std::array c{Rational{2 * f.x + 1, 2}, Rational{2 * f.y + 1, 2}};
            const Rational depth = (cross(c, q[1], q[2]) * Rational{t.z[0]} + cross(q[0], c, q[2]) * Rational{t.z[1]} +
                                    cross(q[0], q[1], c) * Rational{t.z[2]}) /
                                   area;
            ++fragments;
            changed += f.shader_z != snapped[n].shader_z ? 1 : 0;
            wrong += abs(Rational{f.shader_z} - depth) > power(-25) + power(-40) ? 1 : 0;  // half a unit below 1
        }
    }
    CHECK(fragments > 1000);
    CHECK(changed * 2 > fragments);
    CHECK(wrong == 0);
}

TEST_CASE("shader_z is neither clamped nor quantized and the code is clamped to the depth range") {
    const std::array<SubpixelPoint, 3> p{{{0, 0}, {16 * 256, 0}, {0, 16 * 256}}};
    Geometry geometry = window_geometry({window_triangle(p, 8, {-0.5, 1.5, 0.5})}, 16, 16, {});
    for (const bool reversed : {false, true})
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
            for (const DepthPath path : {DepthPath::float32, DepthPath::exact}) {
                geometry.state.depth_near = reversed ? 0.875f : 0.25f;
                geometry.state.depth_far = reversed ? 0.25f : 0.875f;
                geometry.state.depth_format = format;
                std::uint64_t wrong = 0, below = 0, above = 0;
                for (const Fragment& f : draw(geometry, {path, format}, everything).fragments) {
                    const Rational z = plane_value(barycentric(p, f.x, f.y, 8), std::array{-0.5, 1.5, 0.5});
                    const Rational clamped =
                        z < Rational{1, 4} ? Rational{1, 4} : (z > Rational{7, 8} ? Rational{7, 8} : z);
                    below += z < 0 ? 1 : 0;
                    above += z > 1 ? 1 : 0;
                    wrong += Rational{f.shader_z} != z ? 1 : 0;  // few bits, so exact
                    const Rational max = format == DepthFormat::d16 ? 65535 : 16777215;
                    const Integer code = format == DepthFormat::d32f
                                             ? Integer{std::bit_cast<std::uint32_t>(nearest_float(clamped))}
                                             : floor(clamped * max + Rational{1, 2});
                    wrong += Integer{f.code} != code || f.exact_code != f.code ? 1 : 0;
                }
                CHECK(below > 0);
                CHECK(above > 0);
                CHECK(wrong == 0);
            }
}

TEST_CASE("fragments outside the depth range are removed with per-fragment z clip unless depth is clamped") {
    const std::array<SubpixelPoint, 3> p{{{0, 0}, {16 * 16, 0}, {0, 16 * 16}}};
    const RasterRules rules{.subpixel_bits = 4, .z_clip = ZClip::per_fragment};
    // Beyond both ends of the range, beyond one of them, and beyond none.
    using Depths = std::array<double, 3>;
    for (const Depths& z : {Depths{-0.5, 1.5, 0.5}, {-0.5, 0.5, 0.25}, {0.25, 1.5, 0.5}, {0, 1, 0.5}}) {
        Geometry geometry = window_geometry({window_triangle(p, 4, z)}, 16, 16, rules);
        const auto all = draw(window_geometry(triangles_of(geometry), 16, 16, {.subpixel_bits = 4})).fragments;
        std::vector<Fragment> inside;
        for (const Fragment& f : all)
            if (f.shader_z >= 0.0f && f.shader_z <= 1.0f) inside.push_back(f);
        INFO("depths " << z[0] << ' ' << z[1] << ' ' << z[2]);
        CHECK((inside.size() < all.size()) == (z[0] < 0 || z[1] > 1));
        CHECK(draw(geometry).fragments == inside);
        geometry.state.depth_clamp = true;
        CHECK(draw(geometry).fragments == all);
    }
}

TEST_CASE("the three depth paths store a vertex value at a sample on that vertex") {
    const std::array<SubpixelPoint, 3> p{{{8, 8}, {8 + 4 * 16, 8}, {8, 8 + 4 * 16}}};
    const RasterRules rules{
        .subpixel_bits = 4, .window_z = WindowZ::buffer_units, .depth_rounding = DepthRounding::floor};
    Geometry geometry = window_geometry({window_triangle(p, 4, {12345.0, 99999.0, 16777215.0})}, 8, 8, rules);
    geometry.state.depth_format = DepthFormat::d24;
    for (const DepthPath path : {DepthPath::window_z, DepthPath::exact})
        CHECK(draw(geometry, {path, DepthFormat::d24}, everything).fragments.front().code == 12345);
}
