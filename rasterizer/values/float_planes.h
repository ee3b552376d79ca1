// rasterizer/values/float_planes.h - planes of depth, 1 / w and attributes for rasterizers that round every step to
// binary32.
//
// Rule     reciprocal_area: corners 0 and 1 are exchanged if the snapped triangle is clockwise in memory order; each
//          difference of positions is multiplied by 1 / area before the slopes are computed from it; the value at pixel
//          (i, j) is (dx i + a) + dy j. reciprocal_area_fused: fma(dy, j, fma(dx, i, a)). least_corner: corners in
//          order of y, slopes times 1 / area; (a + dx i) + dy j at the even pixel of each 2 x 2 quad, and from there +
//          dx, then + dy. Positions are those of rules.plane_origin. greatest_w: (i - x0) dx + (a + (j - y0) dy), with
//          the plane from ordered_planes.h. A line's values change along its longer axis alone: da = a - b, slope =
//          (da d) (1 / (dx dx + dy dy)) with d the longer of dx and dy times 1 + the square of their quotient, all of a
//          - b. A point has its vertex' values.
// Source   pipeline/reference/mesa-rasterizers.md 2.4 and 3.3; rasterizer/reference/lines-and-points.md 7.1.
// Numbers  Pixel coordinates are below 2^16, so they are exact. If the area rounds to 0, no slope is finite: NaN and
//          infinities result.
// Tests    tests/rasterizer/values/float_planes_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "rasterizer/base/fused.h"
#include "rasterizer/coverage/float_spans.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {
inline namespace strict {

// A binary32 whose operations flush operands and results below 2^-126 to zeros of the same sign.
struct Flushed {
    float v = 0.0f;

    constexpr Flushed() noexcept = default;
    constexpr explicit Flushed(float x) noexcept
        : v{std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) &
                                 ((std::bit_cast<std::uint32_t>(x) & 0x7f800000u) == 0 ? 0x80000000u : ~0u))} {}
    friend constexpr Flushed operator+(Flushed a, Flushed b) noexcept { return Flushed{a.v + b.v}; }
    friend constexpr Flushed operator-(Flushed a, Flushed b) noexcept { return Flushed{a.v - b.v}; }
    friend constexpr Flushed operator*(Flushed a, Flushed b) noexcept { return Flushed{a.v * b.v}; }
    friend constexpr Flushed operator/(Flushed a, Flushed b) noexcept { return Flushed{a.v / b.v}; }
    friend constexpr Flushed operator-(Flushed a) noexcept { return Flushed{-a.v}; }
};

// The value at the centre of pixel (0, 0), with a sample at its corner, and its change to the next pixel right and
// down.
struct FloatPlane {
    float origin = 0.0f, dx = 0.0f, dy = 0.0f;
    // For greatest_w: the position of the origin, and how row y of memory is counted: row_base + row_step y.
    float x0 = 0.0f, y0 = 0.0f, row_base = 0.0f, row_step = 1.0f;
    // Added to pixel coordinates: the position of the sample relative to the origin (rasterizer/reference/coverage.md
    // 12.2).
    float right = 0.0f, down = 0.0f;

    [[nodiscard]] constexpr float at(PlaneRule rule, int x, int y) const noexcept {
        if (rule == PlaneRule::least_corner) return stepped(x, y);
        if (rule == PlaneRule::greatest_w) return from_own_corner(x, y);
        const float i = static_cast<float>(x) + right, j = static_cast<float>(y) + down;
        if (rule == PlaneRule::reciprocal_area_fused)
            return fused_multiply_add(dy, j, fused_multiply_add(dx, i, origin));
        const float across = dx * i, below = dy * j;
        const float row = across + origin;
        return row + below;
    }

