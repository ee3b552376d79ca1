#include "scenes/bounds.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/base/numerics.h"

namespace strata::scenes {
namespace {

Vec3d transformed(const pipeline::Matrix& m, const pipeline::Vec3& p) noexcept {
    Vec3d world;
    for (std::size_t r = 0; r < 3; ++r)
        world[r] = ((m[0][r] * double{p.x} + m[1][r] * double{p.y}) + m[2][r] * double{p.z}) + m[3][r];
    return world;
}

void include(Bounds& bounds, const Vec3d& point) noexcept {
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2])) return;
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
        for (const std::uint32_t index : mesh.indices)
            include(bounds, transformed(instance.model, mesh.positions[index]));
    }
    return bounds;
}

}  // namespace strata::scenes
