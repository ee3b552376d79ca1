// Tests the hair's strands against their description: roots, lengths, alpha, and lines that hang together.
#include "scenes/procedural/hair.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace strata::scenes;
using strata::pipeline::Mesh;
using strata::pipeline::Vec3;

namespace {

double length_between(const Vec3& a, const Vec3& b) {
    double squared = 0;
    for (int i = 0; i < 3; ++i) squared += (double{a[i]} - double{b[i]}) * (double{a[i]} - double{b[i]});
    return std::sqrt(squared);
}

}  // namespace

TEST_CASE("a strand has connected lines of one length from its root on the head") {
    constexpr int strands = 50, segments = 5;
    const Scene scene = make_hair({}, {.seed = 3, .strands = strands, .segments = segments});
    REQUIRE(scene.list.meshes.size() == 2);
    const Mesh& hair = scene.list.meshes[1];
    CHECK(hair.primitive == strata::pipeline::Primitive::lines);
    REQUIRE(hair.positions.size() == strands * (segments + 1));
    REQUIRE(hair.indices.size() == 3 * strands * segments);
    std::size_t index = 0;
    for (std::size_t s = 0; s < strands; ++s) {
        const std::size_t root = s * (segments + 1);
        CHECK(length_between(hair.positions[root], Vec3{0, 0, 0}) == Approx(1).margin(1e-6));
        CHECK(hair.positions[root][1] > -0.25f);
        CHECK(hair.colors[root][3] == 0.75f);
        CHECK(hair.colors[root + segments][3] == Approx(0.15f));
        // The first line follows the normal.
        CHECK(length_between(hair.positions[root + 1], Vec3{0, 0, 0}) == Approx(1 + 1.25 / segments).margin(1e-6));
        for (std::size_t k = 0; k < segments; ++k) {
            const auto a = static_cast<std::uint32_t>(root + k);
            CHECK(hair.indices[index++] == a);
            CHECK(hair.indices[index++] == a);
            CHECK(hair.indices[index++] == a + 1);
            CHECK(length_between(hair.positions[a], hair.positions[a + 1]) == Approx(1.25 / segments).margin(1e-6));
        }
    }
    CHECK(make_hair({}, {.seed = 3, .strands = strands, .segments = segments}).list.meshes[1] == hair);
    CHECK(!(make_hair({}, {.seed = 4, .strands = strands, .segments = segments}).list.meshes[1] == hair));
}

TEST_CASE("the hair's head is a closed unit sphere whose triangles face outwards") {
    const Scene scene = make_hair({}, {});
    const Mesh& head = scene.list.meshes[0];
    REQUIRE(head.indices.size() == 3 * 2 * 6 * 12 * 12);
    for (std::size_t i = 0; i < head.indices.size(); i += 3) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = head.positions[head.indices[i + k]];
        const Vec3 u{p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]},
            v{p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
        const double outwards = double{u[1] * v[2] - u[2] * v[1]} * double{p[0][0]} +
                                double{u[2] * v[0] - u[0] * v[2]} * double{p[0][1]} +
                                double{u[0] * v[1] - u[1] * v[0]} * double{p[0][2]};
        CHECK(outwards > 0);
    }
    CHECK(scene.list.materials[0].alpha_mode == strata::pipeline::AlphaMode::opaque);
}
