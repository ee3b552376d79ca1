// pipeline/stages/blend_kernels.h - one blend term over the lanes of one channel, for any arithmetic: Unorm8Arithmetic
// or FloatArithmetic. The terms named in papers have compile-time factors. Included only by blend_lanes.h.
#pragma once
#include <type_traits>

#include "pipeline/device/state.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {
inline namespace strict {

using ValueLanes = rasterizer::Lanes<float>;

// One channel of a batch. For the alpha channel s is src_alpha and d is dst_alpha.
struct BlendOperands {
    const ValueLanes& s;
    const ValueLanes& d;
    const ValueLanes& src_alpha;
    const ValueLanes& dst_alpha;
    float constant = 0, constant_alpha = 0;
    bool is_alpha = false;
};

// The factor of lane i, by the table of pipeline/reference/fragment-stages.md 8.1. `s` and `d` are the channel's own
// values, so for alpha src_color means the alpha.
template <class Arithmetic, BlendFactor f>
[[nodiscard]] inline float factor(const BlendOperands& in, std::size_t i) noexcept {
    using enum BlendFactor;
    if constexpr (f == zero) return Arithmetic::zero;
    if constexpr (f == one) return Arithmetic::one;
    if constexpr (f == src_color) return in.s[i];
    if constexpr (f == one_minus_src_color) return Arithmetic::one_minus(in.s[i]);
    if constexpr (f == dst_color) return in.d[i];
    if constexpr (f == one_minus_dst_color) return Arithmetic::one_minus(in.d[i]);
    if constexpr (f == src_alpha) return in.src_alpha[i];
    if constexpr (f == one_minus_src_alpha) return Arithmetic::one_minus(in.src_alpha[i]);
    if constexpr (f == dst_alpha) return in.dst_alpha[i];
    if constexpr (f == one_minus_dst_alpha) return Arithmetic::one_minus(in.dst_alpha[i]);
    if constexpr (f == constant_color) return in.constant;
    if constexpr (f == one_minus_constant_color) return Arithmetic::one_minus(in.constant);
    if constexpr (f == constant_alpha) return in.constant_alpha;
    if constexpr (f == one_minus_constant_alpha) return Arithmetic::one_minus(in.constant_alpha);
    // min(As, 1 - Ad), for colours; for alpha the factor is 1 (fill_factor).
    if constexpr (f == src_alpha_saturate)
        return Arithmetic::lesser(in.src_alpha[i], Arithmetic::one_minus(in.dst_alpha[i]));
}

// Calls body(std::integral_constant<BlendFactor, f>), so that the switch is outside the loop over lanes.
template <class Body>
void with_factor(BlendFactor f, Body&& body) {
    using enum BlendFactor;
    switch (f) {
        case zero: return body(std::integral_constant<BlendFactor, zero>{});
        case one: return body(std::integral_constant<BlendFactor, one>{});
        case src_color: return body(std::integral_constant<BlendFactor, src_color>{});
        case one_minus_src_color: return body(std::integral_constant<BlendFactor, one_minus_src_color>{});
        case dst_color: return body(std::integral_constant<BlendFactor, dst_color>{});
        case one_minus_dst_color: return body(std::integral_constant<BlendFactor, one_minus_dst_color>{});
        case src_alpha: return body(std::integral_constant<BlendFactor, src_alpha>{});
        case one_minus_src_alpha: return body(std::integral_constant<BlendFactor, one_minus_src_alpha>{});
        case dst_alpha: return body(std::integral_constant<BlendFactor, dst_alpha>{});
        case one_minus_dst_alpha: return body(std::integral_constant<BlendFactor, one_minus_dst_alpha>{});
        case constant_color: return body(std::integral_constant<BlendFactor, constant_color>{});
        case one_minus_constant_color: return body(std::integral_constant<BlendFactor, one_minus_constant_color>{});
        case constant_alpha: return body(std::integral_constant<BlendFactor, constant_alpha>{});
        case one_minus_constant_alpha: return body(std::integral_constant<BlendFactor, one_minus_constant_alpha>{});
        case src_alpha_saturate: return body(std::integral_constant<BlendFactor, src_alpha_saturate>{});
    }
}

// Calls body with the equation as a type, also before the loop over lanes.
template <class Body>
void with_equation(BlendEquation equation, Body&& body) {
    using enum BlendEquation;
    switch (equation) {
        case add: return body(std::integral_constant<BlendEquation, add>{});
        case subtract: return body(std::integral_constant<BlendEquation, subtract>{});
        case reverse_subtract: return body(std::integral_constant<BlendEquation, reverse_subtract>{});
        case min: return body(std::integral_constant<BlendEquation, min>{});
        case max: return body(std::integral_constant<BlendEquation, max>{});
        case signed_add: return body(std::integral_constant<BlendEquation, signed_add>{});
        case signed_reverse_subtract: return body(std::integral_constant<BlendEquation, signed_reverse_subtract>{});
    }
}

// Both factors are compile-time constants: one loop.
template <class Arithmetic, BlendEquation equation, BlendFactor src, BlendFactor dst>
void blend_fused(const BlendOperands& in, ValueLanes& out, std::size_t count) noexcept {
    constexpr bool keeps_s = src == BlendFactor::one, keeps_d = dst == BlendFactor::one;
    for (std::size_t i = 0; i < count; ++i)
        out[i] = Arithmetic::template combine<equation, keeps_s, keeps_d>(in.s[i], factor<Arithmetic, src>(in, i),
                                                                          in.d[i], factor<Arithmetic, dst>(in, i));
}

template <class Arithmetic>
void fill_factor(BlendFactor f, const BlendOperands& in, ValueLanes& out, std::size_t count) noexcept {
    // The factor is (f, f, f, 1): 1 for alpha.
    const bool is_one = f == BlendFactor::src_alpha_saturate && in.is_alpha;
    with_factor(is_one ? BlendFactor::one : f, [&](auto chosen) {
        for (std::size_t i = 0; i < count; ++i) out[i] = factor<Arithmetic, chosen()>(in, i);
    });
}

// Any term: factors first, then the equation. Rarely used and long, so there is one copy for all instruction sets.
template <class Arithmetic>
[[gnu::noinline]] void blend_general(const BlendTerm& term, const BlendOperands& in, ValueLanes& out,
                                     std::size_t count) noexcept {
    alignas(64) ValueLanes src, dst;
    fill_factor<Arithmetic>(term.src, in, src, count);
    fill_factor<Arithmetic>(term.dst, in, dst, count);
    with_equation(term.equation, [&](auto equation) {
        for (std::size_t i = 0; i < count; ++i)
            out[i] = Arithmetic::template combine<equation()>(in.s[i], src[i], in.d[i], dst[i]);
    });
}

// Selects the loop of a term, once per channel. MIN and MAX ignore their factors, so any pair may be used.
template <class Arithmetic>
void blend_channel(const BlendTerm& term, const BlendOperands& in, ValueLanes& out, std::size_t count) noexcept {
    using enum BlendEquation;
    using enum BlendFactor;
    const auto is = [&](BlendFactor src, BlendFactor dst) {
        return term.equation == add && term.src == src && term.dst == dst;
    };
    if (term.equation == min) return blend_fused<Arithmetic, min, one, one>(in, out, count);
    if (term.equation == max) return blend_fused<Arithmetic, max, one, one>(in, out, count);
    if (is(src_alpha, one_minus_src_alpha))  // OVER
        return blend_fused<Arithmetic, add, src_alpha, one_minus_src_alpha>(in, out, count);
    if (is(one, one_minus_src_alpha))  // OVER, premultiplied
        return blend_fused<Arithmetic, add, one, one_minus_src_alpha>(in, out, count);
    if (is(dst_alpha, one)) return blend_fused<Arithmetic, add, dst_alpha, one>(in, out, count);  // UNDER, colour
    if (is(zero, one_minus_src_alpha))  // UNDER, transmittance
        return blend_fused<Arithmetic, add, zero, one_minus_src_alpha>(in, out, count);
    if (is(one, one)) return blend_fused<Arithmetic, add, one, one>(in, out, count);  // sums
    blend_general<Arithmetic>(term, in, out, count);
}

}  // namespace strict
}  // namespace strata::pipeline
