#include "rasterizer/set_up/depth_bound.h"

#include <cmath>
#include <limits>

#include "rasterizer/set_up/window.h"

namespace strata::rasterizer {
namespace {

// |dz/dx| + |dz/dy| over the unsnapped positions, per pixel. Without an area there the plane is the snapped one.
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

}  // namespace

double depth_bound(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    const auto larger = [](double a, double b) {
        return a > b ? a : b;
    };  // without a branch, as std::max of a list is not
    double greatest = -std::numeric_limits<double>::infinity(), size = 0.0;
    const double subpixel = 1.0 / (1 << geometry.rules.subpixel_bits);
    const double beyond = geometry.rules.snap == Snap::nearest_even ? 0.5 * subpixel : subpixel;
    // Memory is asked for this many triangles ahead, because a list names triangles here and there.
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
        greatest = larger(most, greatest);
        const double corners = larger(larger(std::fabs(z[0]), std::fabs(z[1])), std::fabs(z[2]));
        size = larger(larger(corners, std::fabs(most)), size);
    }
    return (greatest + 0x1p-20 * size) / z_units(geometry.state, geometry.rules);
}

}  // namespace strata::rasterizer
