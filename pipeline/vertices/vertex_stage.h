// pipeline/vertices/vertex_stage.h - transforms a mesh's vertices to clip space and lights them.
//
// Rule     As in prepare.h. World normal = cofactors of the upper 3x3 times the normal; |N| = sqrt((x x + y y) + z z);
//          if it is not above 0, the factor is 0.25. Colour: (material * vertex colour) * factor; alpha: (material *
//          vertex) * scale of the draw. With the lights of a scene, rgb of a lit vertex are vertex_light.h's. All in
//          binary32, sums from left to right, every operation rounded; kernels process eight or sixteen vertices at a
//          time with the same bits.
// Tests    tests/pipeline/vertices/prepare_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/vertex_light.h"
#include "pipeline/vertices/vertex_transform.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// One mesh with one material under one view. It stores references: mesh and material must outlive it.
class VertexStage {
  public:
    // Without lights (null) lit vertices have the light at the eye.
    VertexStage(const Mesh& mesh, const Material& material, const View& view, const Matrix& model, float alpha_scale,
                std::shared_ptr<const FrameLights> lights);

    // Vertices [begin, begin + out.size()) of the mesh.
    void run(std::size_t begin, std::span<rasterizer::ClipVertex> out) const;
    // The colours by the lights of a scene: black without them.
    [[nodiscard]] LitVertex lit(std::size_t i) const;

  private:
    // 0.25 to 1 (except for rounding): the factor of a vertex's colours from its normal in object space.
    [[nodiscard]] float light_of(const Vec3& normal) const;
    [[nodiscard]] Rgba color(const Rgba& material, std::size_t i) const;
    [[nodiscard]] rasterizer::ClipVertex vertex(std::size_t i, const std::array<float, 4>& position, float light) const;

    const Mesh& mesh_;
    const Material& material_;
    VertexTransform clip_;
    std::array<float, 9> normal_;
    Vec3 light_;
    std::shared_ptr<const VertexLight> lights_{};
    float alpha_scale_;
    bool is_lit_;
};

}  // namespace strata::pipeline
