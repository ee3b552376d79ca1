#include "tools/lab/probe/kit/split_weights.h"

#include <algorithm>

#include "rasterizer/chip/color_weights.h"

namespace strata::probe {

namespace {

using rasterizer::DepthHypothesis;
using rasterizer::EdgeValues;
using rasterizer::PerspectiveColor;

// The pixel's centre in 1/16 pixel.
constexpr int center = 56;
constexpr int most_tries = 3000;

DepthHypothesis random_reciprocal(RandomGenerator& random) {
    DepthHypothesis hypothesis;
    hypothesis.weights = random.below(2) == 0 ? rasterizer::WeightRule::area : rasterizer::WeightRule::cut_edges;
    hypothesis.reciprocal_bits = 24 + random.below(7);
    hypothesis.reciprocal_deficit = random.below(9);
    return hypothesis;
}

// Edge values at the centre, all positive; the corners are exchanged if they have the other winding. Empty if the
// centre is outside.
std::optional<EdgeValues> edges_of(SplitTriangle& t) {
    EdgeValues e{};
    for (int turn = 0; turn < 2; ++turn) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            e[k] =
                std::int64_t{t.x[b] - t.x[a]} * (center - t.y[a]) - std::int64_t{t.y[b] - t.y[a]} * (center - t.x[a]);
        }
        if (std::ranges::all_of(e, [](std::int64_t each) { return each > 0; })) return e;
        std::swap(t.x[0], t.x[1]);
        std::swap(t.y[0], t.y[1]);
    }
    return std::nullopt;
}

std::array<std::int32_t, 3> weights_of(const SplitTriangle& t, const EdgeValues& e, const DepthHypothesis& hypothesis,
                                       PerspectiveColor rule) {
    std::array<float, 3> inverse_w{};
    for (std::size_t k = 0; k < 3; ++k) inverse_w[k] = 1.0f / t.w[k];
    return rasterizer::ColorWeights{t.w, inverse_w, e[0] + e[1] + e[2], hypothesis, rule}.at(e);
}

// The w of corner k that makes its weight `share` of the total, with the others unchanged.
float solved_w(const SplitTriangle& t, const EdgeValues& e, std::size_t k, double share) {
    const auto part = [&](std::size_t i) { return static_cast<double>(e[i]) / double{t.w[i]}; };
    const double others = part((k + 1) % 3) + part((k + 2) % 3);
    return static_cast<float>(static_cast<double>(e[k]) * (1.0 - share) / (share * others));
}

}  // namespace

std::optional<SplitTriangle> split_triangle(RandomGenerator& random) {
    const DepthHypothesis one = random_reciprocal(random), other = random_reciprocal(random);
    const PerspectiveColor rule =
        random.below(2) == 0 ? PerspectiveColor::cut_products : PerspectiveColor::weight_products;
    for (int i = 0; i < most_tries; ++i) {
        SplitTriangle t;
        for (std::size_t k = 0; k < 3; ++k) {
            t.x[k] = random.below(128);
            t.y[k] = random.below(128);
            t.w[k] = random.between(0.5f, 4.0f);
        }
        const std::optional<EdgeValues> e = edges_of(t);
        if (!e) continue;
        const auto k = static_cast<std::size_t>(random.below(3));
        t.w[k] = solved_w(t, *e, k, (1 + random.below(127)) / 256.0);
        if (t.w[k] < 0.25f || t.w[k] > 8.0f) continue;
        if (weights_of(t, *e, one, rule) != weights_of(t, *e, other, rule)) return t;
    }
    return std::nullopt;
}

}  // namespace strata::probe
