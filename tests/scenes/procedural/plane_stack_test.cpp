// Tests the plane stack against plane equations from the rule of plane_stack.h in binary64, with a tolerance of one
// rounding to binary32.
#include "scenes/procedural/plane_stack.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace {

using namespace strata::scenes;

struct Corner {
    double x, y, z;
};

Corner corner(const strata::pipeline::Mesh& mesh, std::size_t index) {
    const auto& p = mesh.positions[mesh.indices[index]];
    return {double{p[0]}, double{p[1]}, double{p[2]}};
}

}  // namespace

TEST_CASE("the planes of a stack are parallel at the requested distance and each covers its square once") {
    const PlaneStack stack{.count = 3, .cells = 4, .gap = 1024};
    const auto mesh = make_plane_stack({}, stack).list.meshes[0];
    std::size_t index = 0;
    double worst = 0;
    for (int i = 0; i < stack.count; ++i) {
        const int cells = stack.cells + i;
        double area = 0;
        for (int triangle = 0; triangle < 2 * cells * cells; ++triangle, index += 3) {
            const Corner a = corner(mesh, index), b = corner(mesh, index + 1), c = corner(mesh, index + 2);
            for (const Corner& p : {a, b, c})
                worst = std::max(worst, std::fabs(p.z - (0.4375 * p.x + 0.3125 * p.y + (i - 1) / 1024.0)));
            const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
            CHECK(std::fabs(twice) > 0.5 * 4.0 / (cells * cells));
            area += std::fabs(twice) / 2;
        }
        CHECK(area == Approx(4));
    }
    CHECK(index == mesh.indices.size());
    CHECK(worst < 2e-7);
}

TEST_CASE("the parameters of a stack are part of its scene name") {
    CHECK(load_scene("planes:count=2,gap=0,cells=1", {}).list.meshes[0].indices.size() == 6 * (1 + 4));
    CHECK(load_scene("planes", {}).list.meshes == load_scene("planes:count=6,cells=8,gap=65536", {}).list.meshes);
}
