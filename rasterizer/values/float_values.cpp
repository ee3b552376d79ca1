// rasterizer/values/float_values.cpp - depth and attributes of a batch by the binary32 planes of float_planes.h.
// Tests: tests/rasterizer/values/float_planes_test.cpp
#include <algorithm>
#include <array>
#include <bit>

#include "rasterizer/set_up/stepped_offset.h"
#include "rasterizer/values/float_planes.h"
#include "rasterizer/values/fragment_values.h"
#include "rasterizer/values/ordered_planes.h"

namespace strata::rasterizer {

namespace {

// True if a colour channel with these corner values has that value at every fragment.
[[nodiscard]] bool is_kept(const std::array<float, 3>& values, const RasterRules& rules) noexcept {
    const auto bits = [&](std::size_t i) { return std::bit_cast<std::uint32_t>(values[i]); };
    return rules.equal_colors == EqualColors::kept && bits(0) == bits(1) && bits(0) == bits(2);
}

}  // namespace

// fill_values may drop fragments, so attributes are filled after it.
int FragmentValues::fill_float_values(const DrawnTriangle& triangle, int first, FragmentBatch& batch,
                                      WeightLanes& weights) const {
    int fallbacks = 0;
    if (is_float_plain_) {
        if (needs_float_z_) fill_float_z(triangle, first, batch);
        if (needs_.code) fill_float_codes(first, batch);
    } else {
        fallbacks = fill_values(triangle.geometry.triangle(triangle.index), triangle, first, batch, weights);
    }
    if (needs_attributes_) fill_float_attributes(triangle, first, batch);
    return fallbacks;
}

// For PlaneRule::greatest_w, whose depths are always in the units of the depth range.
void FragmentValues::fill_ordered_z(const DrawnTriangle& triangle, int first, FragmentBatch& batch) const noexcept {
    const Geometry& geometry = triangle.geometry;
    const OrderedPlanes planes = ordered_planes(geometry, triangle.index);
    const FloatPlane plane = planes.depth();
    const auto f = static_cast<std::size_t>(first);
    const int count = batch.count - first;
    float* const out = &batch.shader_z[f];
    kernels_.float_plane(rules_.plane_rule, plane, &batch.x[f], &batch.y[f], count, out);
    if (!geometry.state.polygon_offset.enabled) return;
    const auto& [a, b, c] = triangle.record.vertex;
    const std::array z{geometry.corners[a].z, geometry.corners[b].z, geometry.corners[c].z};
    const float offset =
        planes.offset(plane, geometry.state.polygon_offset, ordered_offset_unit(planes, z, geometry.state, rules_));
    for (int i = 0; i < count; ++i) out[i] = (Flushed{out[i]} + Flushed{offset}).v;
}

void FragmentValues::fill_float_z(const DrawnTriangle& triangle, int first, FragmentBatch& batch) const noexcept {
    if (rules_.plane_rule == PlaneRule::greatest_w) return fill_ordered_z(triangle, first, batch);
    const FloatPlanes planes = float_planes(triangle.geometry, triangle.record);
    const Geometry& geometry = triangle.geometry;
    const auto& [a, b, c] = triangle.record.vertex;
    const std::array corner{&geometry.corners[a], &geometry.corners[b], &geometry.corners[c]};
    const bool adds_offset = offsets_planes(geometry.state, rules_);
    const auto units = static_cast<float>(z_units_);
    const std::array<double, 3> moved = geometry.depths(triangle.index);
    std::array<float, 3> z;
    for (std::size_t i = 0; i < 3; ++i) z[i] = (adds_offset ? corner[i]->z : static_cast<float>(moved[i])) / units;
    const auto f = static_cast<std::size_t>(first);
    const int count = batch.count - first;
    float* const out = &batch.shader_z[f];
    kernels_.float_plane(rules_.plane_rule, planes.plane(z), &batch.x[f], &batch.y[f], count, out);
    if (!adds_offset) return;
    const float offset = stepped_offset(corner, geometry.state, rules_) / units;
    for (int i = 0; i < count; ++i) out[i] = out[i] + offset;
}

void FragmentValues::fill_float_attributes(const DrawnTriangle& triangle, int first,
                                           FragmentBatch& batch) const noexcept {
    if (rules_.plane_rule == PlaneRule::greatest_w) {
        const OrderedPlanes planes = ordered_planes(triangle.geometry, triangle.index);
        return fill_attribute_planes(planes, {1, 1, 1}, planes.plane({1, 1, 1}),
                                     triangle.geometry.plane_vertices(triangle.index), triangle, first, batch);
    }
    std::array<float, 3> w;
    for (std::size_t i = 0; i < 3; ++i) w[i] = triangle.geometry.corners[triangle.record.vertex[i]].inverse_w;
    const FloatPlanes planes = float_planes(triangle.geometry, triangle.record);
    FloatPlane under = planes.plane(w);
    if (rules_.sample_divisor == SampleDivisor::centre && planes.is_sampled()) under.right = under.down = 0.5f;
    fill_attribute_planes(planes, w, under, triangle.record.vertex, triangle, first, batch);
}

// Values are first multiplied by `w`; `under` is the plane of `w`.
template <class Planes>
void FragmentValues::fill_attribute_planes(const Planes& planes, const std::array<float, 3>& w, const FloatPlane& under,
                                           const std::array<std::uint32_t, 3>& vertex, const DrawnTriangle& triangle,
                                           int first, FragmentBatch& batch) const noexcept {
    std::array<const ClipVertex*, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = &triangle.geometry.vertices[vertex[i]];
    FloatAttributeLanes attributes{rules_.plane_rule, rules_.perspective, under};
    const std::size_t begin = needs_.color ? 0 : color_channels;
    const std::size_t end = needs_.texcoord ? attribute_count : color_channels;
    const auto f = static_cast<std::size_t>(first);
    for (std::size_t a = begin; a < end; ++a) {
        std::array<float, 3> values, over_w;
        for (std::size_t i = 0; i < 3; ++i) {
            values[i] = a >= color_channels            ? v[i]->texcoord[a - color_channels]
                        : triangle.record.front_facing ? v[i]->front[a]
                                                       : v[i]->back[a];
            over_w[i] = values[i] * w[i];
        }
        auto& lanes = a < color_channels ? batch.color[a] : batch.texcoord[a - color_channels];
        if (a < color_channels && is_kept(values, rules_)) {
            std::fill(lanes.begin() + first, lanes.begin() + batch.count, values[0]);
            continue;
        }
        attributes.add(planes.plane(over_w), &lanes[f]);
    }
    kernels_.float_attributes(attributes, &batch.x[f], &batch.y[f], batch.count - first);
}

}  // namespace strata::rasterizer
