// tests/pipeline/blend_model.h - random blend states, and the expected result of one fragment on an 8-bit target in
// integers, written from GL 2.1 4.1.8 and pipeline/reference/fragment-stages.md 8.1 and 8.2. blend_float_test.cpp has
// the float counterpart.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "pipeline/stages/blend.h"
#include "tests/pipeline/format_models.h"
#include "tests/pipeline/stage_values.h"

namespace strata::pipeline {

using Codes = std::array<rasterizer::Lanes<std::uint32_t>, 4>;
using Colors = std::array<rasterizer::Lanes<float>, 4>;

// Half of the states are modes that the papers use.
[[nodiscard]] inline BlendTerm any_term(Random& random) {
    using enum BlendFactor;
    using enum BlendEquation;
    constexpr std::array known{BlendTerm{add, src_alpha, one_minus_src_alpha}, BlendTerm{add, dst_alpha, one},
                               BlendTerm{add, zero, one_minus_src_alpha},      BlendTerm{add, one, one},
                               BlendTerm{add, one, one_minus_src_alpha},       BlendTerm{max, one, one}};
    if (one_in(random, 2)) return known[below(random, static_cast<std::uint32_t>(known.size()))];
    return {any_of(random, max), any_of(random, src_alpha_saturate), any_of(random, src_alpha_saturate)};
}

[[nodiscard]] inline Blend any_blend(Random& random) {
    Blend state{!one_in(random, 8), any_term(random), any_term(random), {}, 0xf};
    if (one_in(random, 2)) state.alpha = state.color;
    if (one_in(random, 4)) state.write_mask = static_cast<std::uint8_t>(below(random, 16));
    for (float& c : strata::components(state.constant)) c = any_float(random);
    return state;
}

[[nodiscard]] inline std::string words(const Blend& state) {
    const auto term = [](const BlendTerm& t) {
        return fmt::format("({} {} {})", static_cast<int>(t.equation), static_cast<int>(t.src),
                           static_cast<int>(t.dst));
    };
    return fmt::format("color {} alpha {} mask {:x}", term(state.color), term(state.alpha), state.write_mask);
}

// Colours of one fragment, channels r g b a.
template <class T>
struct Fragment {
    std::array<T, 4> source, stored, constant;
};

// The factor of channel c. one: the number that represents 1. complement(x): 1 - x. lesser(a, b): the smaller of both.
template <class T>
[[nodiscard]] T model_factor(BlendFactor factor, const Fragment<T>& f, std::size_t c, T one, auto complement,
                             auto lesser) {
    switch (factor) {
        case BlendFactor::zero: return T{0};
        case BlendFactor::one: return one;
        case BlendFactor::src_color: return f.source[c];
        case BlendFactor::one_minus_src_color: return complement(f.source[c]);
        case BlendFactor::dst_color: return f.stored[c];
        case BlendFactor::one_minus_dst_color: return complement(f.stored[c]);
        case BlendFactor::src_alpha: return f.source[3];
        case BlendFactor::one_minus_src_alpha: return complement(f.source[3]);
        case BlendFactor::dst_alpha: return f.stored[3];
        case BlendFactor::one_minus_dst_alpha: return complement(f.stored[3]);
        case BlendFactor::constant_color: return f.constant[c];
        case BlendFactor::one_minus_constant_color: return complement(f.constant[c]);
        case BlendFactor::constant_alpha: return f.constant[3];
        case BlendFactor::one_minus_constant_alpha: return complement(f.constant[3]);
        case BlendFactor::src_alpha_saturate: return c == 3 ? one : lesser(f.source[3], complement(f.stored[3]));
    }
    return T{0};
}

// Expected code of channel c of an 8-bit target; all inputs are codes.
[[nodiscard]] inline int model_unorm8(const Blend& state, BlendRounding rounding, const Fragment<int>& f,
                                      std::size_t c) {
    if (!state.enabled) return f.source[c];
    const BlendTerm& term = c == 3 ? state.alpha : state.color;
    const auto complement = [](int x) { return 255 - x; };
    const auto lesser = [](int a, int b) { return a < b ? a : b; };
    const int source = f.source[c] * model_factor(term.src, f, c, 255, complement, lesser);
    const int stored = f.stored[c] * model_factor(term.dst, f, c, 255, complement, lesser);
    int sum = 0;  // in units of 1/255^2
    switch (term.equation) {
        case BlendEquation::add: sum = source + stored; break;
        case BlendEquation::subtract: sum = source - stored; break;
        case BlendEquation::reverse_subtract: sum = stored - source; break;
        case BlendEquation::min: return std::min(f.source[c], f.stored[c]);
        case BlendEquation::max: return std::max(f.source[c], f.stored[c]);
        case BlendEquation::signed_add: return std::clamp(f.stored[c] + static_cast<std::int8_t>(f.source[c]), 0, 255);
        case BlendEquation::signed_reverse_subtract:
            return std::clamp(f.stored[c] - static_cast<std::int8_t>(f.source[c]), 0, 255);
    }
    sum = std::clamp(sum, 0, 255 * 255);
    return rounding == BlendRounding::nearest ? (2 * sum + 255) / 510 : sum / 255;
}

}  // namespace strata::pipeline
