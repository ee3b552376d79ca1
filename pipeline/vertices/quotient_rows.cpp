// pipeline/vertices/quotient_rows.cpp - the matrices of quotient_rows.h.
#include "pipeline/vertices/quotient_rows.h"

#include "pipeline/vertices/matrix.h"
#include "rasterizer/set_up/window.h"

namespace strata::pipeline {
namespace {

// Row r of a column-major matrix times a factor.
[[nodiscard]] Matrix with_scaled_row(Matrix m, std::size_t r, double factor) {
    for (std::size_t c = 0; c < 4; ++c) m[c][r] *= factor;
    return m;
}

}  // namespace

Matrix texture_transform(const Matrix& texture, const Matrix& view, const Matrix& model) {
    return product(texture, product(view, model));
}

Matrix depth_texture_matrix(const Matrix& projection, const rasterizer::RasterState& state) {
    const double n = state.depth_near, f = state.depth_far;
    const bool symmetric = state.clip_depth == rasterizer::ClipDepth::minus_one_to_one;
    const double s0 = symmetric ? (f - n) * 0.5 : f - n, n0 = symmetric ? (f + n) * 0.5 : n;
    // By columns. The scale has 0 in x and y: s and t become 0, and only r and q remain.
    const Matrix translate{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, n0, 1};
    const Matrix scale{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, s0, 0, 0, 0, 0, 1};
    return product(product(translate, scale), projection);
}

VertexTransform quotient_rows(const View& view, const Matrix& model, const rasterizer::RasterState& state,
                              const rasterizer::RasterRules& rules) {
    const double units = rasterizer::z_units(state, rules);
    const Matrix texture = depth_texture_matrix(view.projection, state);
    return {view.vertex_path, with_scaled_row(texture_transform(texture, view.view, model), 2, units),
            with_scaled_row(texture, 2, units), product(view.view, model)};
}

}  // namespace strata::pipeline
