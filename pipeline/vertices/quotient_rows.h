// pipeline/vertices/quotient_rows.h - r and q of every vertex: the texture coordinates whose quotient is a fragment's
// depth.
//
// Rule     As Listing 2 sets up its texture matrices: T(0, 0, n0) S(0, 0, s0) P with s0 = (f - n)/2, n0 = (f + n)/2 of
//          the depth range (if clip-space z starts at 0: f - n and n), times (view * model), all in binary64; row r is
//          then scaled to the units of vertex z (2^n - 1 in buffer units), q is the last row. Each vertex is
//          transformed by its view's vertex path.
// Source   Everitt 2001, Listing 2; peeling/reference/algorithms.md 3.2; pipeline/reference/vertices.md 3: rows include
//          the factor 2^n - 1.
// Tests    tests/pipeline/vertices/vertex_transform_test.cpp
#pragma once
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/vertex_transform.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// Object space to texture coordinates by eye-linear planes that are the identity: texture * (view * model).
[[nodiscard]] Matrix texture_transform(const Matrix& texture, const Matrix& view, const Matrix& model);

// T S P of the rule: eye space to (0, 0, r, q), r / q in [n, f].
[[nodiscard]] Matrix depth_texture_matrix(const Matrix& projection, const rasterizer::RasterState& state);

// Object space to (0, 0, r, q), r in the units of vertex z.
[[nodiscard]] VertexTransform quotient_rows(const View& view, const Matrix& model, const rasterizer::RasterState& state,
                                            const rasterizer::RasterRules& rules);

}  // namespace strata::pipeline
