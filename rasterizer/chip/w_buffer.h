// rasterizer/chip/w_buffer.h - the depth of NV2A's w buffer: w itself, interpolated with perspective weights.
//
// Rule     w = w1 + b0 (w0 - w1) + b2 (w2 - w1) with the weights of perspective_weights.h; each product truncated
//          toward zero to 2^(ex - 28), where ex is the largest exponent of w1 and the products; the sum truncated to 24
//          bits, offset added (offset_value.h). w_i are binary32, times the pass's scale, rounded once. The slope of
//          the offset is |w(P) - w(Q)|, where P and Q are two adjacent pixels along the steeper axis: one number per
//          triangle (WSlope).
// Source   rasterizer/reference/depth.md 4.8, chip-float-depth.md 4; the weights' last bits and the positions of P and
//          Q are not certain there.
// Numbers  Differences and products are in binary64: exact except for the remainder's product, which is rounded.
// Tests    tests/rasterizer/chip/w_buffer_test.cpp
#pragma once
#include <algorithm>

#include "rasterizer/chip/offset_value.h"
#include "rasterizer/chip/perspective_weights.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::rasterizer {
inline namespace strict {

// The corners' w in the buffer's units.
[[nodiscard]] constexpr std::array<float, 3> scaled_w(const SetupTriangle& t, float scale) noexcept {
    return {t.w[0] * scale, t.w[1] * scale, t.w[2] * scale};
}

class WBuffer {
  public:
    constexpr WBuffer(const std::array<float, 3>& w, const DepthHypothesis& hypothesis, double offset = 0.0) noexcept
        : weights_{w, hypothesis},
          base_{w[1]},
          first_{double{w[0]} - double{w[1]}},
          last_{double{w[2]} - double{w[1]}},
          offset_{offset},
          sum_bits_{hypothesis.sum_bits} {}
    // 24 significant bits, including the offset, not clamped.
    [[nodiscard]] constexpr double value(const EdgeValues& e) const noexcept {
        const std::array<double, 3> b = weights_.at(e);
        const double p0 = b[0] * first_, p2 = b[2] * last_;
        const int unit = std::max({exponent_of(base_), exponent_of(p0), exponent_of(p2)}) - (sum_bits_ - 1);
        const double units = power_of_two(-unit);
        const auto truncated = [units](double p) { return static_cast<std::int64_t>(p * units); };
        return offset_value(two_sum(base_, static_cast<double>(truncated(p0) + truncated(p2)) * power_of_two(unit)),
                            offset_);
    }

  private:
    PerspectiveWeights weights_;
    double base_, first_, last_, offset_;
    int sum_bits_;
};

// |w(P) - w(Q)| of a triangle drawn within `clip`; 0 if it covers no pixel there.
[[nodiscard]] double w_slope(const SetupTriangle& t, const std::array<float, 3>& w, const Rect& clip,
                             const RasterRules& rules) noexcept;

}  // namespace strict
}  // namespace strata::rasterizer
