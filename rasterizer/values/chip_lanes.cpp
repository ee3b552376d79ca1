// rasterizer/values/chip_lanes.cpp - the inputs of NV2A's kernels for one triangle, from its geometry (chip_lanes.h),
// and the definition for corners that are not narrow.
#include "rasterizer/values/chip_lanes.h"

#include "rasterizer/chip/window_z.h"
#include "rasterizer/set_up/polygon_offset.h"

namespace strata::rasterizer {
inline namespace strict {
namespace {

// z_i - z_j, or 0 below the least depth; clears `is_narrow` if the difference does not fit in 29 bits.
[[nodiscard]] double narrow_difference(double a, double b, bool& is_narrow) noexcept {
    const TwoTerms d = two_sum(a, -b);
    is_narrow = is_narrow && d.low == 0.0 && truncate_bits(d.high, narrow_bits) == d.high;
    return magnitude(d.high) < least_depth ? 0.0 : d.high;
}

}  // namespace

NarrowWindowZ::NarrowWindowZ(const WindowZCorners& corners, const DepthHypothesis& h) noexcept
    : offset{corners.offset}, sum_bits{h.sum_bits} {
    for (std::size_t i = 0; i < 3; ++i) z[i] = double{flushed_depth(static_cast<float>(corners.z[i]))};
    d10 = narrow_difference(z[1], z[0], is_narrow);
    d20 = narrow_difference(z[2], z[0], is_narrow);
    d21 = narrow_difference(z[2], z[1], is_narrow);
}

WindowZCorners window_z_corners(const Geometry& geometry, std::size_t triangle, const PolygonOffset& offset) noexcept {
    const TriangleRecord& record = geometry.triangles[triangle];
    if (!offset.enabled || !record.takes_offset()) return {geometry.depths(triangle), 0.0};
    std::array<double, 3> z;
    for (std::size_t i = 0; i < 3; ++i) z[i] = geometry.corners[record.vertex[i]].z;
    const double slope = largest_slope(geometry.points(record), z, geometry.rules.subpixel_bits);
    return {z, chip_offset(slope, offset)};
}

void wide_window_z(const Geometry& geometry, std::uint32_t triangle, const PolygonOffset& offset, const std::int32_t* x,
                   const std::int32_t* y, std::uint32_t lanes, double* values) noexcept {
    const TriangleEdges edges = geometry.edges(geometry.triangles[triangle]);
    const auto [z, o] = window_z_corners(geometry, triangle, offset);
    const WindowZ24 depth{z, edges.area(), geometry.rules.hypothesis, o};
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = std::countr_zero(lanes);
        values[i] = depth.value(edges.at(pixel_centre(x[i], y[i], geometry.rules.subpixel_bits)));
    }
}

}  // namespace strict
}  // namespace strata::rasterizer
