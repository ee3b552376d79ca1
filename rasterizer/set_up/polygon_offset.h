// rasterizer/set_up/polygon_offset.h - the polygon offset (glPolygonOffset) of the window z of a triangle's corners.
//
// Rule     o = m * factor + r * units, m = max(|dz/dx|, |dz/dy|) per pixel of the snapped triangle; no slope term if
//          factor is 0 (0 * infinity). r is one code of a fixed-point format (OffsetUnit::two_codes: two), or 2^(e -
//          23) where e is the exponent of the largest |z| (a float format, or OffsetUnit::float_exponent), or 1 in
//          buffer units (OffsetUnit::buffer). OffsetUnit::differences: 1.01 / 65535 for D16, else 2^(e - 23) where e is
//          the exponent of the largest of |z0|, |z1 - z0 + n| and |z2 - z0 + n|, n being the value to which the depth
//          range maps 0. NV2A's own sum is in offset_value.h. z and o are in vertex z units; |o| <= 2^64: larger
//          offsets have the same effect.
// Source   rasterizer/reference/coverage.md 9 (GL 2.1 3.5.5, GL 3.3 3.6.5, D3D 11.3 15.10; NV2A uses that max).
// Numbers  binary64, each operation rounded; a difference of coordinates is exact, so m is within 2^-49 of the true
//          slope.
// Tests    tests/rasterizer/set_up/polygon_offset_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <bit>

#include "rasterizer/set_up/window.h"

namespace strata::rasterizer {
inline namespace strict {

[[nodiscard]] constexpr double magnitude(double v) noexcept { return v < 0.0 ? -v : v; }

// 2^(e - 23), where e is the exponent of the largest |z|; if that is below the normal numbers of binary32, e = -126.
[[nodiscard]] constexpr double float_offset_unit(const std::array<float, 3>& z) noexcept {
    const float largest = std::max({z[0] < 0 ? -z[0] : z[0], z[1] < 0 ? -z[1] : z[1], z[2] < 0 ? -z[2] : z[2]});
    const std::uint32_t exponent = std::max(std::bit_cast<std::uint32_t>(largest) >> 23, 1u);  // biased by 127
    return std::bit_cast<double>((std::uint64_t{exponent} - 127 - 23 + 1023) << 52);
}

// r of the rule, in vertex z units.
[[nodiscard]] constexpr double offset_unit(const std::array<float, 3>& z, const RasterState& state,
                                           const RasterRules& rules) noexcept {
    if (rules.offset_unit == OffsetUnit::differences && state.depth_format == DepthFormat::d16)
        return double{1.01f / 65535.0f} * z_units(state, rules);
    if (rules.offset_unit == OffsetUnit::differences) {
        const auto units = static_cast<float>(z_units(state, rules));
        const bool symmetric = state.clip_depth == ClipDepth::minus_one_to_one;
        const float n = (symmetric ? (state.depth_near + state.depth_far) * 0.5f : state.depth_near) * units;
        return float_offset_unit({z[0], (z[1] - z[0]) + n, (z[2] - z[0]) + n});
    }
    if (rules.offset_unit == OffsetUnit::buffer) return z_units(state, rules) / buffer_units(state.depth_format);
    if (rules.offset_unit == OffsetUnit::float_exponent || state.depth_format == DepthFormat::d32f)
        return float_offset_unit(z);
    const double codes = rules.offset_unit == OffsetUnit::two_codes ? 2.0 : 1.0;
    return codes * z_units(state, rules) / max_code(state.depth_format);
}

// The larger of |dz/dx| and |dz/dy|, per pixel. Precondition: the area of `p` is not 0.
[[nodiscard]] constexpr double largest_slope(const std::array<SubpixelPoint, 3>& p, const std::array<double, 3>& z,
                                             int subpixel_bits) noexcept {
    const double x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y;  // at most 2^28: exact as integers
    const double x2 = p[2].x - p[0].x, y2 = p[2].y - p[0].y;
    const double z1 = z[1] - z[0], z2 = z[2] - z[0];
    const double per_pixel = static_cast<double>(1 << subpixel_bits) / static_cast<double>(Edge{p[0], p[1]}.at(p[2]));
    const double dx = (z1 * y2 - z2 * y1) * per_pixel;
    const double dy = (z2 * x1 - z1 * x2) * per_pixel;
    return std::max(magnitude(dx), magnitude(dy));
}

// o of a triangle, which is added to all three corners.
[[nodiscard]] constexpr double polygon_offset(const std::array<SubpixelPoint, 3>& p, const std::array<float, 3>& z,
                                              const RasterState& state, const RasterRules& rules) noexcept {
    const PolygonOffset& offset = state.polygon_offset;
    double o = offset_unit(z, state, rules) * offset.units;
    if (offset.factor != 0.0f) o = largest_slope(p, {z[0], z[1], z[2]}, rules.subpixel_bits) * offset.factor + o;
    return std::clamp(o, -0x1p64, 0x1p64);
}

}  // namespace strict
}  // namespace strata::rasterizer
