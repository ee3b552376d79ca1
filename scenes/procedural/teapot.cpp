// scenes/procedural/teapot.cpp - tessellates Bezier patches into triangles with normals that point outwards.
#include "scenes/procedural/teapot.h"

#include <cmath>

#include "rasterizer/base/vector_arithmetic.h"
#include "scenes/bounds.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/procedural/teapot_patches.h"

namespace strata::scenes {
namespace {

// The four weights of a cubic at one parameter.
using Basis = std::array<double, 4>;

// The cubic Bernstein polynomials at t = i / n. t and 1 - t are both quotients, so evaluating an edge from its other
// end gives the same bits: neighbouring patches join without cracks.
Basis bernstein(int i, int n) noexcept {
    const double t = static_cast<double>(i) / n, s = static_cast<double>(n - i) / n;
    return {s * s * s, 3 * (s * s) * t, 3 * (t * t) * s, t * t * t};
}

Basis bernstein_derivative(int i, int n) noexcept {
    const double t = static_cast<double>(i) / n, s = static_cast<double>(n - i) / n;
    return {-3 * (s * s), 3 * (s * s) - 6 * (s * t), 6 * (s * t) - 3 * (t * t), 3 * (t * t)};
}

// Sums from both ends inwards: symmetric under reversal like the basis.
double weighted_sum(const Basis& w, double a, double b, double c, double d) noexcept {
    return (w[0] * a + w[3] * d) + (w[1] * b + w[2] * c);
}

// The point of a bicubic patch: rows over v first, then the rows' results over u. With the derivative's basis for u or
// v it is that partial derivative.
Vec3d evaluate(const std::uint16_t (&patch)[16], const Basis& u, const Basis& v) noexcept {
    Vec3d result;
    for (int axis = 0; axis < 3; ++axis) {
        double row[4];
        for (std::size_t r = 0; r < 4; ++r) {
            row[r] = weighted_sum(v, teapot_points[patch[4 * r]][axis], teapot_points[patch[4 * r + 1]][axis],
                                  teapot_points[patch[4 * r + 2]][axis], teapot_points[patch[4 * r + 3]][axis]);
        }
        result[axis] = weighted_sum(u, row[0], row[1], row[2], row[3]);
    }
    return result;
}

// The table has z up. A rotation about x by -90 degrees, without arithmetic that could round, and the single rounding
// to binary32.
pipeline::Vec3 y_up(const Vec3d& p) noexcept {
    return {static_cast<float>(p[0]), static_cast<float>(p[2]), static_cast<float>(-p[1])};
}

// d/dv x d/du points outwards on every patch. Where a patch's first row is one point, d/dv is 0 there and its limit has
// the direction of the mixed derivative.
Vec3d outward_normal(const std::uint16_t (&patch)[16], int i, int j, int n) noexcept {
    const Basis u = bernstein(i, n), v = bernstein(j, n);
    const Basis du = bernstein_derivative(i, n), dv = bernstein_derivative(j, n);
    const Vec3d a = evaluate(patch, du, v);
    Vec3d b = evaluate(patch, u, dv);
    // The table's coordinates are of magnitude 1: a nonzero derivative is far above this bound, and one that should be
    // 0 is rounding noise below it.
    if (dot_product(b, b) < 1e-20) b = evaluate(patch, du, dv);
    const Vec3d c = cross_product(b, a);
    return divided(c, std::sqrt(dot_product(c, c)));
}

// Omits triangles with two equal corners.
void add_triangle(pipeline::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh.positions;
    if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;  // at a collapsed row
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

// Each patch has its own vertices: neighbours share positions bit for bit along their edges, but not normals where the
// surface has a crease.
void add_patch(pipeline::Mesh& mesh, const std::uint16_t (&patch)[16], int n) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            mesh.positions.push_back(y_up(evaluate(patch, bernstein(i, n), bernstein(j, n))));
            mesh.normals.push_back(y_up(outward_normal(patch, i, j, n)));
        }
    }
    const auto row = static_cast<std::uint32_t>(n) + 1;
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
        for (std::uint32_t j = 0; j + 1 < row; ++j) {
            const std::uint32_t a = first + i * row + j, b = a + 1, c = a + row, d = c + 1;
            add_triangle(mesh, a, b, d);
            add_triangle(mesh, a, d, c);
        }
    }
}

// A square slightly below the pot's bottom, which would otherwise have depth ties with it; the pot's middle is at x =
// 0.2.
pipeline::Mesh ground_plane() {
    constexpr float half = 3.6f, x = 0.2f, y = -0.01f;
    pipeline::Mesh mesh;
    mesh.name = "ground";
    mesh.positions = {{x - half, y, half}, {x + half, y, half}, {x + half, y, -half}, {x - half, y, -half}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// `front` and `back` are encoded colours, not premultiplied.
pipeline::Material material(const char* name, pipeline::Rgba front, pipeline::Rgba back, const SceneOptions& options) {
    return {.name = name,
            .front = from_encoded(front, options.color_space),
            .back = from_encoded(back, options.color_space),
            .alpha_mode = pipeline::AlphaMode::blend,
            .double_sided = true,
            .unlit = !options.light};
}

}  // namespace

Scene make_teapot(const SceneOptions& options, int tessellation) {
    Scene scene;
    scene.name = "teapot";
    pipeline::Mesh pot;
    pot.name = "teapot";
    for (const auto& patch : teapot_patches) add_patch(pot, patch, tessellation);
    scene.list.meshes = {std::move(pot), ground_plane()};
    scene.list.materials = {
        material("teapot", {0.9f, 0.1f, 0.1f, 0.5f}, {0.1f, 0.8f, 0.1f, 0.5f}, options),
        material("ground", {0.15f, 0.25f, 0.9f, 0.5f}, {0.15f, 0.25f, 0.9f, 0.5f}, options),
    };
    scene.list.instances = {{.mesh = 0, .material = 0}, {.mesh = 1, .material = 1}};
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
