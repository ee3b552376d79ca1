// scenes/flat_normals.cpp - one vertex per corner, and the normal of each triangle (flat_normals.h).
#include "scenes/flat_normals.h"

#include <cmath>
#include <numeric>

#include "rasterizer/base/vector_arithmetic.h"

namespace strata::scenes {

namespace {

// In binary64, because the sides of small triangles far from the origin would cancel in binary32. A triangle whose
// product is not finite or of length 0 has no direction, and any unit vector will do.
Vec3 flat_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3d origin{a};
    const Vec3d n = cross_product(minus(Vec3d{b}, origin), minus(Vec3d{c}, origin));
    const double length = std::sqrt(dot_product(n, n));
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 1};
    return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length), static_cast<float>(n[2] / length)};
}

// Expands values per vertex to values per corner.
template <class Value>
void unshare(std::vector<Value>& values, const std::vector<std::uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<Value> corners;
    corners.reserve(indices.size());
    for (const std::uint32_t index : indices) corners.push_back(values[index]);
    values = std::move(corners);
}

}  // namespace

std::vector<Vec3> flat_normals(const std::vector<Vec3>& positions) {
    std::vector<Vec3> normals;
    normals.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); i += 3)
        normals.insert(normals.end(), 3, flat_normal(positions[i], positions[i + 1], positions[i + 2]));
    return normals;
}

void make_flat(pipeline::Mesh& mesh) {
    unshare(mesh.positions, mesh.indices);
    unshare(mesh.colors, mesh.indices);
    unshare(mesh.texcoords, mesh.indices);
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    mesh.normals = flat_normals(mesh.positions);
}

}  // namespace strata::scenes
