// pipeline/device/state.h - the state of the per-fragment stages with OpenGL's names, as plain values without globals.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "pipeline/formats/logic_op.h"
#include "rasterizer/base/vector.h"

namespace strata::pipeline {

// GL 2.1 4.1.4. The left operand depends on the stage: alpha, the stencil reference, the fragment's depth.
enum class CompareFunc : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };

// A fragment passes if alpha FUNC ref (GL 2.1 4.1.4).
struct AlphaTest {
    bool enabled = false;
    CompareFunc func = CompareFunc::always;
    float ref = 0.0f;
    friend bool operator==(const AlphaTest&, const AlphaTest&) = default;
};

// Operations on the stored 8 bits: incr and decr saturate at 255 and 0, the _wrap variants wrap around
// (pipeline/reference/fragment-stages.md 5).
enum class StencilOp : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };

// The test passes if (ref & func_mask) FUNC (stored & func_mask), the reference on the left (GL 2.1 4.1.5). The stored
// value is then changed by fail, depth_fail or pass, depending also on the depth test.
struct StencilFace {
    CompareFunc func = CompareFunc::always;
    std::uint8_t ref = 0, func_mask = 0xff, write_mask = 0xff;
    StencilOp fail = StencilOp::keep, depth_fail = StencilOp::keep, pass = StencilOp::keep;
    friend bool operator==(const StencilFace&, const StencilFace&) = default;
};

struct StencilTest {
    bool enabled = false;
    // EXT_stencil_two_side: true: `back` applies to back-facing fragments; false: `front` applies to all.
    bool two_sided = false;
    StencilFace front, back;
    friend bool operator==(const StencilTest&, const StencilTest&) = default;
};

// A fragment passes if its code FUNC the stored one. If disabled, nothing is written either, and the stencil acts as if
// depth had passed (GL 2.1 4.1.6).
struct DepthTest {
    bool enabled = false;
    CompareFunc func = CompareFunc::less;
    bool write = true;
    friend bool operator==(const DepthTest&, const DepthTest&) = default;
};

// The signed equations interpret the source byte as two's complement and ignore both factors: d + s', d - s'. Only NV2A
// has them (fragment-stages.md 8.3); OpenGL does not.
enum class BlendEquation : std::uint8_t {
    add,
    subtract,
    reverse_subtract,
    min,
    max,
    signed_add,
    signed_reverse_subtract
};

// GL 2.1 table 4.1. The meaning for colours and for alpha is in fragment-stages.md 8.1.
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

// A term for r, g, b and one for alpha: source * src (equation) destination * dst.
struct BlendTerm {
    BlendEquation equation = BlendEquation::add;
    BlendFactor src = BlendFactor::one, dst = BlendFactor::zero;
    friend bool operator==(const BlendTerm&, const BlendTerm&) = default;
};

// The blending of one target. If disabled, the source is stored unchanged; the write mask still applies. A logical
// operation disables blending, and replaces it where codes are fixed-point and not sRGB; all targets of a pass have the
// same.
struct Blend {
    bool enabled = false;
    BlendTerm color, alpha;
    Rgba constant{0, 0, 0, 0};
    // Bit 0 enables r, 1 g, 2 b, 3 a.
    std::uint8_t write_mask = 0xf;
    std::optional<LogicOp> logic_op{};
    bool dither = false;  // dither.h
    [[nodiscard]] constexpr bool blends() const noexcept { return enabled && !logic_op; }
    // True if the result depends on the stored code.
    [[nodiscard]] constexpr bool reads_target() const noexcept { return logic_op ? reads_stored(*logic_op) : enabled; }
    friend bool operator==(const Blend&, const Blend&) = default;
};

// The blend states named in papers.
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
// GL_MAX; the factors are ignored.
inline constexpr Blend max{.enabled = true,
                           .color = {BlendEquation::max, BlendFactor::one, BlendFactor::one},
                           .alpha = {BlendEquation::max, BlendFactor::one, BlendFactor::one}};
}  // namespace blend_mode

}  // namespace strata::pipeline
