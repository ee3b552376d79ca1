// Tests the showroom against the table of scenes/reference/scenes.md 12: corners that a separate division projects are
// at the pixels and depths that it states.
#include "scenes/procedural/showroom.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace strata;
using namespace strata::scenes;

namespace {

struct Extent {
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9, nearest = 1e9, farthest = -1e9;
};

// Extent of x / w and y / w in pixels of a 64 x 64 frame, and of the depth; the near plane is at distance 1.
Extent extent_of(const pipeline::Mesh& mesh) {
    Extent e;
    for (const pipeline::Vec3& p : mesh.positions) {
        const double w = -double{p.z}, x = 32 + 32 * double{p.x} / w, y = 32 - 32 * double{p.y} / w;
        e = {std::min(e.left, x),
             std::min(e.top, y),
             std::max(e.right, x),
             std::max(e.bottom, y),
             std::min(e.nearest, 1 - 1 / w),
             std::max(e.farthest, 1 - 1 / w)};
    }
    return e;
}

bool is_near(double found, double wanted) { return std::fabs(found - wanted) < 1e-5; }

}  // namespace

TEST_CASE("the objects of the showroom are at the positions of the specification") {
    const Scene scene = make_showroom({});
    struct Stated {
        const char* name;
        Extent extent;
    };
    const Stated stated[] = {{"wall", {8, 8, 56, 56, 1 - 1 / 12.0, 1 - 1 / 12.0}},
                             {"post", {28, 8, 32, 60, 1 - 1 / 3.0, 1 - 1 / 5.0}},
                             {"sign", {36, 10, 52, 26, 1 - 1 / 6.0, 1 - 1 / 6.0}},
                             {"perspective", {4, 30, 60, 50, 0.5, 0.9}},
                             {"lit", {10, 12, 26, 28, 0.8, 0.8}},
                             {"ties", {2, 34, 18, 46, 1 - 1 / 7.0, 1 - 1 / 7.0}},
                             {"near plane", {50, 2, 64, 64, -1, 0.75}},
                             {"edges", {20.5, 54.5, 40.5, 61.5, 0.5, 0.5}}};
    for (const auto& [name, wanted] : stated) {
        INFO(name);
        const auto mesh = std::ranges::find(scene.list.meshes, name, &pipeline::Mesh::name);
        REQUIRE(mesh != scene.list.meshes.end());
        const Extent found = extent_of(*mesh);
        CHECK(is_near(found.left, wanted.left));
        CHECK(is_near(found.top, wanted.top));
        CHECK(is_near(found.right, wanted.right));
        CHECK(is_near(found.bottom, wanted.bottom));
        CHECK(is_near(found.nearest, wanted.nearest));
        CHECK(is_near(found.farthest, wanted.farthest));
    }
}

TEST_CASE("the showroom's own view keeps x and y and maps w to depth 1 - 1 / w") {
    const Scene scene = make_showroom({});
    REQUIRE(scene.own_view);
    const Matrix& p = scene.own_view->projection;
    for (const double w : {1.0, 2.0, 12.0}) {
        const double z = p[2][2] * -w + p[3][2], clip_w = p[2][3] * -w + p[3][3];
        CHECK(clip_w == w);
        CHECK(0.5 + 0.5 * z / clip_w == Approx(1 - 1 / w).epsilon(1e-15));
        CHECK(p[0][0] == 1);
        CHECK(p[1][1] == 1);
    }
}

TEST_CASE("without light no material of the showroom is lit and colours follow the colour space") {
    const Scene lit = make_showroom({}), unlit = make_showroom({.light = false}),
                linear = make_showroom({.color_space = pipeline::ColorSpace::linear});
    const auto is_lit = [](const pipeline::Material& m) { return !m.unlit; };
    CHECK(std::ranges::count_if(lit.list.materials, is_lit) == 1);
    CHECK(std::ranges::count_if(unlit.list.materials, is_lit) == 0);
    CHECK(linear.list.materials[1].front[0] < lit.list.materials[1].front[0]);
    CHECK(linear.list.textures[0].decode_srgb);
}
