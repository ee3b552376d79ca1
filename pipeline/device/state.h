// pipeline/device/state.h - the state of the per-fragment stages, in OpenGL's names. Plain values; nothing global.
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/base/vector.h"

namespace strata::pipeline {

// GL 2.1 4.1.4. Which operand stands on the left differs from stage
// to stage: alpha, the stencil reference, the fragment's depth.
enum class CompareFunc : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };

// The fragment lives if alpha FUNC ref; GL 2.1 4.1.4.
struct AlphaTest {
    bool enabled = false;
    CompareFunc func = CompareFunc::always;
    float ref = 0.0f;
    friend bool operator==(const AlphaTest&, const AlphaTest&) = default;
};

// Operations on the stored 8 bits: incr and decr stop at 255
// and 0, the wrapping ones go around (fragment-stages.md 5).
enum class StencilOp : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };

// The test passes if (ref & func_mask) FUNC (stored & func_mask): the reference is on the left; GL 2.1 4.1.5. What
// happens to the stored value then depends on the depth test, too: fail, depth_fail or pass.
struct StencilFace {
    CompareFunc func = CompareFunc::always;
    std::uint8_t ref = 0, func_mask = 0xff, write_mask = 0xff;
    StencilOp fail = StencilOp::keep, depth_fail = StencilOp::keep, pass = StencilOp::keep;
    friend bool operator==(const StencilFace&, const StencilFace&) = default;
};

struct StencilTest {
    bool enabled = false;
    // EXT_stencil_two_side: `back` is for back-facing fragments; else `front` is for all.
    bool two_sided = false;
    StencilFace front, back;
    friend bool operator==(const StencilTest&, const StencilTest&) = default;
};

// The fragment lives if its code FUNC the stored one. Off: nothing is
// written either, and the stencil acts as if depth had passed; GL 2.1 4.1.6.
struct DepthTest {
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

// GL 2.1 table 4.1. What each means for colours and for alpha: fragment-stages.md 8.1.
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

// One for r, g, b and one for alpha: source * src (equation) destination * dst.
struct BlendTerm {
    BlendEquation equation = BlendEquation::add;
    BlendFactor src = BlendFactor::one, dst = BlendFactor::zero;
    friend bool operator==(const BlendTerm&, const BlendTerm&) = default;
};

// The blending of one target. Off: the source is stored as it is; the mask counts all the same.
struct Blend {
    bool enabled = false;
    BlendTerm color, alpha;
    Rgba constant{0, 0, 0, 0};
    // Bit 0 lets r through, 1 g, 2 b, 3 a.
    std::uint8_t write_mask = 0xf;
    friend bool operator==(const Blend&, const Blend&) = default;
};

// The blend states that papers name.
namespace blend_mode {
inline constexpr Blend replace{};
// glBlendFunc(SRC_ALPHA, ONE_MINUS_SRC_ALPHA): back to front, straight source.
inline constexpr Blend over{.enabled = true,
                            .color = {BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha},
                            .alpha = {BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha}};
// glBlendFuncSeparate(DST_ALPHA, ONE, ZERO, ONE_MINUS_SRC_ALPHA): front to back, premultiplied source, alpha =
// transmittance.
inline constexpr Blend under{.enabled = true,
                             .color = {BlendEquation::add, BlendFactor::dst_alpha, BlendFactor::one},
                             .alpha = {BlendEquation::add, BlendFactor::zero, BlendFactor::one_minus_src_alpha}};
// glBlendFunc(ONE, ONE): sums and counts.
inline constexpr Blend sum{.enabled = true,
                           .color = {BlendEquation::add, BlendFactor::one, BlendFactor::one},
                           .alpha = {BlendEquation::add, BlendFactor::one, BlendFactor::one}};
// GL_MAX; it ignores the factors.
inline constexpr Blend max{.enabled = true,
                           .color = {BlendEquation::max, BlendFactor::one, BlendFactor::one},
                           .alpha = {BlendEquation::max, BlendFactor::one, BlendFactor::one}};
}  // namespace blend_mode

}  // namespace strata::pipeline
