// pipeline/vertices/other_splits.cpp - rotates corners, flips diagonals and moves windows (other_splits.h).
#include "pipeline/vertices/other_splits.h"

#include <algorithm>
#include <array>
#include <optional>

#include "rasterizer/base/vector_arithmetic.h"

namespace strata::pipeline {
namespace {

[[nodiscard]] Vec3d between(const Vec3& from, const Vec3& to) { return minus(Vec3d{to}, Vec3d{from}); }

// Corners a, b, c, d in order along the boundary; the triangles are (a, b, c) and (c, d, a).
using Quad = std::array<std::uint32_t, 4>;

// The quad of two triangles, if the second has a side of the first in the opposite direction.
[[nodiscard]] std::optional<Quad> quad_of(const std::uint32_t* first, const std::uint32_t* second) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = first[i], to = first[(i + 1) % 3];
            if (second[k] == to && second[(k + 1) % 3] == from)
                return Quad{to, first[(i + 2) % 3], from, second[(k + 2) % 3]};
        }
    return std::nullopt;
}

// True if both pairs of triangles face the same way, and d is in the plane of a, b, c.
[[nodiscard]] bool is_flat_and_convex(const Quad& quad, const Mesh& mesh) {
    const auto side = [&](std::size_t i, std::size_t k) {
        return between(mesh.positions[quad[i]], mesh.positions[quad[k]]);
    };
    const Vec3d normal = cross_product(side(0, 1), side(0, 2));
    double longest = 0.0;  // squared
    for (std::size_t i = 0; i < 4; ++i)
        longest = std::max(longest, dot_product(side(i, (i + 1) % 4), side(i, (i + 1) % 4)));
    // The distance of d from the plane times |normal|: squares are compared, so no root is needed.
    const double off = dot_product(normal, side(0, 3));  // times |normal|
    if (off * off > 0x1p-40 * longest * dot_product(normal, normal)) return false;
    for (std::size_t i = 0; i < 4; ++i)
        if (!(dot_product(normal, cross_product(side(i, (i + 1) % 4), side((i + 1) % 4, (i + 2) % 4))) > 0.0))
            return false;
    return true;
}

[[nodiscard]] std::uint64_t flip(Mesh& mesh) {
    std::uint64_t flipped = 0;
    for (std::size_t at = 0; at + 6 <= mesh.indices.size();) {
        std::uint32_t* const index = &mesh.indices[at];
        const auto quad = quad_of(index, index + 3);
        if (!quad || !is_flat_and_convex(*quad, mesh)) {
            at += 3;
            continue;
        }
        const auto& [a, b, c, d] = *quad;
        const std::array other{b, c, d, d, a, b};
        std::copy(other.begin(), other.end(), index);
        ++flipped;
        at += 6;
    }
    return flipped;
}

void move(rasterizer::Rect& rect, int x, int y) { rect = {rect.x0 + x, rect.y0 + y, rect.x1 + x, rect.y1 + y}; }

}  // namespace

DrawList rotate_vertices(DrawList list, int k) {
    for (Mesh& mesh : list.meshes) {
        if (mesh.primitive != Primitive::triangles) continue;
        for (std::size_t at = 0; at + 3 <= mesh.indices.size(); at += 3) {
            const auto first = mesh.indices.begin() + static_cast<std::ptrdiff_t>(at);
            std::rotate(first, first + ((k % 3) + 3) % 3, first + 3);
        }
    }
    return list;
}

Flipped flip_diagonals(DrawList list) {
    Flipped result{std::move(list), 0};
    for (Mesh& mesh : result.list.meshes)
        // Whether homogeneous corners are in a plane is not tested.
        if (mesh.w.empty() && mesh.primitive == Primitive::triangles) result.quads += flip(mesh);
    return result;
}

void move_window(rasterizer::Geometry& geometry, int x_px, int y_px) {
    move(geometry.state.viewport, x_px, y_px);
    if (geometry.state.scissor) move(*geometry.state.scissor, x_px, y_px);
    const int unit = 1 << geometry.rules.subpixel_bits;
    for (rasterizer::WindowCorner& corner : geometry.corners) {
        corner.p.x += x_px * unit;
        corner.p.y += y_px * unit;
        corner.unsnapped[0] += static_cast<float>(x_px);
        corner.unsnapped[1] += static_cast<float>(y_px);
    }
}

}  // namespace strata::pipeline
