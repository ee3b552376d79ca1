// scenes/bounds.cpp - computes the bounding box vertex by vertex; which vertices count: bounds.h.
#include "scenes/bounds.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/base/numerics.h"

namespace strata::scenes {
namespace {

// The product of a matrix and a point (p, 1) in a fixed order of additions: the bounds determine the position of an
// orbit camera, so their bits affect the image. The bottom row is 0 0 0 1 and is not read.
Vec3d transformed(const pipeline::Matrix& m, const pipeline::Vec3& p) noexcept {
    Vec3d world;
    for (std::size_t r = 0; r < 3; ++r)
        world[r] = ((m[0][r] * double{p.x} + m[1][r] * double{p.y}) + m[2][r] * double{p.z}) + m[3][r];
    return world;
}

// Extends the box to contain the point. A point with a NaN or an infinity is ignored: it would make the box useless,
// and the rasterizer drops its triangles.
void include(Bounds& bounds, const Vec3d& point) noexcept {
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2])) return;
    // The first point replaces the empty box, in which lo > hi.
    if (bounds.is_empty()) bounds = {point, point};
    for (std::size_t i = 0; i < 3; ++i) {
        bounds.lo[i] = std::min(bounds.lo[i], point[i]);
        bounds.hi[i] = std::max(bounds.hi[i], point[i]);
    }
}

}  // namespace

Bounds bounds_of(const pipeline::DrawList& list) {
    Bounds bounds;
    for (const pipeline::Instance& instance : list.instances) {
        const pipeline::Mesh& mesh = list.meshes[instance.mesh];
        // Iterates over indices instead of positions: a vertex that no triangle uses is not drawn and must not move the
        // camera.
        for (const std::uint32_t index : mesh.indices) {
            const Vec3& p = mesh.positions[index];
            const double w = mesh.w.empty() ? 1.0 : double{mesh.w[index]};
            // A point with w <= 0 has no position in space.
            if (w > 0)
                include(bounds, transformed(instance.model, {static_cast<float>(p[0] / w), static_cast<float>(p[1] / w),
                                                             static_cast<float>(p[2] / w)}));
        }
    }
    return bounds;
}

}  // namespace strata::scenes
