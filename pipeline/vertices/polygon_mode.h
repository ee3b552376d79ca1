// pipeline/vertices/polygon_mode.h - draws the triangles of a list as their sides or corners (glPolygonMode).
//
// Rule     A triangle (a, b, c) is drawn filled, or as the lines b-c, c-a, a-b, or as the points a, b, c. Every side of
//          every triangle is drawn, so a side that two triangles share is drawn twice. Lines and points of a triangle
//          have its facing and are culled with it. Meshes of lines and points stay as they are.
// Source   rasterizer/reference/lines-and-points.md 1
// Tests    tests/pipeline/vertices/polygon_mode_test.cpp
#pragma once
#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {

enum class PolygonMode : std::uint8_t { fill, line, point };

[[nodiscard]] DrawList with_polygon_mode(DrawList list, PolygonMode mode);

}  // namespace strata::pipeline
