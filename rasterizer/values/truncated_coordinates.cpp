// rasterizer/values/truncated_coordinates.cpp - interpolates texture coordinates as NV2A does
// (truncated_coordinates.h).
#include "rasterizer/values/truncated_coordinates.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "rasterizer/base/nv20_arithmetic.h"
#include "rasterizer/chip/perspective_weights.h"

namespace strata::rasterizer {
inline namespace strict {
namespace {

// Weights of corners 0 and 2: differences are taken from corner 1.
struct OuterWeights {
    double b0, b2;
};

[[nodiscard]] OuterWeights outer_weights(const TruncatedWeights& weights, const EdgeValues& e) noexcept {
    const std::array<double, 3> b = with_remainder(weights.at(e));
    return {b[0], b[2]};
}
[[nodiscard]] OuterWeights outer_weights(const PerspectiveWeights& weights, const EdgeValues& e) noexcept {
    const std::array<double, 3> b = weights.at(e);
    return {b[0], b[2]};
}

// The terms of the sum, before they are multiplied by the weights.
struct TruncatedSum {
    double middle, first, last;

    explicit TruncatedSum(const std::array<float, 3>& u) noexcept
        : middle{u[1]}, first{double{u[0]} - double{u[1]}}, last{double{u[2]} - double{u[1]}} {}

    [[nodiscard]] double at(const OuterWeights& b) const noexcept {
        const double p0 = b.b0 * first, p2 = b.b2 * last;
        const int k = std::max(
            {exponent_of(middle), exponent_of(b.b0) + exponent_of(first), exponent_of(b.b2) + exponent_of(last)});
        // The unit would exceed the exponent range of binary64, or a product is not finite. With binary32 corners this
        // happens only for zeros, infinities and NaN. The plain sum then is 0, infinite or NaN: an infinite weight
        // times 0 has small exponents but is still NaN.
        if (k < -400 || k > 400 || !std::isfinite(p0 + p2)) return (middle + p0) + p2;
        const double unit = power_of_two(k - 23), units = power_of_two(23 - k);
        const auto truncated = [units](double v) { return static_cast<double>(static_cast<std::int64_t>(v * units)); };
        return ((truncated(middle) + truncated(p0)) + truncated(p2)) * unit;
    }
};

}  // namespace
}  // namespace strict

void truncated_coordinates(const std::array<float, 3>& u, const std::array<float, 3>& w, const TriangleLanes& lanes,
                           const DepthHypothesis& hypothesis, float* out) noexcept {
    if (is_constant(u)) {
        std::fill_n(out, lanes.count, u[0]);
        return;
    }
    const TruncatedSum sum{u};
    const auto fill = [&](const auto& weights) {
        for (int i = 0; i < lanes.count; ++i)
            out[i] = truncate_to_binary32(sum.at(outer_weights(weights, lanes.edge_values(i))));
    };
    if (w[0] == w[1] && w[0] == w[2])
        fill(TruncatedWeights{lanes.edges->area(), hypothesis});
    else
        fill(PerspectiveWeights{w, hypothesis});
}

}  // namespace strata::rasterizer
