// pipeline/vertices/vertex_stage.cpp - transforms and lights the vertices of a mesh, by kernels of vertex_lanes.h where
// they apply (vertex_stage.h).
#include "pipeline/vertices/vertex_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/vertices/matrix.h"
#include "pipeline/vertices/vertex_lanes.h"

namespace strata::pipeline {
namespace {

// The transform of normals; for mirrored models its sign does not affect |N.L|.
std::array<float, 9> normal_matrix(const Matrix& m) {
    std::array<float, 9> n{};
    std::ranges::transform(cofactors_of(m), n.begin(), [](double c) { return static_cast<float>(c); });
    return n;
}

// The unit vector from the view's centre to the eye: the view's third row.
Vec3 light_direction(const Matrix& view) {
    const double x = view[0][2], y = view[1][2], z = view[2][2];
    const double length = std::sqrt((x * x + y * y) + z * z);
    if (!(length > 0)) return {0, 0, 1};
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

}  // namespace

VertexStage::VertexStage(const Mesh& mesh, const Material& material, const View& view, const Matrix& model,
                         float alpha_scale, std::shared_ptr<const FrameLights> lights)
    : mesh_{mesh},
      material_{material},
      clip_{view.vertex_path, product(product(view.projection, view.view), model), view.projection,
            product(view.view, model)},
      normal_{normal_matrix(model)},
      light_{light_direction(view.view)},
      alpha_scale_{alpha_scale},
      is_lit_{!material.unlit && !mesh.normals.empty()} {
    if (lights != nullptr && is_lit_) lights_ = std::make_shared<VertexLight>(std::move(lights), view, model);
}

Rgba VertexStage::color(const Rgba& material, std::size_t i) const {
    const Rgba own = mesh_.colors.empty() ? Rgba{1, 1, 1, 1} : mesh_.colors[i];
    return {material.r * own.r, material.g * own.g, material.b * own.b, material.a * own.a};
}

LitVertex VertexStage::lit(std::size_t i) const {
    if (!lights_) return {};
    return (*lights_)(mesh_.positions[i], mesh_.w.empty() ? 1.0f : mesh_.w[i], mesh_.normals[i],
                      color(material_.front, i), color(material_.back, i));
}

float VertexStage::light_of(const Vec3& n) const {
    float world[3];
    for (std::size_t r = 0; r < 3; ++r) world[r] = (normal_[r] * n[0] + normal_[3 + r] * n[1]) + normal_[6 + r] * n[2];
    const float squared = (world[0] * world[0] + world[1] * world[1]) + world[2] * world[2];
    const float length = std::sqrt(squared);
    if (!(length > 0.0f)) return 0.25f;
    const float dot = (world[0] * light_[0] + world[1] * light_[1]) + world[2] * light_[2];
    return 0.25f + 0.75f * std::fabs(dot / length);
}

rasterizer::ClipVertex VertexStage::vertex(std::size_t i, const std::array<float, 4>& p, float light) const {
    rasterizer::ClipVertex v{.x = p[0], .y = p[1], .z = p[2], .w = p[3]};
    const Rgba color = mesh_.colors.empty() ? Rgba{1, 1, 1, 1} : mesh_.colors[i];
    for (std::size_t c = 0; c < 3; ++c) {
        v.front[c] = (material_.front[c] * color[c]) * light;
        v.back[c] = (material_.back[c] * color[c]) * light;
    }
    if (lights_) {
        const LitVertex lit = this->lit(i);
        std::ranges::copy(lit.front.primary, v.front.begin());
        std::ranges::copy(lit.back.primary, v.back.begin());
    }
    v.front[3] = (material_.front[3] * color[3]) * alpha_scale_;
    v.back[3] = (material_.back[3] * color[3]) * alpha_scale_;
    if (!mesh_.texcoords.empty()) v.texcoord = {mesh_.texcoords[i].x, mesh_.texcoords[i].y};
    return v;
}

void VertexStage::run(std::size_t begin, std::span<rasterizer::ClipVertex> out) const {
    // The kernels implement only VertexPath::separate and w = 1; everything else, and the remainder of a block, is
    // processed vertex by vertex.
    const bool is_affine = mesh_.w.empty();
    const VertexKernels* const kernels = is_affine && clip_.separate_matrix() != nullptr ? vertex_kernels() : nullptr;
    std::size_t done = 0;
    for (; kernels != nullptr && done + vertex_lane_count <= out.size(); done += vertex_lane_count) {
        VertexLanes block;
        const std::size_t first = begin + done;
        kernels->transform(*clip_.separate_matrix(), &mesh_.positions[first], block);
        if (is_lit_ && !lights_)
            kernels->light(normal_, light_, &mesh_.normals[first], block);
        else
            block.light.fill(1.0f);
        const auto& [x, y, z, w] = block.position;
        for (std::size_t k = 0; k < vertex_lane_count; ++k)
            out[done + k] = vertex(first + k, {x[k], y[k], z[k], w[k]}, block.light[k]);
    }
    for (; done < out.size(); ++done) {
        const std::size_t i = begin + done;
        const auto position = is_affine ? clip_(mesh_.positions[i]) : clip_(mesh_.positions[i], mesh_.w[i]);
        out[done] = vertex(i, position, is_lit_ && !lights_ ? light_of(mesh_.normals[i]) : 1.0f);
    }
}

}  // namespace strata::pipeline