  private:
    [[nodiscard]] constexpr float from_own_corner(int x, int y) const noexcept {
        const float row = row_base + row_step * (static_cast<float>(y) + down);
        const Flushed below = Flushed{row - y0} * Flushed{dy},
                      across = Flushed{(static_cast<float>(x) + right) - x0} * Flushed{dx};
        return (across + (Flushed{origin} + below)).v;
    }
    [[nodiscard]] constexpr float stepped(int x, int y) const noexcept {
        const float across = dx * static_cast<float>(x & ~1), below = dy * static_cast<float>(y & ~1);
        float value = origin + across;
        value = value + below;
        if ((x & 1) != 0) value = value + dx;
        if ((y & 1) != 0) value = value + dy;
        return value;
    }
};

// Common to all planes of one triangle: the order of its corners, and differences of their positions.
class FloatPlanes {
  public:
    // With a sample the origin of the planes is the corner of pixel (0, 0), and they are evaluated at the sample
    // positions.
    constexpr FloatPlanes(PlaneRule rule, const std::array<WindowPosition, 3>& p, bool is_clockwise,
                          const std::optional<SamplePoint>& sample = {}) noexcept
        : rule_{rule} {
        if (rule == PlaneRule::least_corner)
            from_least(p);
        else
            from_first(p, is_clockwise);
        const float half = sample ? 0.0f : 0.5f;
        x_ = p[order_[0]][0] - half;
        y_ = p[order_[0]][1] - half;
        is_sampled_ = sample.has_value();
        if (sample) right_ = 0.5f + sample->right(), down_ = 0.5f + sample->down();
    }

    // A line from corner 1 to corner 2: its values are constant across the longer axis, or across the line.
    [[nodiscard]] static constexpr FloatPlanes of_line(PlaneRule rule, const WindowPosition& a,
                                                       const WindowPosition& b) {
        FloatPlanes planes{rule, Shape::line};
        const Difference d = difference(a, b);
        const float across = d.x * d.x, below = d.y * d.y;
        const float square = across + below;
        planes.reciprocal_ = 1.0f / square;
        planes.x_ = a[0] - 0.5f;
        planes.y_ = a[1] - 0.5f;
        planes.first_ = d;
        if (rule == PlaneRule::least_corner) return planes;
        const auto size = [](float v) { return v < 0.0f ? -v : v; };
        const bool is_x = size(d.x) >= size(d.y);
        const float slope = is_x ? d.y / d.x : d.x / d.y;
        const float squared = slope * slope, longer = 1.0f + squared;
        planes.first_ = is_x ? Difference{d.x * longer, 0.0f} : Difference{0.0f, d.y * longer};
        return planes;
    }
    // A point: the value of corner 2 everywhere.
    [[nodiscard]] static constexpr FloatPlanes of_point(PlaneRule rule) { return {rule, Shape::point}; }

    [[nodiscard]] constexpr bool is_sampled() const noexcept { return is_sampled_; }

    // The plane through the values of corners 0, 1 and 2 in submission order.
    [[nodiscard]] constexpr FloatPlane plane(const std::array<float, 3>& value) const noexcept {
        const float a0 = value[order_[0]], a1 = value[order_[1]], a2 = value[order_[2]];
        FloatPlane plane;
        if (shape_ == Shape::point) {
            plane.origin = value[2];
            return plane;
        }
        if (shape_ == Shape::line) return line_plane(value[1], value[2]);
        if (rule_ == PlaneRule::least_corner) {
            const float middle = a1 - a0, greatest = a2 - a0;
            plane.dx = less(first_.y, greatest, middle, second_.y) * reciprocal_;
            plane.dy = less(second_.x, middle, greatest, first_.x) * reciprocal_;
        } else {
            const float da01 = a0 - a1, da20 = a2 - a0;
            plane.dx = less(da01, second_.y, da20, first_.y);
            plane.dy = less(da20, first_.x, da01, second_.x);
        }
        const float across = plane.dx * x_, below = plane.dy * y_;
        const float moved = across + below;
        plane.origin = a0 - moved;
        plane.right = right_;
        plane.down = down_;
        return plane;
    }

  private:
    constexpr FloatPlanes(PlaneRule rule, Shape shape) noexcept : rule_{rule}, shape_{shape} {}

