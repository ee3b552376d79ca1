// peeling/programs/fixed_passes/weighted.h - the fragment weights of McGuire and Bavoil 2013, and the resolve of
// weighted sums to a pixel's colour, for weighted_blended, tails and moments.
//
// Rule     Weights by equations 7 to 10 or by a formula, each operation rounded to binary32. Pixel = (sums / weights)
// (1 - t) +
//          background t, where t is the product of (1 - alpha) of all fragments; the background if the sum of weights
//          is not above 0.
// Source   peeling/reference/algorithms.md 18. The test of the sum of weights replaces the least divisor of the paper.
// Tests    tests/peeling/algorithms/weighted_blended_test.cpp
#pragma once
#include <algorithm>
#include <cmath>

#include "peeling/programs/algorithm_options.h"
#include "peeling/programs/average.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling {
inline namespace strict {

// The weight without the factor alpha of equations 7 to 10. `z` is the distance from the eye; in equation 10 it is the
// window depth, 0 near and 1 far.
[[nodiscard]] inline float weight_at(Weight weight, float z) noexcept {
    const auto at_least = [](float w) { return std::max(0.01f, w); };
    const auto between = [&](float w) { return at_least(std::min(3000.0f, w)); };
    const auto squared = [](float v) { return v * v; };
    const auto cubed = [](float v) { return v * v * v; };
    switch (weight) {
        case Weight::eq7: return between(10.0f / ((1e-5f + squared(z / 5.0f)) + squared(cubed(z / 200.0f))));
        case Weight::eq8: return between(10.0f / ((1e-5f + cubed(z / 10.0f)) + squared(cubed(z / 200.0f))));
        case Weight::eq9: return between(0.03f / (1e-5f + squared(squared(z / 200.0f))));
        case Weight::eq10: return at_least(3000.0f * cubed(1.0f - z));
        case Weight::constant: break;
    }
    return 1.0f;
}

// The distance from the eye of a window depth.
[[nodiscard]] inline float distance_at(const EyeDistance& eye, float z) noexcept {
    return std::abs(eye.a + eye.b * z) / std::abs(eye.c + eye.d * z);
}

// The weights of a batch's fragments by a formula, which says whether alpha is a factor.
inline void weigh_by(const WeightFormula& formula, const EyeDistance& eye, const pipeline::Frame& frame,
                     const pipeline::FragmentBatch& in, pipeline::Lanes<float>& weights) noexcept {
    const bool reversed = is_reversed(frame);
    for (std::size_t i = 0; i < lanes(in); ++i)
        weights[i] = weight_by(formula, {.depth = depth_behind_near(reversed, in.shader_z[i]),
                                         .distance = distance_at(eye, window_z(frame, in.shader_z[i])),
                                         .alpha = in.color[3][i]});
}

// The weights of a batch's fragments, multiplied by alpha except for Weight::constant and a formula.
inline void weigh(const ListingInputs& inputs, const pipeline::Frame& frame, const pipeline::FragmentBatch& in,
                  pipeline::Lanes<float>& weights) noexcept {
    if (const auto& formula = inputs.options.weight_formula) return weigh_by(*formula, inputs.eye, frame, in, weights);
    const Weight weight = inputs.options.weight;
    const bool reversed = is_reversed(frame);
    for (std::size_t i = 0; i < lanes(in); ++i) {
        const float z = weight == Weight::eq10 ? depth_behind_near(reversed, in.shader_z[i])
                                               : distance_at(inputs.eye, window_z(frame, in.shader_z[i]));
        const float w = weight_at(weight, z);
        weights[i] = weight == Weight::constant ? w : in.color[3][i] * w;
    }
}

// Resolves `count` lanes: sums of weighted colours, sums of weights, and the transmittance of all fragments over the
// background.
inline void resolve_weighted(const pipeline::ColorLanes& sums, const pipeline::Lanes<float>& weights,
                             const pipeline::Lanes<float>& through, const pipeline::ColorLanes& background,
                             pipeline::ColorLanes& out, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const float w = weights[i], t = through[i];
        const bool has = w > 0.0f;
        for (std::size_t c = 0; c < 3; ++c)
            out[c][i] =
                has ? scalar::average_over(scalar::OneAverage{}, sums[c][i], w, t, background[c][i]) : background[c][i];
        out[3][i] = has ? scalar::alpha_over(t, background[3][i]) : background[3][i];
    }
}

}  // namespace strict
}  // namespace strata::peeling
