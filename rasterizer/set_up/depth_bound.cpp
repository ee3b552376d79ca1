// rasterizer/set_up/depth_bound.cpp - an upper bound on the depth of fragments from corners, slopes and rounding errors
// (depth_bound.h).
#include "rasterizer/set_up/depth_bound.h"

#include <cmath>
#include <limits>

#include "rasterizer/coverage/line_coverage.h"
#include "rasterizer/set_up/window.h"

namespace strata::rasterizer {
namespace {

// |dz/dx| + |dz/dy| over the unsnapped positions, per pixel. If they have no area, the plane is the snapped one.
[[nodiscard]] double steepness(const Geometry& geometry, const TriangleRecord& triangle,
                               const std::array<double, 3>& z) {
    const auto at = [&](std::size_t i) { return geometry.corners[triangle.vertex[i]].unsnapped; };
    const auto [x0, y0] = at(0);
    const double x1 = double{at(1)[0]} - x0, y1 = double{at(1)[1]} - y0;
    const double x2 = double{at(2)[0]} - x0, y2 = double{at(2)[1]} - y0;
    const double area = x1 * y2 - x2 * y1;
    if (area == 0.0) return 0.0;
    const double d1 = z[1] - z[0], d2 = z[2] - z[0];
    return (std::fabs(d1 * y2 - d2 * y1) + std::fabs(d2 * x1 - d1 * x2)) / std::fabs(area);
}

// A bound on the effect of rounding each step to binary32 on a depth (float_planes.h), to first order with a margin:
// the rounded area may be off by 4 units of its two products, each slope by the same plus 4 roundings, which
// accumulates over the triangle's extent; the value at pixel (0, 0) and the steps from there round values of the size
// of slope times position.
[[nodiscard]] double step_error(const Geometry& geometry, const TriangleRecord& triangle,
                                const std::array<double, 3>& z) {
    const auto at = geometry.positions(triangle);
    const double x1 = double{at[1][0]} - at[0][0], y1 = double{at[1][1]} - at[0][1];
    const double x2 = double{at[2][0]} - at[0][0], y2 = double{at[2][1]} - at[0][1];
    const double area = std::fabs(x1 * y2 - x2 * y1), products = std::fabs(x1 * y2) + std::fabs(x2 * y1);
    constexpr double unit = 0x1p-24;
    const double relative = 8.0 * unit * (products / area + 1.0);
    if (!(relative < 0.25)) return std::numeric_limits<double>::infinity();
    const double d1 = std::fabs(z[1] - z[0]), d2 = std::fabs(z[2] - z[0]), d12 = std::fabs(z[2] - z[1]);
    // Differences from each corner at which the rules may start.
    const double d = d1 + d2 + d12, width = std::fabs(x1) + std::fabs(x2) + 2.0,
                 height = std::fabs(y1) + std::fabs(y2) + 2.0;
    const double across = d * height / area, down = d * width / area;
    const double far = std::fabs(double{at[0][0]}) + width, low = std::fabs(double{at[0][1]}) + height;
    const double size = across * far + down * low + std::fabs(z[0]) + d;
    return 2.0 * relative * (across * width + down * height) + 16.0 * unit * size;
}

// How much farther than its corners' a shape's depth can be: of a line that is drawn beyond its ends, and of a smooth
// polygon up to a pixel outside.
[[nodiscard]] double beyond_corners(const Geometry& geometry, const TriangleRecord& record,
                                    const std::array<double, 3>& z) {
    const auto p = geometry.points(record);
    if (record.shape() == Shape::line)
        return line_overshoot(p[1], p[2], geometry.state, geometry.rules) * std::fabs(z[2] - z[1]);
    if (record.shape() != Shape::polygon) return 0.0;
    const double units = 1 << geometry.rules.subpixel_bits, area = static_cast<double>(geometry.edges(record).area());
    const auto span = [&](std::size_t i, std::size_t k) {
        return std::abs(static_cast<double>(p[i].x - p[k].x)) + std::abs(static_cast<double>(p[i].y - p[k].y));
    };
    return units * (std::fabs(z[1] - z[0]) * span(2, 0) + std::fabs(z[2] - z[0]) * span(1, 0)) / area;
}

}  // namespace

double depth_bound(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    // Planes from one corner of a source triangle may have larger errors than the corners of a piece imply.
    if (geometry.state.depth_order == DepthOrder::greater || geometry.rules.plane_rule == PlaneRule::greatest_w)
        return std::numeric_limits<double>::infinity();
    const auto larger = [](double a, double b) {
        return a > b ? a : b;
    };  // without a branch, unlike std::max of a list
    double greatest = -std::numeric_limits<double>::infinity(), size = 0.0;
    const double subpixel = 1.0 / (1 << (geometry.rules.subpixel_bits - geometry.rules.unused_bits));
    const bool has_spans = geometry.rules.coverage == CoverageRule::float_spans;
    const double beyond = has_spans ? 1.0 : geometry.rules.snap == Snap::nearest_even ? 0.5 * subpixel : subpixel;
    // Prefetch distance in triangles, because a list refers to triangles at scattered addresses.
    constexpr std::size_t ahead = 16;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const std::uint32_t i = triangles[k];
        if (k + 2 * ahead < triangles.size()) {
            __builtin_prefetch(&geometry.triangles[triangles[k + 2 * ahead]]);
            for (const std::uint32_t v : geometry.triangles[triangles[k + ahead]].vertex)
                __builtin_prefetch(&geometry.corners[v]);
        }
        const std::array<double, 3> z = geometry.depths(i);
        double most = larger(larger(z[0], z[1]), z[2]);
        if (geometry.rules.plane_origin == PlaneOrigin::unsnapped)
            most += beyond * steepness(geometry, geometry.triangles[i], z);
        if (geometry.has_other_shapes) most += beyond_corners(geometry, geometry.triangles[i], z);
        if (geometry.rules.plane_rule != PlaneRule::exact) most += step_error(geometry, geometry.triangles[i], z);
        greatest = larger(most, greatest);
        const double corners = larger(larger(std::fabs(z[0]), std::fabs(z[1])), std::fabs(z[2]));
        size = larger(larger(corners, std::fabs(most)), size);
    }
    return (greatest + 0x1p-20 * size) / z_units(geometry.state, geometry.rules);
}

}  // namespace strata::rasterizer
