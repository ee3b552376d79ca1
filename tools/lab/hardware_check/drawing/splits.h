// tools/lab/hardware_check/drawing/splits.h - the triangles and lines into which the chip splits its primitives.
//
// Rule     QUADS are (0,1,2) (0,2,3), quad strips (q,q+1,q+2) (q+2,q+1,q+3), fans and polygons (0,k,k+1); odd triangles
//          of a strip exchange their first two vertices. In line mode each triangle (a,b,c) draws b-c, c-a, a-b; sides
//          inside of a quad, quad strip or polygon are not drawn, those inside of a fan are.
// Source   rasterizer/reference/chip-geometry.md 2.1, lines-and-points.md 1.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/vertices/polygon_mode.h"
#include "tools/lab/hardware_check/drawing/shapes.h"

namespace strata::hardware_check {

enum class Topology : std::uint8_t {
    points,
    lines,
    line_loop,
    line_strip,
    triangles,
    triangle_strip,
    triangle_fan,
    quads,
    quad_strip,
    polygon
};

using Triple = std::array<std::uint32_t, 3>;

struct OutlinedTriangle {
    Triple corner;
    unsigned inner = 0;  // bit i: the side opposite corner i is not drawn in line mode
};

// Of `count` vertices; empty for points and lines.
[[nodiscard]] std::vector<OutlinedTriangle> split(Topology topology, std::uint32_t count);

using pipeline::PolygonMode;

// A soup of all vertices and the draw's primitives, and their kind.
struct SplitDraw {
    TriangleSoup soup;
    rasterizer::Primitive primitive;
};
[[nodiscard]] SplitDraw split_draw(const std::vector<OutlinedTriangle>& triangles,
                                   const std::vector<ClipVertex>& vertices, PolygonMode mode);
[[nodiscard]] SplitDraw split_draw(Topology topology, const std::vector<ClipVertex>& vertices, PolygonMode mode);

}  // namespace strata::hardware_check
