// rasterizer/set_up/stepped_offset.h - polygon offset of rasterizers whose planes are stepped in binary32
// (RasterRules::plane_rule): each operation rounded, from the unsnapped positions.
//
// Rule     o = max(|dz/dx|, |dz/dy|) * factor + r units; the slopes are components of the cross product of two sides,
//          times 1 / area. least_corner: the sides p0 - p2 and p1 - p2; o is added to z of each corner, which is then
//          clamped to the range of z. Otherwise: p0 - p1 and p2 - p0, with corners 0 and 1 exchanged if the snapped
//          triangle is clockwise in memory order; o is added to the plane's value at each fragment.
// Source   rasterizer/reference/coverage.md 9.4; pipeline/reference/mesa-rasterizers.md 1.3.
// Tests    tests/rasterizer/set_up/polygon_offset_test.cpp
#pragma once
#include <algorithm>
#include <array>

#include "rasterizer/set_up/polygon_offset.h"

namespace strata::rasterizer {
inline namespace strict {

// A corner in window space: x, y, z.
using OffsetCorner = std::array<float, 3>;

struct SteppedOffset {
    PlaneRule rule;
    bool is_clockwise;
    float factor, units;  // `units` is the product r units of the rule

    [[nodiscard]] constexpr float of(const std::array<OffsetCorner, 3>& corners) const noexcept {
        const float sloped = factor == 0.0f ? 0.0f : largest_slope(corners) * factor;
        return sloped + units;
    }

  private:
    [[nodiscard]] static constexpr OffsetCorner side(const OffsetCorner& a, const OffsetCorner& b) noexcept {
        return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }
    // a b - c d with three roundings.
    [[nodiscard]] static constexpr float less(float a, float b, float c, float d) noexcept {
        const float ab = a * b, cd = c * d;
        return ab - cd;
    }
    [[nodiscard]] constexpr float largest_slope(const std::array<OffsetCorner, 3>& p) const noexcept {
        const bool is_least = rule == PlaneRule::least_corner, turns = is_clockwise && !is_least;
        const OffsetCorner &p0 = p[turns ? 1 : 0], &p1 = p[turns ? 0 : 1], &p2 = p[2];
        const OffsetCorner e = is_least ? side(p0, p2) : side(p0, p1), f = is_least ? side(p1, p2) : side(p2, p0);
        const float reciprocal = 1.0f / less(e[0], f[1], e[1], f[0]);
        const float dx = less(e[1], f[2], e[2], f[1]) * reciprocal, dy = less(e[2], f[0], e[0], f[2]) * reciprocal;
        return std::max(dx < 0 ? -dx : dx, dy < 0 ? -dy : dy);
    }
};

// True if an enabled offset is added to the values of fragments rather than to the corners.
[[nodiscard]] constexpr bool offsets_planes(const RasterState& state, const RasterRules& rules) noexcept {
    return state.polygon_offset.enabled && rules.plane_rule != PlaneRule::exact &&
           rules.plane_rule != PlaneRule::least_corner;  // also for greatest_w, whose offset is computed by
                                                         // ordered_planes.h
}

// The offset of one piece, from its window-space corners.
[[nodiscard]] constexpr float stepped_offset(const std::array<const WindowCorner*, 3>& corner, const RasterState& state,
                                             const RasterRules& rules) noexcept {
    const auto& [a, b, c] = corner;
    const auto place = [](const WindowCorner& v) { return OffsetCorner{v.unsnapped[0], v.unsnapped[1], v.z}; };
    const SteppedOffset stepped{
        rules.plane_rule, Edge{a->p, b->p}.at(c->p) > 0, state.polygon_offset.factor,
        static_cast<float>(offset_unit({a->z, b->z, c->z}, state, rules) * state.polygon_offset.units)};
    return stepped.of({place(*a), place(*b), place(*c)});
}

}  // namespace strict
}  // namespace strata::rasterizer
