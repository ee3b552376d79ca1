// rasterizer/values/depth/stepped_z.cpp - shader_z by either kind of stepped plane (stepped_z.h).
#include "rasterizer/values/depth/stepped_z.h"

#include <array>

#include "rasterizer/set_up/stepped_offset.h"
#include "rasterizer/values/float_planes.h"
#include "rasterizer/values/lane_kernels.h"
#include "rasterizer/values/ordered_planes.h"

namespace strata::rasterizer {
namespace {

void fill_plane(const LaneKernels& kernels, const FloatPlane& plane, const TriangleFragments& f) noexcept {
    kernels.float_plane(f.triangle.geometry.rules.plane_rule, plane, f.x(), f.y(), f.count(),
                        &f.batch.shader_z[f.first]);
}

// For PlaneRule::greatest_w, whose depths are always in the units of the depth range.
void fill_ordered_z(const LaneKernels& kernels, const TriangleFragments& f) noexcept {
    const Geometry& geometry = f.triangle.geometry;
    const OrderedPlanes planes = ordered_planes(geometry, f.triangle.index);
    const FloatPlane plane = planes.depth();
    fill_plane(kernels, plane, f);
    if (!geometry.state.polygon_offset.enabled || !f.triangle.record.takes_offset()) return;
    const auto& [a, b, c] = f.triangle.record.vertex;
    const std::array z{geometry.corners[a].z, geometry.corners[b].z, geometry.corners[c].z};
    const float offset = planes.offset(plane, geometry.state.polygon_offset,
                                       ordered_offset_unit(planes, z, geometry.state, geometry.rules));
    float* const out = &f.batch.shader_z[f.first];
    const int count = f.count();
    for (int i = 0; i < count; ++i) out[i] = (Flushed{out[i]} + Flushed{offset}).v;
}

}  // namespace

void fill_stepped_z(const DepthConstants& constants, const TriangleFragments& f) noexcept {
    const Geometry& geometry = f.triangle.geometry;
    const RasterRules& rules = geometry.rules;
    if (rules.plane_rule == PlaneRule::greatest_w) return fill_ordered_z(constants.kernels, f);
    const auto& [a, b, c] = f.triangle.record.vertex;
    const std::array corner{&geometry.corners[a], &geometry.corners[b], &geometry.corners[c]};
    const bool adds_offset = offsets_planes(geometry.state, rules) && f.triangle.record.takes_offset();
    const auto units = static_cast<float>(constants.scale.z_units);
    const std::array<double, 3> moved = geometry.depths(f.triangle.index);
    std::array<float, 3> z;
    for (std::size_t i = 0; i < 3; ++i) z[i] = (adds_offset ? corner[i]->z : static_cast<float>(moved[i])) / units;
    fill_plane(constants.kernels, float_planes(geometry, f.triangle.record).plane(z), f);
    if (!adds_offset) return;
    const float offset = stepped_offset(corner, geometry.state, rules) / units;
    float* const out = &f.batch.shader_z[f.first];
    const int count = f.count();
    for (int i = 0; i < count; ++i) out[i] = out[i] + offset;
}

}  // namespace strata::rasterizer
