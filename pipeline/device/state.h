// pipeline/device/state.h - the state of the per-fragment stages, in OpenGL's names. Plain values; nothing global.
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/base/vector.h"

namespace strata::pipeline {

enum class CompareFunc : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };

struct AlphaTest {  // passes if alpha FUNC ref; GL 2.1 4.1.4
    bool enabled = false;
    CompareFunc func = CompareFunc::always;
    float ref = 0.0f;
    friend bool operator==(const AlphaTest&, const AlphaTest&) = default;
};

enum class StencilOp : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };

struct
    StencilFace {  // passes if (ref & func_mask) FUNC (stored & func_mask): the reference is on the left; GL 2.1 4.1.5
    CompareFunc func = CompareFunc::always;
    std::uint8_t ref = 0, func_mask = 0xff, write_mask = 0xff;
    StencilOp fail = StencilOp::keep, depth_fail = StencilOp::keep, pass = StencilOp::keep;
    friend bool operator==(const StencilFace&, const StencilFace&) = default;
};

struct StencilTest {
    bool enabled = false;
    bool two_sided = false;  // EXT_stencil_two_side: `back` for back-facing fragments
    StencilFace front, back;
    friend bool operator==(const StencilTest&, const StencilTest&) = default;
};

struct DepthTest {  // off: no depth write either, and the stencil acts as if depth passed; GL 2.1 4.1.6
    bool enabled = false;
    CompareFunc func = CompareFunc::less;
    bool write = true;
    friend bool operator==(const DepthTest&, const DepthTest&) = default;
};

// The signed ones read the source byte as two's complement and ignore both factors: d + s', d - s'. NV2A alone
// (fragment-stages.md 8.3); OpenGL has no such equations.
enum class BlendEquation : std::uint8_t {
    add,
    subtract,
    reverse_subtract,
    min,
    max,
    signed_add,
    signed_reverse_subtract
};

enum class BlendFactor : std::uint8_t {
    zero,
    one,
    src_color,
    one_minus_src_color,
    dst_color,
    one_minus_dst_color,
    src_alpha,
    one_minus_src_alpha,
    dst_alpha,
    one_minus_dst_alpha,
    constant_color,
    one_minus_constant_color,
    constant_alpha,
    one_minus_constant_alpha,
    src_alpha_saturate
};

struct BlendTerm {  // for r, g, b or for alpha
    BlendEquation equation = BlendEquation::add;
    BlendFactor src = BlendFactor::one, dst = BlendFactor::zero;
    friend bool operator==(const BlendTerm&, const BlendTerm&) = default;
};

struct Blend {
    bool enabled = false;
    BlendTerm color, alpha;
    Rgba constant{0, 0, 0, 0};
    std::uint8_t write_mask = 0xf;  // bit 0 r, 1 g, 2 b, 3 a
    friend bool operator==(const Blend&, const Blend&) = default;
};

// The blend states that papers name.
namespace blend_mode {
inline constexpr Blend replace{};
// glBlendFunc(SRC_ALPHA, ONE_MINUS_SRC_ALPHA): back to front, straight source.
inline constexpr Blend over{.enabled = true,
                            .color = {BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha},
                            .alpha = {BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha}};
// glBlendFuncSeparate(DST_ALPHA, ONE, ZERO, ONE_MINUS_SRC_ALPHA): front to back, premultiplied source, alpha = transmittance.
inline constexpr Blend under{.enabled = true,
                             .color = {BlendEquation::add, BlendFactor::dst_alpha, BlendFactor::one},
                             .alpha = {BlendEquation::add, BlendFactor::zero, BlendFactor::one_minus_src_alpha}};
inline constexpr Blend sum{.enabled = true,
                           .color = {BlendEquation::add, BlendFactor::one, BlendFactor::one},
                           .alpha = {BlendEquation::add, BlendFactor::one, BlendFactor::one}};
inline constexpr Blend max{.enabled = true,
                           .color = {BlendEquation::max, BlendFactor::one, BlendFactor::one},
                           .alpha = {BlendEquation::max, BlendFactor::one, BlendFactor::one}};
}  // namespace blend_mode

}  // namespace strata::pipeline
