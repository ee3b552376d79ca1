// Tests the shape of the teapot: published extents, closed edges, orientation, normals and colours.
#include "scenes/procedural/teapot.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

namespace {

using namespace strata::scenes;
using strata::pipeline::Mesh;
using strata::pipeline::Vec3;
using Point = std::array<double, 3>;

Point wide(const Vec3& v) { return {double{v[0]}, double{v[1]}, double{v[2]}}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

TEST_CASE("the teapot has the extents of Newell's data set and is upright and rests just above the ground plane") {
    const Scene scene = make_teapot({}, 16);
    const Mesh& pot = scene.list.meshes[0];
    Point lo{9, 9, 9}, hi{-9, -9, -9};
    for (const Vec3& p : pot.positions) {
        for (std::size_t i = 0; i < 3; ++i) {
            lo[i] = std::min(lo[i], double{p[i]});
            hi[i] = std::max(hi[i], double{p[i]});
        }
    }
    CHECK(lo[1] == 0);  // centre of the bottom
    CHECK(hi[1] == Approx(3.15));
    CHECK(hi[2] == Approx(2).margin(0.01));  // the belly
    CHECK(lo[2] == -hi[2]);                  // mirrored exactly
    CHECK(lo[0] == Approx(-3).margin(0.01));
    CHECK((hi[0] > 3.4 && hi[0] < 3.525));  // the spout does not reach its control points
    for (const Vec3& p : scene.list.meshes[1].positions) CHECK((p[1] < 0 && p[1] > -0.05f));
}

TEST_CASE("neighbouring patches of the body and lid and bottom meet without cracks") {
    // Edges are identified by the positions of their endpoints. Each is shared by two triangles, except the boundary
    // edges: the rims of body and lid (4 patches each) and both ends of handle and spout (2 patches each), 4 + 4 + 2 *
    // 2 + 2 * 2 = 16 patch sides of n edges.
    for (const int n : {4, 7, 16}) {
        const Mesh pot = make_teapot({}, n).list.meshes[0];
        std::map<std::set<Point>, int> edges;
        for (std::size_t t = 0; t < pot.indices.size(); t += 3)
            for (std::size_t k = 0; k < 3; ++k)
                ++edges[{wide(pot.positions[pot.indices[t + k]]), wide(pot.positions[pot.indices[t + (k + 1) % 3]])}];
        int open = 0, crowded = 0;
        for (const auto& [ends, count] : edges) {
            open += count == 1 ? 1 : 0;
            crowded += count > 2 ? 1 : 0;
        }
        INFO("tessellation " << n);
        CHECK(crowded == 0);
        CHECK(open == 16 * n);
    }
}

TEST_CASE("triangles are counterclockwise seen from outside and normals point outward") {
    const Mesh pot = make_teapot({}, 16).list.meshes[0];
    int turned = 0;
    double volume = 0;
    for (std::size_t t = 0; t < pot.indices.size(); t += 3) {
        const Point a = wide(pot.positions[pot.indices[t]]), b = wide(pot.positions[pot.indices[t + 1]]),
                    c = wide(pot.positions[pot.indices[t + 2]]);
        const Point face = cross(minus(b, a), minus(c, a));
        for (std::size_t k = 0; k < 3; ++k) turned += dot(face, wide(pot.normals[pot.indices[t + k]])) > 0 ? 0 : 1;
        volume += dot(a, cross(b, c)) / 6;
    }
    CHECK(turned == 0);
    CHECK(volume > 10);  // would be negative if the surface were inside out
}

TEST_CASE("all normals of the teapot have unit length and are vertical at the degenerate poles of lid and bottom") {
    const Mesh pot = make_teapot({}, 16).list.meshes[0];
    int wrong = 0, poles = 0;
    for (std::size_t i = 0; i < pot.normals.size(); ++i) {
        const Point n = wide(pot.normals[i]);
        wrong += std::abs(dot(n, n) - 1) < 1e-6 ? 0 : 1;
        const Vec3& p = pot.positions[i];
        if (p[0] != 0 || p[2] != 0 || (p[1] != 0 && p[1] != 3.15f)) continue;
        ++poles;
        wrong += n[1] == (p[1] == 0 ? -1 : 1) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(poles == 8 * 17);  // n + 1 = 17 vertices of one degenerate side, for 4 lid and 4 bottom patches
}

TEST_CASE(
    "the teapot is red outside and green inside on a blue plane and everything is two-sided and half transparent") {
    const auto materials = make_teapot({}, 2).list.materials;
    const auto is_mostly = [](const strata::pipeline::Rgba& color, std::size_t channel) {
        for (std::size_t c = 0; c < 3; ++c)
            if (c != channel && color[c] >= 0.5f * color[channel]) return false;
        return color[3] == 0.5f;
    };
    CHECK(is_mostly(materials[0].front, 0));
    CHECK(is_mostly(materials[0].back, 1));
    CHECK(is_mostly(materials[1].front, 2));
    CHECK(materials[1].back == materials[1].front);
    for (const auto& material : materials) {
        CHECK(material.double_sided);
        CHECK(material.alpha_mode == strata::pipeline::AlphaMode::blend);
    }
}
