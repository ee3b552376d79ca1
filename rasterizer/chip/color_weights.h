// rasterizer/chip/color_weights.h - interpolates vertex colours with 8-bit weights, as NV2A (GeForce3 class) does.
//
// Rule     Vertex colours are first converted to 8 bits: their leading bits (InterpolationHypothesis), times 255, to
//          nearest, a half rounds up. Weights b as in truncated_weights.h; the vertex that takes the remainder has 1 -
//          (the two others), exactly. w0 = floor(256 b0), w2 = floor(256 b2), w1 = 256 - w0 - w2; colour = (w0 c0 + w1
//          c1 + w2 c2 + 128) >> 8, divided by 255 in binary32. If 1/w differs: perspective_weights.h; or
//          PerspectiveColor::edge_products (assumed): p_i = e_i (1/w_i), b_i = p_i (1 / ((p0 + p1) + p2)) in binary64,
//          truncated to 24 bits; or weight_products (assumed): p_i = b_i (1/w_i) truncated to 24 bits, normalized with
//          a reciprocal truncated to 28 bits.
// Source   rasterizer/reference/attributes.md 2.2 to 2.5; chip-depth.md 8; chip-float-depth.md 7.
// Tests    tests/rasterizer/chip/color_weights_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/base/exact_sum.h"
#include "rasterizer/chip/perspective_weights.h"
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/rules/interpolation_hypothesis.h"

namespace strata::rasterizer {
inline namespace strict {

// Uses the `bits` leading mantissa bits of c, 1 to 24.
[[nodiscard]] constexpr std::int32_t to_color_code(float c, int bits = 24) noexcept {
    if (!(c > 0.0f)) return 0;
    if (c >= 1.0f) return 255;
    const std::uint32_t dropped = (1u << (24 - bits)) - 1;
    const auto kept = std::bit_cast<float>(std::bit_cast<std::uint32_t>(c) & ~dropped);
    return static_cast<std::int32_t>(double{kept} * 255.0 + 0.5);
}

// The weights of one triangle. `area` is twice its area; edge values and area are in the same unit, which may be any.
class ColorWeights {
  public:
    ColorWeights(const std::array<float, 3>& w, const std::array<float, 3>& inverse_w, std::int64_t area,
                 const DepthHypothesis& hypothesis, PerspectiveColor rule) noexcept
        : weights_{area, hypothesis},
          perspective_{w, hypothesis},
          inverse_w_{inverse_w},
          rule_{rule},
          is_affine_{inverse_w[0] == inverse_w[1] && inverse_w[0] == inverse_w[2]} {}

    // w0, w1, w2 in units of 1/256 at a fragment with edge values `e`.
    [[nodiscard]] std::array<std::int32_t, 3> at(const EdgeValues& e) const noexcept {
        return from(is_affine_ ? affine(e) : perspective(e));
    }

  private:
    using Weights = std::array<double, 3>;

    [[nodiscard]] Weights affine(const EdgeValues& e) const noexcept { return weights_.at(e); }
    [[nodiscard]] Weights perspective(const EdgeValues& e) const noexcept {
        if (rule_ == PerspectiveColor::cut_products) return perspective_.truncated_at(e);
        const bool by_weights = rule_ == PerspectiveColor::weight_products;
        Weights p = by_weights ? affine(e) : Weights{};
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = by_weights ? truncate_bits(p[i] * inverse_w_[i], 24) : static_cast<double>(e[i]) * inverse_w_[i];
        const double r = 1.0 / ((p[0] + p[1]) + p[2]);
        for (double& b : p) b = truncate_bits(b * (by_weights ? truncate_bits(r, 28) : r), 24);
        return p;
    }
    // The weights of the outer corners are truncated to 1/256, and the middle one takes the rest: the sum is always
    // 256.
    [[nodiscard]] static std::array<std::int32_t, 3> from(const Weights& b) noexcept {
        const std::size_t rest = remainder_vertex(b);
        const auto whole = [&](std::size_t i) {
            if (i != rest) return static_cast<std::int32_t>(256.0 * b[i]);
            // floor(256 (1 - x)) = 256 - ceil(256 x). x = high + low exactly, and low is too small to cross a multiple
            // of 1/256.
            const TwoTerms x = two_sum(b[(i + 1) % 3], b[(i + 2) % 3]);
            const double scaled = 256.0 * x.high;
            const auto down = static_cast<std::int32_t>(scaled);
            const int cut = down < scaled || x.low > 0.0 ? 1 : 0, floor = 256 - down - cut;
            return floor < 0 ? floor + cut : floor;  // negative beyond a smooth polygon's sides: toward zero
        };
        const std::int32_t w0 = whole(0), w2 = whole(2);
        return {w0, 256 - w0 - w2, w2};
    }

    TruncatedWeights weights_;
    PerspectiveWeights perspective_;
    std::array<float, 3> inverse_w_;
    PerspectiveColor rule_;
    bool is_affine_;
};

// Interpolates one channel; `c` are the vertex codes.
[[nodiscard]] constexpr float weighted_color(const std::array<std::int32_t, 3>& w,
                                             const std::array<std::int32_t, 3>& c) noexcept {
    return static_cast<float>((w[0] * c[0] + w[1] * c[1] + w[2] * c[2] + 128) >> 8) / 255.0f;
}

}  // namespace strict
}  // namespace strata::rasterizer
