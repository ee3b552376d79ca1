// pipeline/geforce3/texture_shader.h - the four texture shader stages of GeForce3: from interpolated coordinates to
// texture results, a culled fragment, or a replaced depth.
//
// Rule     TEXTURE_2D, TEXTURE_RECTANGLE: lookup at s/q, t/q; a depth texture compares r/q. PASS_THROUGH: s t r q
//          clamped to [0,1]; if the device's colours have 8 bits, X = floor(4096 x) and (X - (X >> 8)) >> 4 (fitted to
//          NV2A's capture Passthru: equal at all 65,536 pixels; floor(255 x) differs at 9,656). CULL_FRAGMENT: see
//          CullMode. DOT_PRODUCT: (s x + t y) + r z with (x, y, z) of the previous texture input, not divided by q;
//          _TEXTURE_2D, _TEXTURE_RECTANGLE look up at (dot of the stage before, own dot); _DEPTH_REPLACE: the stage's
//          depth is dot of the stage before / own dot, one division, floored or rounded like a depth write; outside the
//          depth range, which includes NaN and zero divisors, the fragment dies (with depth clamp it is clamped). A
//          HILO texel is (HI, LO, 1), signed (HI, LO, sqrt(1 - HI^2 - LO^2)); as a colour it is 0. A stage that is not
//          consistent is NONE: (0, 0, 0, 0).
// Source   NV_texture_shader 3.8.13; pipeline/reference/texture-shader.md 1 to 7; rasterizer/reference/chip-geometry.md
//          4. Binary32 in the written order is assumed.
// Tests    tests/pipeline/geforce3/texture_shader_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/formats/texture.h"
#include "pipeline/stages/target.h"
#include "pipeline/textures/depth_texels.h"
#include "pipeline/textures/shadow_compare.h"

namespace strata::pipeline {

// The operations of a stage, named as in NV_texture_shader. texture-shader.md 10 lists those that are not implemented.
enum class ShaderOp : std::uint8_t {
    none,
    texture_2d,
    texture_rectangle,
    pass_through,
    cull_fragment,
    dot_product,
    dot_product_texture_2d,
    dot_product_texture_rectangle,
    dot_product_depth_replace
};

// The test of a coordinate in CULL_FRAGMENT: the fragment dies if any of the four fails. 0 and -0 are not negative; NaN
// fails both modes.
enum class CullMode : std::uint8_t {
    // The default: passes if the coordinate is at least 0.
    gequal,
    // Passes if it is less than 0.
    less
};

// The mapping of an unsigned colour in a dot product: k / 255, or expanded to [-1, 1].
enum class DotMapping : std::uint8_t { unsigned_identity, expand_normal };

// The reference R of a depth comparison. GL drivers select the three-dimensional projective stage, which compares r /
// q; NV2A's two-dimensional stage compares 0 (texture-shader.md 2).
enum class CompareReference : std::uint8_t { r_over_q, zero };

// Two 16-bit components per texel (GL_HILO_NV, GL_SIGNED_HILO_NV): k / 65535, or two's complement k / 32768. Only
// nearest lookups.
struct HiloTexture {
    TextureTarget target = TextureTarget::two_d;
    int width = 1, height = 1;
    TextureWrap wrap_s = TextureWrap::repeat, wrap_t = TextureWrap::repeat;
    bool is_signed = false;
    std::vector<std::array<std::uint16_t, 2>> texels;
};

// At most one texture is set; none: an incomplete texture. `depth` is a target of the pass's region, `depth_image` a
// finished image.
struct BoundTexture {
    const Texture* color = nullptr;
    const HiloTexture* hilo = nullptr;
    const Image* depth_image = nullptr;
    Target depth{};
    bool eight_bit_depth = false;  // DepthTexels::is_eight_bit
    // For depth_image: row 0 is the last row of memory. For a target this follows from the frame.
    bool bottom_up = false;
    ShadowCompare compare{};  // for depth textures
    CompareReference reference = CompareReference::r_over_q;

    [[nodiscard]] bool is_depth() const noexcept { return depth_image != nullptr || depth.exists(); }
};

struct ShaderStage {
    ShaderOp op = ShaderOp::none;
    // PREVIOUS_TEXTURE_INPUT_NV: the index of an earlier stage whose texel a dot product uses.
    int previous = 0;
    std::array<CullMode, 4> cull{};
    DotMapping mapping = DotMapping::unsigned_identity;
    BoundTexture texture;
};
using ShaderStages = std::array<ShaderStage, rasterizer::texture_units>;
using ShaderOps = std::array<ShaderOp, rasterizer::texture_units>;

// The operations in effect: NONE for those that are not consistent (a texture that is missing or of another kind; a
// previous input that is not an earlier stage or has no texel; a dot product that is not continued by the next stage).
[[nodiscard]] ShaderOps consistent_operations(const ShaderStages& stages);
// True if a stage in effect replaces the fragment's depth.
[[nodiscard]] bool replaces_depth(const ShaderOps& ops) noexcept;
// The coordinates that the operations read, as FragmentNeeds::units.
[[nodiscard]] rasterizer::UnitMask coordinates_of(const ShaderStages& stages, const ShaderOps& ops) noexcept;

// The state that all fragments of a pass share.
struct ShaderDevice {
    const DeviceProfile* profile = nullptr;
    // The buffer that receives a replaced depth; its format is used.
    rasterizer::DepthRequest depth;
    float depth_near = 0.0f, depth_far = 1.0f;  // glDepthRange
    bool depth_clamp = false;
    std::array<DepthTexels, rasterizer::texture_units> texels;  // for stages with depth textures
};

// The results that a stage passes to later ones.
struct StageResult {
    // The texture's colour, for the combiners.
    ColorLanes rgba;
    // The texel as operand of a later stage's dot product, before DotMapping.
    std::array<rasterizer::Lanes<float>, 3> xyz;
    rasterizer::Lanes<float> dot;
};

struct ShaderResults {
    std::array<StageResult, rasterizer::texture_units> stage;
    // ~0, or 0 where a stage killed the fragment.
    rasterizer::Lanes<std::uint32_t> alive;
    // The replaced depth's code, valid if replaces_depth is true and the fragment is alive.
    rasterizer::Lanes<std::uint32_t> code;
};

// Runs the stages on all fragments of a batch, including dead ones, whose results are unspecified. Throws NeedsFrame
// (depth_texels.h).
void run_texture_shader(const ShaderStages& stages, const ShaderOps& ops, const ShaderDevice& device,
                        const rasterizer::FragmentBatch& in, ShaderResults& out);

}  // namespace strata::pipeline