    [[nodiscard]] constexpr FloatPlane line_plane(float a, float b) const noexcept {
        const float change = a - b, right = change * first_.x, down = change * first_.y;
        FloatPlane plane;
        plane.dx = right * reciprocal_;
        plane.dy = down * reciprocal_;
        const float across = plane.dx * x_, below = plane.dy * y_;
        const float moved = across + below;
        plane.origin = a - moved;
        return plane;
    }

    struct Difference {
        float x, y;
    };
    [[nodiscard]] static constexpr Difference difference(const WindowPosition& a, const WindowPosition& b) noexcept {
        return {a[0] - b[0], a[1] - b[1]};
    }
    // a b - c d with three roundings.
    [[nodiscard]] static constexpr float less(float a, float b, float c, float d) noexcept {
        const float ab = a * b, cd = c * d;
        return ab - cd;
    }

    constexpr void from_first(const std::array<WindowPosition, 3>& p, bool is_clockwise) noexcept {
        if (is_clockwise) order_ = {1, 0, 2};
        first_ = difference(p[order_[0]], p[order_[1]]);
        second_ = difference(p[2], p[order_[0]]);
        reciprocal_ = 1.0f / less(first_.x, second_.y, first_.y, second_.x);
        first_ = {first_.x * reciprocal_, first_.y * reciprocal_};
        second_ = {second_.x * reciprocal_, second_.y * reciprocal_};
    }

    constexpr void from_least(const std::array<WindowPosition, 3>& p) noexcept {
        order_ = by_height(p);
        first_ = difference(p[order_[1]], p[order_[0]]);
        second_ = difference(p[order_[2]], p[order_[0]]);
        reciprocal_ = 1.0f / less(second_.x, first_.y, first_.x, second_.y);
    }

    PlaneRule rule_;
    Shape shape_ = Shape::triangle;
    std::array<std::size_t, 3> order_{0, 1, 2};
    // The first corner, minus half a pixel if there is no sample.
    float x_ = 0.0f, y_ = 0.0f;
    float right_ = 0.0f, down_ = 0.0f;  // position of the sample relative to its pixel's corner
    bool is_sampled_ = false;
    // From corner 1 to corner 0 and from corner 0 to corner 2, times the reciprocal. least_corner: from corner 0 to
    // corners 1 and 2. A line: from its second end to its first, longer by the square of its slope.
    Difference first_{}, second_{};
    float reciprocal_ = 0.0f;
};

// The planes of a triangle after set-up, by the rules of its geometry.
[[nodiscard]] inline FloatPlanes float_planes(const Geometry& geometry, const TriangleRecord& triangle) noexcept {
    const RasterRules& rules = geometry.rules;
    if (triangle.shape() == Shape::point) return FloatPlanes::of_point(rules.plane_rule);
    if (triangle.shape() == Shape::line) {
        const auto [first, a, b] = geometry.positions(triangle);
        return FloatPlanes::of_line(rules.plane_rule, a, b);
    }
    const std::array<SubpixelPoint, 3> p = geometry.points(triangle);
    std::array<WindowPosition, 3> position = geometry.positions(triangle);
    const float pixel = 1.0f / static_cast<float>(1 << rules.subpixel_bits);
    const bool is_clockwise = Edge{p[0], p[1]}.at(p[2]) > 0;
    const auto& sample = geometry.state.sample;
    if (rules.plane_origin == PlaneOrigin::unsnapped && rules.plane_rule != PlaneRule::least_corner)
        return {rules.plane_rule, position, is_clockwise, sample};
    // Otherwise the positions are moved by the sample: snapped ones already are, those of planes stepped from pixel to
    // pixel are moved here.
    for (std::size_t i = 0; i < 3; ++i)
        if (rules.plane_origin == PlaneOrigin::snapped)
            position[i] = {static_cast<float>(p[i].x) * pixel, static_cast<float>(p[i].y) * pixel};
        else if (sample)
            position[i] = {position[i][0] - sample->right(), position[i][1] - sample->down()};
    return {rules.plane_rule, position, is_clockwise};
}

}  // namespace strict
}  // namespace strata::rasterizer
