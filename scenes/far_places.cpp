#include "scenes/far_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/vector_arithmetic.h"
#include "scenes/bounds.h"

namespace strata::scenes {
namespace {

using pipeline::Matrix;

// Of the finite positions of a mesh, in its own space.
Bounds bounds_of_mesh(const pipeline::Mesh& mesh) {
    Bounds bounds;
    for (const pipeline::Vec3& p : mesh.positions) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
        const Vec3d at{double{p.x}, double{p.y}, double{p.z}};
        const bool is_first = bounds.is_empty();
        for (std::size_t i = 0; i < 3; ++i) {
            bounds.lo[i] = is_first ? at[i] : std::min(bounds.lo[i], at[i]);
            bounds.hi[i] = is_first ? at[i] : std::max(bounds.hi[i], at[i]);
        }
    }
    return bounds;
}

Vec3d middle(const Bounds& bounds) { return times(plus(bounds.lo, bounds.hi), 0.5); }

Vec3d column(const Matrix& m, std::size_t c) { return {m[c].x, m[c].y, m[c].z}; }
void set_origin(Matrix& m, const Vec3d& at) { m[3] = {at.x, at.y, at.z, 1}; }

// The product of the matrix and a move by `at`.
void move_before(Matrix& m, const Vec3d& at) {
    set_origin(m, plus(plus(plus(times(column(m, 0), at.x), times(column(m, 1), at.y)), times(column(m, 2), at.z)),
                       column(m, 3)));
}

double largest(const Vec3d& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

// Moves the mesh by -at and every instance of it by at.
void move_into_instances(Scene& scene, std::size_t mesh, const Vec3d& at) {
    for (pipeline::Vec3& p : scene.list.meshes[mesh].positions)
        p = {static_cast<float>(double{p.x} - at[0]), static_cast<float>(double{p.y} - at[1]),
             static_cast<float>(double{p.z} - at[2])};
    for (pipeline::Instance& instance : scene.list.instances)
        if (instance.mesh == mesh) move_before(instance.model, at);
}

}  // namespace

double step_at(double magnitude) noexcept {
    const auto there = static_cast<float>(magnitude);
    return double{std::nextafter(there, std::numeric_limits<float>::infinity())} - double{there};
}

void warn_of_far_places(Scene& scene) {
    const FloatEnvironment environment;
    std::size_t count = 0;
    std::string first;
    for (const pipeline::Mesh& mesh : scene.list.meshes) {
        const Bounds bounds = bounds_of_mesh(mesh);
        if (bounds.is_empty() || !mesh.w.empty()) continue;
        const double place = std::max(largest(bounds.lo), largest(bounds.hi)), step = step_at(place);
        const double size = largest(minus(bounds.hi, bounds.lo));
        if (size == 0 || step * 1000 <= size || ++count > 1) continue;
        first = fmt::format(
            "mesh '{}' of size {:.3g} lies at {:.8g}, where binary32 numbers are {:.3g} apart, so that its vertices "
            "are "
            "not where they were modelled: its place belongs into the transform of its node",
            mesh.name, size, place, step);
    }
    if (count > 0) scene.warnings.push_back(first + (count > 1 ? fmt::format(" (and {} more meshes)", count - 1) : ""));
}

void recentre(Scene& scene) {
    const FloatEnvironment environment;
    if (scene.bounds.is_empty()) return;
    for (std::size_t i = 0; i < scene.list.meshes.size(); ++i) {
        const Bounds bounds = bounds_of_mesh(scene.list.meshes[i]);
        if (bounds.is_empty() || !scene.list.meshes[i].w.empty()) continue;
        // The corner of the bounds has coordinates of vertices: near it differences are exact.
        if (largest(middle(bounds)) > largest(minus(bounds.hi, bounds.lo))) move_into_instances(scene, i, bounds.lo);
    }
    const Vec3d origin = middle(scene.bounds);
    for (pipeline::Instance& instance : scene.list.instances)
        set_origin(instance.model, minus(column(instance.model, 3), origin));
    for (SceneCamera& camera : scene.cameras) move_before(camera.view, origin);
    if (scene.own_view) move_before(scene.own_view->view, origin);
    for (pipeline::Light& light : scene.list.lights)
        for (std::size_t i = 0; i < 3; ++i)
            light.position[i] = static_cast<float>(double{light.position[i]} - origin[i]);
    if (scene.list.light) move_before(scene.list.light->view, origin);
    scene.moved_by = minus({0, 0, 0}, origin);
    scene.bounds = bounds_of(scene.list);
}

}  // namespace strata::scenes
