// rasterizer/values/ordered_planes.h - planes in binary32 that start at the corner with the greatest w
// (PlaneRule::greatest_w).
//
// Rule     Corners p2, p0, p1 are rotated so that the least y along the rows comes first, then so that the greatest w
//          does. Each of the two steps compares the corners in the order before it: if the second has the best value it
//          rotates by one, and if the third has it by two (both, if they tie). Positions are snapped, in pixels from
//          the centre of the first pixel (window.h). Depth: D = r / (x1 y2 - x2 y1), dx = (y2 (z1 - z0) - y1 (z2 - z0))
//          D, dy = (x1 (z2 - z0) - x2 (z1 - z0)) D, C = z0 r + n, z_k = z (1 / w), r and n of the depth range.
//          Attributes: sides times w, plane = (u0 M0 + u1 M1) + u2 M2. Value at pixel (i, j): (i - x0) dx + (C + (j -
//          y0) dy). Each operation is rounded; operands and results below 2^-126 are zeros.
// Source   pipeline/reference/swiftshader-rasterizer.md 2.
// Numbers  Pixel coordinates are below 2^16, so they are exact. If the sides have no area, the slopes are 0.
// Tests    tests/rasterizer/values/ordered_planes_test.cpp
#pragma once
#include "rasterizer/set_up/polygon_offset.h"
#include "rasterizer/set_up/window.h"
#include "rasterizer/values/float_planes.h"

