// rasterizer/chip/perspective_weights.h - the weights of NV2A's interpolator where w differs: colours, coordinates, w buffer.
//
// Rule     q_i = |1 / w_i| cut to 24 bits; p_i = |e'_i| q_i cut to 24 bits, e' cut like a weight's; S = (p0 + p1) + p2; r of S
//          as in cut_weight.h; b_i = p_i r cut to 24 bits; the remainder vertex (that of colours) takes 1 - (b' + b'').
// Source   chip-float-depth.md 4.1 and 7; the last bits of p, q or r are open (4.4 there).
// Numbers  Products of 24 bits are exact in binary64, S and 1 - (b' + b'') are rounded there. A corner's edge value and its
//          w have one sign wherever the triangle is drawn (coverage.md 5.8), so magnitudes do. |1 / w| is at least 2^-126
//          and at most 2^126 (signs of w) and |e'| below 2^58: nothing overflows.
// Tests    tests/rasterizer/chip/w_buffer_test.cpp, perspective_colors_test.cpp
#pragma once
#include "rasterizer/chip/cut_weight.h"

namespace strata::rasterizer {
inline namespace strict {

class PerspectiveWeights {
  public:
    constexpr PerspectiveWeights(const std::array<float, 3>& w, const DepthHypothesis& hypothesis) noexcept
        : hypothesis_{hypothesis} {
        for (std::size_t i = 0; i < 3; ++i) q_[i] = cut_bits(1.0 / (w[i] < 0.0f ? -double{w[i]} : double{w[i]}), 24);
    }
    // Before the remainder.
    [[nodiscard]] constexpr std::array<double, 3> cut_at(const EdgeValues& e) const noexcept {
        std::array<double, 3> b{};
        for (std::size_t i = 0; i < 3; ++i) b[i] = cut_bits(cut_edge(e[i] < 0 ? -e[i] : e[i]) * q_[i], 24);
        const double r = cut_reciprocal((b[0] + b[1]) + b[2], hypothesis_);
        for (double& each : b) each = cut_bits(each * r, 24);
        return b;
    }
    [[nodiscard]] constexpr std::array<double, 3> at(const EdgeValues& e) const noexcept {
        return with_remainder(cut_at(e));
    }

  private:
    DepthHypothesis hypothesis_;
    std::array<double, 3> q_{};
};

}  // namespace strict
}  // namespace strata::rasterizer
