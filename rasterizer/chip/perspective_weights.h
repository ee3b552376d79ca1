// rasterizer/chip/perspective_weights.h - the weights of NV2A's interpolator if w differs between the corners, for
// colours, texture coordinates and the w buffer.
//
// Rule     q_i = 1 / w_i truncated to 24 bits; e' truncated as in truncated_weights.h; S = the sum of the exact
//          products e'_i q_i, each truncated to a multiple of 2^(ex - 28), where ex is the largest of their exponents;
//          r of S as in truncated_weights.h; p_i = e'_i q_i truncated to 25 bits; b_i = p_i r truncated to 24 bits; the
//          remainder vertex (that of colours) takes 1 - (b' + b'').
// Source   rasterizer/reference/chip-float-depth.md 4.1 and 7; the last bits of p, q or r are not certain (4.4 there).
// Numbers  Products of 24 bits and S, which has 31, are exact in binary64; 1 - (b' + b'') is rounded. A corner's edge
//          value and its w have the same sign wherever a triangle is drawn (coverage.md 5.8): its products are not
//          negative. Those of a smooth polygon are, beyond its sides. |1 / w| is at least 2^-126 and at most 2^126
//          (signs of w) and |e'| is below 2^58: nothing overflows.
// Tests    tests/rasterizer/chip/w_buffer_test.cpp, perspective_colors_test.cpp
#pragma once
#include <algorithm>

#include "rasterizer/chip/truncated_weights.h"

namespace strata::rasterizer {
inline namespace strict {

// The sum of three products. The adder keeps 29 bits of each, counted from the first bit of the largest.
[[nodiscard]] constexpr double aligned_sum(const std::array<double, 3>& p) noexcept {
    const double unit = power_of_two(std::max({exponent_of(p[0]), exponent_of(p[1]), exponent_of(p[2]), -500}) - 28);
    std::int64_t sum = 0;
    for (const double each : p) sum += static_cast<std::int64_t>(each / unit);
    return static_cast<double>(sum) * unit;
}

class PerspectiveWeights {
  public:
    constexpr PerspectiveWeights(const std::array<float, 3>& w, const DepthHypothesis& hypothesis) noexcept
        : hypothesis_{hypothesis} {
        for (std::size_t i = 0; i < 3; ++i) q_[i] = truncate_bits(1.0 / double{w[i]}, 24);
    }
    // The weights before the remainder is assigned.
    [[nodiscard]] constexpr std::array<double, 3> truncated_at(const EdgeValues& e) const noexcept {
        std::array<double, 3> b{};
        for (std::size_t i = 0; i < 3; ++i) b[i] = truncated_edge(e[i]) * q_[i];
        const double r = truncated_reciprocal(aligned_sum(b), hypothesis_);
        for (double& each : b) each = truncate_bits(truncate_bits(each, 25) * r, 24);
        return b;
    }
    [[nodiscard]] constexpr std::array<double, 3> at(const EdgeValues& e) const noexcept {
        return with_remainder(truncated_at(e));
    }

  private:
    DepthHypothesis hypothesis_;
    std::array<double, 3> q_{};
};

}  // namespace strict
}  // namespace strata::rasterizer