namespace strata::rasterizer {
inline namespace strict {

class OrderedPlanes {
  public:
    constexpr OrderedPlanes(const std::array<const ClipVertex*, 3>& corner, const RasterState& state,
                            const RasterRules& rules) noexcept
        : corner_{corner}, snap_step_{1.0f / static_cast<float>(1 << rules.subpixel_bits)} {
        const WindowTransform window{state, rules};
        for (std::size_t i = 0; i < 3; ++i) p_[i] = window.from_first_centre(*corner[i]);
        row_base_ = static_cast<float>(window.counted_row(0));
        row_step_ = window.is_turned() ? -1.0f : 1.0f;
        if (state.sample) right_ = state.sample->right(), down_ = state.sample->down();
        is_done_ = state.window_positions;
        const bool is_against = !is_done_ && state.y_direction == YDirection::up && rules.y_axis == YAxis::memory;
        rotate_corners([=](const ClipVertex& v) { return is_against ? -v.y : v.y; },
                       [](float a, float b) { return a < b; });
        rotate_corners([](const ClipVertex& v) { return v.w; }, [](float a, float b) { return a > b; });
        const float n = state.depth_near, f = state.depth_far;
        const bool symmetric = state.clip_depth == ClipDepth::minus_one_to_one;
        scale_ = Flushed{symmetric ? (f - n) * 0.5f : f - n};
        least_ = Flushed{symmetric ? (n + f) * 0.5f : n};
        if (is_done_) scale_ = Flushed{1.0f / static_cast<float>(z_units(state, rules))}, least_ = Flushed{};
    }

    // The plane of depth, 0 to 1, not clamped, without polygon offset.
    [[nodiscard]] constexpr FloatPlane depth() const noexcept {
        const Side first = side(1), second = side(2);
        const Flushed z0 = depth_of(0), z1 = depth_of(1) - z0, z2 = depth_of(2) - z0;
        const Flushed d = scale_ / less(first.x, second.y, second.x, first.y);
        FloatPlane plane = placed();
        plane.dx = (less(second.y, z1, first.y, z2) * d).v;
        plane.dy = (less(first.x, z2, second.x, z1) * d).v;
        plane.origin = in_range(z0).v;
        return plane;
    }
    // The polygon offset of `plane`, which is depth().
    [[nodiscard]] static constexpr float offset(const FloatPlane& plane, const PolygonOffset& by, float unit) noexcept {
        const auto size = [](float v) { return v < 0.0f ? -v : v; };
        const Flushed slope{std::max(size(plane.dx), size(plane.dy))};
        return (Flushed{unit} * Flushed{by.units} + slope * Flushed{by.factor}).v;
    }
    // The unit of OffsetUnit::differences for float formats.
    [[nodiscard]] constexpr float difference_unit() const noexcept {
        const Flushed z0 = depth_of(0);
        return static_cast<float>(
            float_offset_unit({in_range(z0).v, in_range(depth_of(1) - z0).v, in_range(depth_of(2) - z0).v}));
    }

    // The plane of an attribute, given at corners 0, 1 and 2 in the caller's order, before the division by the plane of
    // 1 / w.
    [[nodiscard]] constexpr FloatPlane plane(const std::array<float, 3>& value) const noexcept {
        const Flushed u0{value[order_[0]]}, u1{value[order_[1]]}, u2{value[order_[2]]};
        const Flushed w1{at(1).w}, w2{at(2).w}, q0 = reciprocal_w(0);
        const auto by = [this](Side s, Flushed w) {
            const Flushed scale = w * Flushed{snap_step_};
            return Side{scale * s.x, scale * s.y};
        };
        const Side first = by(steps(1), w1), second = by(steps(2), w2);
        const Flushed area = less(first.x, second.y, second.x, first.y);
        const Flushed g = area.v == 0.0f ? Flushed{} : Flushed{1.0f} / area, own = g * q0;
        const auto sum = [&](Flushed m0, Flushed m1, Flushed m2) { return ((u0 * m0 + u1 * m1) + u2 * m2).v; };
        FloatPlane plane = placed();
        plane.dx = sum(less(first.y, w2, second.y, w1) * own, second.y * g, -first.y * g);
        plane.dy = sum(less(second.x, w1, first.x, w2) * own, -second.x * g, first.x * g);
        plane.origin = sum(q0, Flushed{}, Flushed{});
        return plane;
    }

  private:
    struct Side {
        Flushed x, y;
    };
    // a b - c d with three roundings.
    [[nodiscard]] static constexpr Flushed less(Flushed a, Flushed b, Flushed c, Flushed d) noexcept {
        return a * b - c * d;
    }

    template <class Key, class Better>
    constexpr void rotate_corners(const Key& key, const Better& is_better) noexcept {
        const std::array<float, 3> k{key(at(0)), key(at(1)), key(at(2))};
        float best = k[0];
        for (const float each : k)
            if (is_better(each, best)) best = each;
        if (best == k[1]) order_ = {order_[1], order_[2], order_[0]};
        if (best == k[2]) order_ = {order_[2], order_[0], order_[1]};
    }

    [[nodiscard]] constexpr const ClipVertex& at(std::size_t i) const noexcept { return *corner_[order_[i]]; }
    [[nodiscard]] constexpr Flushed reciprocal_w(std::size_t i) const noexcept {
        return at(i).w == 0.0f ? Flushed{1.0f} : Flushed{1.0f} / Flushed{at(i).w};
    }
    [[nodiscard]] constexpr Flushed depth_of(std::size_t i) const noexcept {
        return is_done_ ? Flushed{at(i).z} : Flushed{at(i).z} * reciprocal_w(i);
    }
    [[nodiscard]] constexpr Flushed in_range(Flushed z) const noexcept { return z * scale_ + least_; }

    // From corner 0 to corner i, in whole subpixels.
    [[nodiscard]] constexpr Side steps(std::size_t i) const noexcept {
        const auto difference = [](std::int32_t a, std::int32_t b) {
            const std::uint32_t modulo = static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b);
            return Flushed{static_cast<float>(static_cast<std::int32_t>(modulo))};
        };
        const SubpixelPoint a = p_[order_[i]], o = p_[order_[0]];
        return {difference(a.x, o.x), difference(a.y, o.y)};
    }
    [[nodiscard]] constexpr Side side(std::size_t i) const noexcept {
        const Side s = steps(i);
        return {s.x * Flushed{snap_step_}, s.y * Flushed{snap_step_}};
    }
    [[nodiscard]] constexpr FloatPlane placed() const noexcept {
        FloatPlane plane;
        const SubpixelPoint o = p_[order_[0]];
        plane.x0 = static_cast<float>(o.x) * snap_step_;
        plane.y0 = static_cast<float>(o.y) * snap_step_;
        plane.row_base = row_base_;
        plane.row_step = row_step_;
        plane.right = right_;
        plane.down = down_;
        return plane;
    }

    std::array<const ClipVertex*, 3> corner_;
    float snap_step_;
    std::array<SubpixelPoint, 3> p_{};
    std::array<std::size_t, 3> order_{2, 0, 1};
    float row_base_ = 0.0f, row_step_ = 1.0f;
    float right_ = 0.0f, down_ = 0.0f;  // position of the sample relative to its pixel's centre
    Flushed scale_, least_;             // of the depth range
    bool is_done_ = false;              // positions and depths are already in window coordinates
};

// The planes of triangle `index`.
[[nodiscard]] inline OrderedPlanes ordered_planes(const Geometry& geometry, std::size_t index) noexcept {
    const auto& [a, b, c] = geometry.plane_vertices(index);
    return {{&geometry.vertices[a], &geometry.vertices[b], &geometry.vertices[c]}, geometry.state, geometry.rules};
}

// The unit r of the polygon offset for a triangle's planes.
[[nodiscard]] inline float ordered_offset_unit(const OrderedPlanes& planes, const std::array<float, 3>& z,
                                               const RasterState& state, const RasterRules& rules) noexcept {
    const bool is_float = state.depth_format != DepthFormat::d16;
    if (rules.offset_unit == OffsetUnit::differences && is_float) return planes.difference_unit();
    return static_cast<float>(offset_unit(z, state, rules) / z_units(state, rules));
}

}  // namespace strict
}  // namespace strata::rasterizer
