// peeling/truth/real_geometry.h - a draw list's triangles at unsnapped positions in binary64, clipped, with their
// facing.
//
// Rule     Vertices are the vertex stage's output (binary32), or the same positions times matrices in binary64; colours
//          and coordinates are the vertex stage's output. Planes w >= 2^-64, near and far; window = half size times (x
//          / w) plus the centre; facing and culling by the sign of the unsnapped area.
// Tests    tests/peeling/truth/truth_test.cpp
#pragma once
#include <vector>

#include "peeling/truth/real_triangle.h"
#include "pipeline/vertices/prepare.h"

namespace strata::peeling {

enum class RealPositions : std::uint8_t { vertex_stage, binary64 };

// In submission order. Triangles without area are left out.
[[nodiscard]] std::vector<RealTriangle> real_triangles(const pipeline::DrawList& list, const pipeline::View& view,
                                                       const rasterizer::RasterState& state,
                                                       const pipeline::PrepareOptions& options,
                                                       RealPositions positions);

// The triangle that set-up has snapped to the device's grid.
[[nodiscard]] RealTriangle real_triangle(const rasterizer::Geometry& geometry, std::size_t triangle);

}  // namespace strata::peeling
