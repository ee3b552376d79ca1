// pipeline/vertices/vertex_stage.h - transforms a mesh's vertices to clip space and lights them.
//
// Rule     As in prepare.h. World normal = cofactors of the upper 3x3 times the normal; |N| = sqrt((x x + y y) + z z);
//          if it is not above 0, the factor is 0.25. Colour: (material * vertex colour) * factor; alpha: (material *
//          vertex) * scale of the draw. All in binary32, sums from left to right, every operation rounded; kernels
//          process eight or sixteen vertices at a time with the same bits.
// Tests    tests/pipeline/vertices/prepare_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/vertex_transform.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// One mesh with one material under one view. It stores references: mesh and material must outlive it.
class VertexStage {
  public:
    VertexStage(const Mesh& mesh, const Material& material, const View& view, const Matrix& model, float alpha_scale);

    // Vertices [begin, begin + out.size()) of the mesh.
    void run(std::size_t begin, std::span<rasterizer::ClipVertex> out) const;

  private:
    // 0.25 to 1 (except for rounding): the factor of a vertex's colours from its normal in object space.
    [[nodiscard]] float light_of(const Vec3& normal) const;
    [[nodiscard]] rasterizer::ClipVertex vertex(std::size_t i, const std::array<float, 4>& position, float light) const;

    const Mesh& mesh_;
    const Material& material_;
    VertexTransform clip_;
    std::array<float, 9> normal_;
    Vec3 light_;
    float alpha_scale_;
    bool is_lit_;
};

}  // namespace strata::pipeline
