// Tests that the splats lie on the teapot's triangles, and their texture against its formula.
#include "scenes/procedural/splats.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/procedural/teapot.h"

using namespace strata::scenes;
using strata::pipeline::Mesh;
using strata::pipeline::Vec3;

namespace {

using SplatVector = std::array<double, 3>;
SplatVector splat_vector(const Vec3& a, const Vec3& b) {
    return {double{a[0]} - double{b[0]}, double{a[1]} - double{b[1]}, double{a[2]} - double{b[2]}};
}
double scalar_product(const SplatVector& a, const SplatVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// By barycentric coordinates and the distance that they leave.
bool is_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const SplatVector u = splat_vector(b, a), v = splat_vector(c, a), w = splat_vector(p, a);
    const double uu = scalar_product(u, u), uv = scalar_product(u, v), vv = scalar_product(v, v), d = uu * vv - uv * uv;
    if (d == 0) return false;
    const double s = (vv * scalar_product(w, u) - uv * scalar_product(w, v)) / d,
                 t = (uu * scalar_product(w, v) - uv * scalar_product(w, u)) / d;
    const SplatVector rest{w[0] - s * u[0] - t * v[0], w[1] - s * u[1] - t * v[1], w[2] - s * u[2] - t * v[2]};
    return s > -1e-3 && t > -1e-3 && s + t < 1.001 && scalar_product(rest, rest) < 1e-11;
}

}  // namespace

TEST_CASE("every splat lies on a triangle of the teapot") {
    const Scene scene = make_splats({}, 5, 200), teapot = make_teapot({}, 16);
    const Mesh &cloud = scene.list.meshes[0], &pot = teapot.list.meshes[0];
    CHECK(cloud.primitive == strata::pipeline::Primitive::points);
    REQUIRE(cloud.positions.size() == 200);
    REQUIRE(cloud.indices.size() == 600);
    int on_pot = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        for (std::size_t k = 0; k < 3; ++k) CHECK(cloud.indices[3 * i + k] == i);
        CHECK(cloud.colors[i][3] == 0.5f);
        bool found = false;
        for (std::size_t t = 0; t < pot.indices.size() && !found; t += 3)
            found = is_on_triangle(cloud.positions[i], pot.positions[pot.indices[t]], pot.positions[pot.indices[t + 1]],
                                   pot.positions[pot.indices[t + 2]]);
        on_pot += found ? 1 : 0;
    }
    CHECK(on_pot == 200);
    CHECK(make_splats({}, 5, 200).list.meshes[0] == cloud);
}

TEST_CASE("the splats' texture is round and falls to nothing at its sides") {
    const Scene scene = make_splats({}, 1, 1);
    REQUIRE(scene.list.textures.size() == 1);
    const auto& texels = scene.list.textures[0].texels;
    REQUIRE(texels.size() == 16 * 16 * 4);
    for (std::size_t y = 0; y < 16; ++y)
        for (std::size_t x = 0; x < 16; ++x) {
            const double dx = static_cast<double>(x) - 7.5, dy = static_cast<double>(y) - 7.5;
            const double alpha = 255 * std::max(0.0, 1 - (dx * dx + dy * dy) / 64);
            CHECK(texels[4 * (16 * y + x)] == 255);
            CHECK(texels[4 * (16 * y + x) + 3] == static_cast<int>(std::floor(alpha + 1e-9)));
        }
}
