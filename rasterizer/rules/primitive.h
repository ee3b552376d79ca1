// rasterizer/rules/primitive.h - the kinds of primitives of a draw, and the shapes that they are rasterized as.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace strata::rasterizer {

// Every primitive has three indices. lines: the first end twice, then the second end. points: the vertex three times.
// polygon_lines and polygon_points draw a part of a triangle as a line or point: the side from the second to the third
// index, and the vertex of the third; the triangle decides facing and culling
// (rasterizer/reference/lines-and-points.md 1). line_strips: lines, of which each that begins with the vertex at which
// the one before ended goes on with its stipple.
enum class Primitive : std::uint8_t { triangles, lines, points, polygon_lines, polygon_points, line_strips };

// True if a triangle decides facing and culling.
[[nodiscard]] constexpr bool is_of_polygon(Primitive primitive) noexcept {
    return primitive == Primitive::polygon_lines || primitive == Primitive::polygon_points;
}

// Of a list of primitives with 1, 2 or 3 corners.
[[nodiscard]] constexpr Primitive primitive_of(std::size_t corners) noexcept {
    return corners == 1 ? Primitive::points : corners == 2 ? Primitive::lines : Primitive::triangles;
}

// Appends the three indices of a point, line or triangle, which are given by its 1, 2 or 3 corners.
inline void append_primitive(std::vector<std::uint32_t>& indices, std::span<const std::uint32_t> corners) {
    indices.insert(indices.end(), 3 - corners.size(), corners.front());
    indices.insert(indices.end(), corners.begin(), corners.end());
}

// What a record covers. polygon: a triangle whose coverage is that of NV2A's smooth polygons.
enum class Shape : std::uint8_t { triangle, line, point, polygon };

// True if polygon offset and polygon stipple apply.
[[nodiscard]] constexpr bool is_polygon(Shape shape) noexcept {
    return shape == Shape::triangle || shape == Shape::polygon;
}

[[nodiscard]] constexpr Shape shape_of(Primitive primitive) noexcept {
    switch (primitive) {
        case Primitive::triangles: return Shape::triangle;
        case Primitive::lines:
        case Primitive::line_strips:
        case Primitive::polygon_lines: return Shape::line;
        case Primitive::points:
        case Primitive::polygon_points: break;
    }
    return Shape::point;
}

}  // namespace strata::rasterizer
