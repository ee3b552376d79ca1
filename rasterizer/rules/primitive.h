// rasterizer/rules/primitive.h - the kinds of primitives of a draw, and the shapes that they are rasterized as.
#pragma once
#include <cstdint>

namespace strata::rasterizer {

// Every primitive has three indices. lines: the first end twice, then the second end. points: the vertex three times.
// polygon_lines and polygon_points draw a part of a triangle as a line or point: the side from the second to the third
// index, and the vertex of the third; the triangle decides facing and culling
// (rasterizer/reference/lines-and-points.md 1).
enum class Primitive : std::uint8_t { triangles, lines, points, polygon_lines, polygon_points };

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
        case Primitive::polygon_lines: return Shape::line;
        case Primitive::points:
        case Primitive::polygon_points: break;
    }
    return Shape::point;
}

}  // namespace strata::rasterizer
