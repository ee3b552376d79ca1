// rasterizer/values/pixel_weights.h - the weights b1 and b2 of a triangle's corners 1 and 2 as functions of the pixel.
//
// Rule     Snapped planes: b_i = e_i r with r = 1/A, rounded; the filter of plane.h includes this error. Unsnapped
//          planes (PlaneOrigin::unsnapped) start at the unsnapped corners: the binary64 value below is the weight
//          itself.
// Numbers  e_i = (x sx + y sy) + c; if |c| + 2^16 (|sx| + |sy|) <= 2^53, every step is an integer that binary64
//          represents exactly. Otherwise e_i is taken from the 64-bit edge functions and rounded once.
// Tests    tests/rasterizer/values/plane_test.cpp, fragment_values_test.cpp
#pragma once
#include <limits>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/fragment_batch.h"
#include "rasterizer/coverage/line_coverage.h"
#include "rasterizer/coverage/small_triangles.h"
#include "rasterizer/set_up/geometry.h"
#include "rasterizer/values/weight_lanes.h"

namespace strata::rasterizer {
inline namespace strict {

struct PixelWeights {
    enum class Kind : std::uint8_t { snapped, snapped_wide, unsnapped };

    // Edge function e_i as a plane over pixels: (x * step_x + y * step_y) + constant, in this order.
    struct EdgePlane {
        double step_x, step_y, constant;
        [[nodiscard]] constexpr double at(double x, double y) const noexcept {
            return (x * step_x + y * step_y) + constant;
        }
    };

    Kind kind = Kind::unsnapped;
    double r;            // 1 / A, of the snapped or unsnapped corners
    double area;         // A of the snapped corners; not set for unsnapped ones
    double reach = 1.0;  // the greatest |b1| + |b2| of the pixels that are asked, at least 1: more outside the triangle
    EdgePlane e1, e2;
    double x0, y0, x1, y1, x2, y2;  // unsnapped corner 0, and corners 1 and 2 relative to it

    // The wide kind is for edges whose values exceed 2^53: each is computed in 64-bit integers and rounded once.
    PixelWeights(const Geometry& geometry, const TriangleRecord& triangle) noexcept {
        if (geometry.rules.plane_origin == PlaneOrigin::unsnapped && unsnap(geometry, triangle)) return;
        snap(geometry, triangle);
        r = 1.0 / area;
    }
    // For small triangle `k` of a group: never wide, the same integers.
    PixelWeights(const Geometry& geometry, const TriangleRecord& triangle, const TriangleGroup& group,
                 std::size_t k) noexcept {
        if (geometry.rules.plane_origin == PlaneOrigin::unsnapped && unsnap(geometry, triangle)) return;
        snap(group, k);
        r = 1.0 / area;
    }
    // Selects r = 1: the weights are the edge values of the snapped corners, whatever the plane origin.
    struct EdgesAlone {};
    PixelWeights(EdgesAlone, const Geometry& geometry, const TriangleRecord& triangle) noexcept : r{1.0} {
        snap(geometry, triangle);
    }
    PixelWeights(EdgesAlone, const TriangleGroup& group, std::size_t k) noexcept : r{1.0} { snap(group, k); }
    // For the filter of plane.h.
    [[nodiscard]] double filter_reach() const noexcept { return kind != Kind::unsnapped ? reach : 0.0; }

  private:
    [[nodiscard]] static double line_reach(const Geometry& geometry, const TriangleRecord& line) noexcept {
        const auto [first, a, b] = geometry.points(line);
        return 1.0 + 2.0 * line_overshoot(a, b, geometry.state, geometry.rules);
    }
    void snap(const Geometry& geometry, const TriangleRecord& triangle) noexcept {
        const TriangleEdges edges = geometry.edges(triangle);
        area = static_cast<double>(edges.area());
        e1 = plane(edges.edge(1), geometry.rules.subpixel_bits);
        e2 = plane(edges.edge(2), geometry.rules.subpixel_bits);
        kind = std::max(size(e1), size(e2)) > 0x1p53 ? Kind::snapped_wide : Kind::snapped;
        // Its fragments are beyond its corners, without a bound: exact arithmetic decides them all.
        if (triangle.negative_w() != 0) reach = std::numeric_limits<double>::infinity();
        if (triangle.shape() == Shape::line) reach = line_reach(geometry, triangle);
        // The centre of a pixel with a covered sample is within a pixel of the triangle.
        if (triangle.shape() == Shape::polygon)
            reach = 1.0 + 2.0 * (change_per_pixel(e1) + change_per_pixel(e2)) / area;
    }
    void snap(const TriangleGroup& group, std::size_t k) noexcept {
        area = group.area[k];
        e1 = plane(group, k, 1);
        e2 = plane(group, k, 2);
        kind = Kind::snapped;
    }
    // False if the unsnapped corners are collinear and therefore have no plane.
    [[nodiscard]] bool unsnap(const Geometry& geometry, const TriangleRecord& triangle) noexcept {
        const auto& corners = geometry.corners;
        const auto& p0 = corners[triangle.vertex[0]].unsnapped;
        const auto& p1 = corners[triangle.vertex[1]].unsnapped;
        const auto& p2 = corners[triangle.vertex[2]].unsnapped;
        x0 = p0[0], y0 = p0[1];
        x1 = p1[0] - x0, y1 = p1[1] - y0;
        x2 = p2[0] - x0, y2 = p2[1] - y0;
        if (x1 * y2 == x2 * y1) return false;
        if (const auto& sample = geometry.state.sample) x0 -= sample->right(), y0 -= sample->down();
        kind = Kind::unsnapped;
        r = 1.0 / (x1 * y2 - x2 * y1);
        return true;
    }
    [[nodiscard]] static EdgePlane plane(const Edge& edge, int subpixel_bits) noexcept {
        const auto unit = static_cast<double>(1 << subpixel_bits);
        return {static_cast<double>(edge.step_x()) * unit, static_cast<double>(edge.step_y()) * unit,
                static_cast<double>(edge.at(pixel_centre(0, 0, subpixel_bits)))};
    }
    // Extrapolates from the value at the box's first pixel back to pixel (0, 0). The tie term that was subtracted for
    // coverage is added again.
    [[nodiscard]] static EdgePlane plane(const TriangleGroup& g, std::size_t k, std::size_t i) noexcept {
        const auto number = [k](const TriangleGroup::PerTriangle& all) {
            return std::int64_t{static_cast<std::int32_t>(all[k])};
        };
        const std::int64_t right = number(g.step[i]), down = number(g.down[i]);
        const std::int64_t first = number(g.value[i]) + number(g.tie[i]);
        return {static_cast<double>(right), static_cast<double>(down),
                static_cast<double>(first - number(g.x0) * right - number(g.y0) * down)};
    }
    [[nodiscard]] static constexpr double change_per_pixel(const EdgePlane& e) noexcept {
        return (e.step_x < 0.0 ? -e.step_x : e.step_x) + (e.step_y < 0.0 ? -e.step_y : e.step_y);
    }
    // A bound of every intermediate of EdgePlane::at over 2^16 by 2^16 pixels.
    [[nodiscard]] static constexpr double size(const EdgePlane& e) noexcept {
        const auto magnitude = [](double v) { return v < 0.0 ? -v : v; };
        return magnitude(e.constant) + 0x1p16 * (magnitude(e.step_x) + magnitude(e.step_y));
    }
};

}  // namespace strict
}  // namespace strata::rasterizer
