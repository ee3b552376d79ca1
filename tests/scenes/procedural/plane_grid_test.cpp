// Tests the plane stack vertex by vertex against the rule of plane_stack.h in binary64; hues use the C library's
// cosine.
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/procedural/plane_stack.h"

namespace {

using namespace strata::scenes;
using strata::pipeline::Mesh;

// Description of the first fault of plane i of a stack, whose first vertex is `first`; "" if there is none.
std::string wrong_with_plane(const Mesh& mesh, const PlaneStack& stack, int i, std::size_t first) {
    const int cells = stack.cells + i;
    const double offset = (i - (stack.count - 1) / 2.0) * stack.gap / 1048576, two_pi = 2 * std::acos(-1.0);
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const std::size_t v = first + static_cast<std::size_t>(row * (cells + 1) + column);
            const double x = -1 + 2.0 * column / cells, y = -1 + 2.0 * row / cells;
            const auto& p = mesh.positions.at(v);
            if (p[0] != static_cast<float>(x) || p[1] != static_cast<float>(y)) return "x, y";
            if (std::fabs(double{p[2]} - (0.4375 * x + 0.3125 * y + offset)) > 6e-8 * std::fabs(double{p[2]}) + 1e-15)
                return "z";
            for (int c = 0; c < 3; ++c) {
                const double hue = 0.5 + 0.5 * std::cos(two_pi * (double(i) / stack.count - c / 3.0));
                if (std::fabs(double{mesh.colors.at(v)[std::size_t(c)]} - hue) > 1e-7) return "colour";
            }
            if (mesh.colors[v][3] != 1) return "alpha";
        }
    return "";
}

}  // namespace

TEST_CASE("every vertex of every stack is on its plane's grid row by row in its plane's hue") {
    for (const int count : {1, 2, 5})
        for (const int cells : {1, 3})
            for (const double gap : {0.0, 1.0, 1048576.0}) {
                const PlaneStack stack{.count = count, .cells = cells, .gap = gap};
                const Mesh mesh = make_plane_stack({}, stack).list.meshes.at(0);
                std::size_t first = 0;
                for (int i = 0; i < count; ++i) {
                    INFO("plane " << i << " of " << count << ", " << cells << " cells, gap " << gap);
                    CHECK(wrong_with_plane(mesh, stack, i, first) == "");
                    first += static_cast<std::size_t>((cells + i + 1) * (cells + i + 1));
                }
                CHECK(mesh.positions.size() == first);
                CHECK(mesh.colors.size() == first);
            }
}

TEST_CASE("each square of a grid is two triangles that share its rising diagonal and are counterclockwise") {
    const Mesh mesh = make_plane_stack({}, {.count = 2, .cells = 2, .gap = 0}).list.meshes.at(0);
    const std::vector<std::uint32_t> first(mesh.indices.begin(), mesh.indices.begin() + 12);
    CHECK(first == std::vector<std::uint32_t>{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4});
    const std::vector<std::uint32_t> second(mesh.indices.begin() + 24, mesh.indices.begin() + 30);
    CHECK(second == std::vector<std::uint32_t>{9, 10, 14, 9, 14, 13});  // the next grid has four vertices per row
    REQUIRE(mesh.indices.size() == 6 * (4 + 9));
    int clockwise = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto &a = mesh.positions[mesh.indices[t]], &b = mesh.positions[mesh.indices[t + 1]],
                   &c = mesh.positions[mesh.indices[t + 2]];
        clockwise += (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) > 0 ? 0 : 1;
    }
    CHECK(clockwise == 0);
}

TEST_CASE("the plane farthest from an eye at +z is drawn first and all are one unlit two-sided mesh that blends") {
    const Scene scene = make_plane_stack({}, {.count = 4, .cells = 1, .gap = 4096});
    const Mesh& mesh = scene.list.meshes.at(0);
    std::size_t first = 0;
    for (std::size_t i = 0; i + 1 < 4; ++i) {
        const std::size_t next = first + (i + 2) * (i + 2);
        CHECK(mesh.positions[first][2] < mesh.positions[next][2]);  // both at x = y = -1
        CHECK(mesh.positions[next][2] - mesh.positions[first][2] == Approx(1.0 / 256).epsilon(1e-4));
        first = next;
    }
    REQUIRE(scene.list.materials.size() == 1);
    CHECK(scene.list.materials[0].unlit);
    CHECK(scene.list.materials[0].double_sided);
    CHECK(scene.list.materials[0].alpha_mode == strata::pipeline::AlphaMode::blend);
    CHECK(scene.list.instances == std::vector<strata::pipeline::Instance>{{.mesh = 0, .material = 0}});
    CHECK(mesh.normals.empty());
    CHECK(scene.name == "planes");
}
