// Tests the teapot's surface against de Casteljau's construction in binary64, point by point; normals are from the last
// edges of the same construction.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/procedural/teapot.h"
#include "scenes/procedural/teapot_patches.h"

namespace {

using namespace strata::scenes;
using strata::pipeline::Mesh;
using Space = std::array<double, 3>;
using Cubic = std::array<Space, 4>;

Space between(const Space& a, const Space& b, double t) {
    Space point;
    for (std::size_t i = 0; i < 3; ++i) point[i] = a[i] + (b[i] - a[i]) * t;
    return point;
}

struct OnCurve {
    Space point, along;  // along: the direction of increasing t
};

OnCurve cast(Cubic c, double t) {
    for (std::size_t left = 3; left > 1; --left)
        for (std::size_t i = 0; i < left; ++i) c[i] = between(c[i], c[i + 1], t);
    OnCurve result{between(c[0], c[1], t), {}};
    for (std::size_t i = 0; i < 3; ++i) result.along[i] = c[1][i] - c[0][i];
    return result;
}

struct OnPatch {
    Space point, along_rows, along_columns;
};

OnPatch on_patch(std::size_t patch, double u, double v) {
    Cubic rows, columns;
    for (std::size_t a = 0; a < 4; ++a) {
        Cubic row, column;
        for (std::size_t b = 0; b < 4; ++b)
            for (std::size_t i = 0; i < 3; ++i) {
                row[b][i] = teapot_points[teapot_patches[patch][4 * a + b]][i];
                column[b][i] = teapot_points[teapot_patches[patch][4 * b + a]][i];
            }
        rows[a] = cast(row, v).point;
        columns[a] = cast(column, u).point;
    }
    const OnCurve down = cast(rows, u), across = cast(columns, v);
    return {down.point, down.along, across.along};
}

// True if `found` is close to a point of the table, whose z axis is up.
bool is_close(const strata::pipeline::Vec3& found, const Space& table, double tolerance) {
    const double expected[3] = {table[0], table[2], -table[1]};
    for (std::size_t i = 0; i < 3; ++i)
        if (std::fabs(double{found[i]} - expected[i]) > tolerance) return false;
    return true;
}

Space outward(const OnPatch& at) {
    const Space &a = at.along_columns, &b = at.along_rows;
    Space n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double& x : n) x = length > 1e-12 ? x / length : 0;
    return n;
}

bool is_zero(const Space& n) { return n[0] == 0 && n[1] == 0 && n[2] == 0; }

}  // namespace

TEST_CASE("each vertex of the teapot is its patch's point at i / n and j / n with the normal of the surface there") {
    for (const int n : {1, 2, 5}) {
        const Mesh pot = make_teapot({}, n).list.meshes.at(0);
        REQUIRE(pot.positions.size() == std::size_t(32 * (n + 1) * (n + 1)));
        REQUIRE(pot.normals.size() == pot.positions.size());
        std::string wrong;
        std::size_t vertex = 0, collapsed = 0;
        for (std::size_t patch = 0; patch < 32; ++patch)
            for (int i = 0; i <= n; ++i)
                for (int j = 0; j <= n; ++j, ++vertex) {
                    const OnPatch at = on_patch(patch, double(i) / n, double(j) / n);
                    const Space normal = outward(at);
                    collapsed += is_zero(normal) ? 1 : 0;
                    const bool right = is_close(pot.positions[vertex], at.point, 2e-7) &&
                                       (is_zero(normal) || is_close(pot.normals[vertex], normal, 1e-6));
                    if (!right && wrong.empty())
                        wrong =
                            "patch " + std::to_string(patch) + " at " + std::to_string(i) + ", " + std::to_string(j);
                }
        INFO("tessellation " << n);
        CHECK(wrong == "");
        CHECK(collapsed == std::size_t(8 * (n + 1)));  // first rows of the top of the lid and of the bottom
    }
}

TEST_CASE("each cell of a patch is two triangles and at a degenerate row the one without area is omitted") {
    const int n = 3;
    const Mesh pot = make_teapot({}, n).list.meshes.at(0);
    std::vector<std::uint32_t> expected;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& p = pot.positions;
        if (p[a] != p[b] && p[b] != p[c] && p[a] != p[c]) expected.insert(expected.end(), {a, b, c});
    };
    for (std::uint32_t patch = 0; patch < 32; ++patch)
        for (std::uint32_t cell = 0; cell < 9; ++cell) {
            const std::uint32_t corner = 16 * patch + 4 * (cell / 3) + cell % 3;
            add(corner, corner + 1, corner + 5);
            add(corner, corner + 5, corner + 4);
        }
    CHECK(pot.indices == expected);
    CHECK(expected.size() == std::size_t(3 * (2 * 9 * 32 - 8 * n)));
}

TEST_CASE("the ground is a square of side 7.2 centred under the pot that faces upwards") {
    const Scene scene = make_teapot({}, 1);
    const Mesh& ground = scene.list.meshes.at(1);
    CHECK(ground.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
    CHECK(ground.normals == std::vector<strata::pipeline::Vec3>(4, {0, 1, 0}));
    double area = 0, x = 0, z = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto &a = ground.positions.at(k), &b = ground.positions.at((k + 1) % 4);
        CHECK(a[1] == -0.01f);
        area += (double{a[2]} * double{b[0]} - double{a[0]} * double{b[2]}) / 2;  // counterclockwise seen from above
        x += double{a[0]} / 4;
        z += double{a[2]} / 4;
    }
    CHECK(area == Approx(7.2 * 7.2));
    CHECK(x == Approx(0.2).margin(1e-6));
    CHECK(z == Approx(0).margin(1e-6));
    CHECK(scene.list.instances ==
          std::vector<strata::pipeline::Instance>{{.mesh = 0, .material = 0}, {.mesh = 1, .material = 1}});
}
