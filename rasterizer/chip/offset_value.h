// rasterizer/chip/offset_value.h - polygon offset as NV2A (GeForce3 class) adds it to a fragment's value.
//
// Rule     v = trunc(value, 24); with offset v = trunc(v + o, 24), o = trunc(trunc(slope * factor, 24) + bias, 24),
//          slope truncated to 24 bits. trunc(x, 24) truncates toward zero to 24 bits; everything is in the buffer's own
//          units. The slope of a z buffer is the larger of |dz/dx| and |dz/dy| of the triangle, per pixel.
// Source   rasterizer/reference/coverage.md 9.3, chip-float-depth.md 2.
// Tests    tests/rasterizer/chip/w_buffer_test.cpp
#pragma once
#include "rasterizer/base/two_terms.h"
#include "rasterizer/chip/truncated_weights.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {
inline namespace strict {

// high + low truncated toward zero to 24 bits. Precondition: |low| is at most half a unit in the last place of high.
[[nodiscard]] constexpr double truncate_sum_24(TwoTerms s) noexcept {
    const double truncated = truncate_bits(s.high, 24);
    const bool is_below = truncated == s.high && s.low != 0.0 && (s.low < 0.0) != (s.high < 0.0);
    // `high` has 24 bits and the sum is slightly smaller in magnitude: the previous value.
    return is_below ? truncate_bits(std::bit_cast<double>(std::bit_cast<std::uint64_t>(truncated) - 1), 24) : truncated;
}

// o of a triangle whose value has that slope.
[[nodiscard]] constexpr double chip_offset(double slope, const PolygonOffset& offset) noexcept {
    if (!offset.enabled) return 0.0;
    const double sloped = offset.factor == 0.0f ? 0.0 : truncate_bits(truncate_bits(slope, 24) * offset.factor, 24);
    return truncate_sum_24(two_sum(sloped, double{offset.units}));
}

[[nodiscard]] constexpr double offset_value(TwoTerms value, double offset) noexcept {
    const double v = truncate_sum_24(value);
    return offset == 0.0 ? v : truncate_sum_24(two_sum(v, offset));
}

}  // namespace strict
}  // namespace strata::rasterizer
