// Tests the shadow demo against the rule of shadow_demo.h: planes and directions by their equations, and the light's
// view by projecting every vertex.
#include "scenes/procedural/shadow_demo.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/procedural/teapot.h"

namespace {

using namespace strata::scenes;
using strata::pipeline::AlphaMode;
using strata::pipeline::Matrix;
using strata::pipeline::Mesh;
using Homogeneous = std::array<double, 4>;

Homogeneous times(const Matrix& m, const Homogeneous& p) {
    Homogeneous q{};
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) q[r] += m[c][r] * p[c];
    return q;
}

bool is_in_view(const strata::pipeline::ShadowLight& light, const strata::pipeline::Vec3& p) {
    const Homogeneous clip = times(light.projection, times(light.view, {double{p[0]}, double{p[1]}, double{p[2]}, 1}));
    for (std::size_t i = 0; i < 3; ++i)
        if (std::fabs(clip[i]) > clip[3]) return false;
    return clip[3] > 0;
}

// The unit normal of a flat quad from two of its sides; NaN if its corners are not in one plane.
std::array<double, 3> normal_of(const Mesh& quad) {
    std::array<std::array<double, 3>, 3> side{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            side[k][i] = double{quad.positions.at(k + 1)[i]} - double{quad.positions.at(0)[i]};
    const auto& [a, b, c] = side;
    std::array<double, 3> n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::hypot(n[0], n[1], n[2]), off = n[0] * c[0] + n[1] * c[1] + n[2] * c[2];
    for (double& x : n) x /= std::fabs(off) < 1e-5 * length ? length : std::nan("");
    return n;
}

}  // namespace

TEST_CASE("the shadow demo draws a square ground and the pot and last the pane next to it") {
    const Scene scene = make_shadow_demo({});
    const auto& list = scene.list;
    REQUIRE(list.meshes.size() == 3);
    REQUIRE(list.instances.size() == 3);
    const std::uint32_t order[] = {1, 0, 2};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(list.instances[i].mesh == order[i]);
        CHECK(list.instances[i].material == order[i]);
        CHECK(list.instances[i].model == strata::pipeline::identity);
    }
    CHECK(list.meshes[0] == make_teapot({}, 16).list.meshes[0]);
    CHECK(list.meshes[1].name == "ground");
    CHECK(list.meshes[2].name == "pane");
    CHECK(list.materials[0].alpha_mode == AlphaMode::opaque);
    CHECK(list.materials[1].alpha_mode == AlphaMode::opaque);
    CHECK(list.materials[2].alpha_mode == AlphaMode::blend);
    CHECK(list.materials[0].front[3] == 1);
    CHECK(list.materials[1].front[3] == 1);
    CHECK(list.materials[2].front[3] == 0.4f);
    for (const auto& material : list.materials) {
        CHECK(material.double_sided);
        CHECK_FALSE(material.unlit);
        CHECK(material.front == material.back);
    }
}

TEST_CASE("ground and pane are rectangles and have their own lighting normals") {
    const auto meshes = make_shadow_demo({}).list.meshes;
    const double sides[][2] = {{9, 9}, {std::hypot(2.0, 2.8), 2.2}};
    for (const std::size_t m : {std::size_t{1}, std::size_t{2}}) {
        const Mesh& quad = meshes.at(m);
        REQUIRE(quad.positions.size() == 4);
        CHECK(quad.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
        const auto normal = normal_of(quad);
        for (const auto& written : quad.normals)
            for (std::size_t i = 0; i < 3; ++i) CHECK(double{written[i]} == Approx(normal[i]).margin(1e-3));
        for (std::size_t k = 0; k < 4; ++k) {
            const auto &a = quad.positions[k], &b = quad.positions[(k + 1) % 4];
            CHECK(std::hypot(double{b[0]} - double{a[0]}, double{b[1]} - double{a[1]}, double{b[2]} - double{a[2]}) ==
                  Approx(sides[m - 1][k % 2]).epsilon(1e-6));
        }
    }
    for (const auto& p : meshes[1].positions) CHECK(p[1] == -0.01f);
    float lowest = 9;
    for (const auto& p : meshes[2].positions) lowest = std::min(lowest, p[1]);
    CHECK(lowest == 0);  // the pane is on the ground
}

TEST_CASE(
    "the light is at the position of the rule and faces the pot and its map contains everything that casts a shadow") {
    const Scene scene = make_shadow_demo({});
    REQUIRE(scene.list.light);
    const auto& light = *scene.list.light;
    const Homogeneous eye = times(light.view, {-5.5, 6.5, 3, 1}), target = times(light.view, {0.2, 0.8, 0, 1});
    for (std::size_t i = 0; i < 3; ++i) CHECK(eye[i] == Approx(0).margin(1e-12));
    CHECK(target[0] == Approx(0).margin(1e-12));
    CHECK(target[1] == Approx(0).margin(1e-12));
    CHECK(target[2] == Approx(-std::hypot(5.7, 5.7, 3.0)));
    const double cotangent = 1 / std::tan(75.0 / 2 * std::acos(-1.0) / 180);
    CHECK(light.projection[0][0] == Approx(cotangent));
    CHECK(light.projection[1][1] == Approx(cotangent));
    CHECK(light.projection[2][2] == Approx(-20.0 / 16));  // near 2, far 18
    CHECK(light.projection[3][2] == Approx(-72.0 / 16));
    CHECK(light.size_px == 1024);
    CHECK(light.ambient == 0.4f);
    CHECK(light.offset_factor == 1.5f);
    CHECK(light.offset_units == 8.0f);
    CHECK(light.percentage_closer);
    int outside = 0;
    for (const std::size_t caster : {std::size_t{0}, std::size_t{2}})
        for (const auto& p : scene.list.meshes.at(caster).positions) outside += is_in_view(light, p) ? 0 : 1;
    CHECK(outside == 0);
}

TEST_CASE("without light the materials of the demo are unlit and its shadows remain") {
    const Scene lit = make_shadow_demo({}), unlit = make_shadow_demo({.light = false});
    for (const auto& material : unlit.list.materials) CHECK(material.unlit);
    CHECK(unlit.list.light == lit.list.light);
    CHECK(unlit.list.meshes == lit.list.meshes);
}
