// rasterizer/values/float_values.cpp - depth and attributes of a batch by the binary32 planes of float_planes.h.
// Tests: tests/rasterizer/values/float_planes_test.cpp
#include "rasterizer/set_up/stepped_offset.h"
#include "rasterizer/values/float_planes.h"
#include "rasterizer/values/fragment_values.h"

namespace strata::rasterizer {
// The plane's values at fragments [first, batch.count).
void FragmentValues::fill_plane(const FloatPlane& plane, int first, const FragmentBatch& batch,
                                float* out) const noexcept {
    const auto f = static_cast<std::size_t>(first);
    kernels_.float_plane(rules_.plane_rule, plane, &batch.x[f], &batch.y[f], batch.count - first, out);
}

void FragmentValues::fill_float_z(const SetupTriangle& t, const DrawnTriangle& triangle, int first,
                                  FragmentBatch& batch) const noexcept {
    const bool adds_offset = offsets_planes(triangle.geometry.state, rules_);
    const auto units = static_cast<float>(z_units_);
    std::array<float, 3> z;
    for (std::size_t i = 0; i < 3; ++i) z[i] = static_cast<float>(adds_offset ? t.given_z[i] : t.z[i]) / units;
    const FloatPlanes planes = float_planes(triangle.geometry, triangle.record);
    float* const out = &batch.shader_z[static_cast<std::size_t>(first)];
    fill_plane(planes.plane(z), first, batch, out);
    if (!adds_offset) return;
    const auto& corners = triangle.geometry.corners;
    const auto& [a, b, c] = triangle.record.vertex;
    const float offset =
        stepped_offset({&corners[a], &corners[b], &corners[c]}, triangle.geometry.state, rules_) / units;
    for (int i = 0; i < batch.count - first; ++i) out[i] = out[i] + offset;
}

void FragmentValues::fill_float_attributes(const DrawnTriangle& triangle, int first,
                                           FragmentBatch& batch) const noexcept {
    const Geometry& geometry = triangle.geometry;
    const FloatPlanes planes = float_planes(geometry, triangle.record);
    std::array<const ClipVertex*, 3> v;
    std::array<float, 3> w;
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = &geometry.vertices[triangle.record.vertex[i]];
        w[i] = geometry.corners[triangle.record.vertex[i]].inverse_w;
    }
    const int count = batch.count - first;
    const bool multiplies = rules_.perspective == PerspectiveDivide::reciprocal;
    alignas(64) Lanes<float> divisor;
    fill_plane(planes.plane(w), first, batch, divisor.data());
    for (std::size_t i = 0; multiplies && i < static_cast<std::size_t>(count); ++i) divisor[i] = 1.0f / divisor[i];
    const std::size_t begin = needs_.color ? 0 : color_channels;
    const std::size_t end = needs_.texcoord ? attribute_count : color_channels;
    for (std::size_t a = begin; a < end; ++a) {
        std::array<float, 3> over_w;
        for (std::size_t i = 0; i < 3; ++i) {
            const float value = a >= color_channels            ? v[i]->texcoord[a - color_channels]
                                : triangle.record.front_facing ? v[i]->front[a]
                                                               : v[i]->back[a];
            over_w[i] = value * w[i];
        }
        auto& lanes = a < color_channels ? batch.color[a] : batch.texcoord[a - color_channels];
        float* const out = &lanes[static_cast<std::size_t>(first)];
        fill_plane(planes.plane(over_w), first, batch, out);
        for (int i = 0; i < count; ++i) {
            const float d = divisor[static_cast<std::size_t>(i)];
            out[i] = multiplies ? out[i] * d : out[i] / d;
        }
    }
}

}  // namespace strata::rasterizer
