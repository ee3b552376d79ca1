// pipeline/textures/shadow_compare.h - depth textures compared with a coordinate: ARB_shadow, SGIX_shadow,
// ARB_shadow_ambient.
//
// Rule     A texel passes if R FUNC D: LEQUAL is R <= D, as ARB_shadow says and all hardware does, although
//          SGIX_shadow's text reverses the operands. D16, D24, D16F and 8-bit texels: R is clamped to the depth range
//          and quantized exactly like a depth write (with quantize_reference false it is compared unquantized). R is in
//          [0,1], or in buffer units (0..2^n - 1, D16F: 0..511.9375) on devices whose vertex depth is. D32F: floats are
//          compared without a clamp; NaN passes only `notequal` and `always`. Linear: each of four texels gives 1 or
//          the fail value, then the bilinear sum of texel_address.h with 8-bit fractions.
// Source   pipeline/reference/texturing.md 4; measured on NV2A (R truncated like a depth write, 192 of 192 captures).
//          The linear filter is an assumption.
// Tests    tests/pipeline/textures/shadow_compare_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "pipeline/formats/texture.h"
#include "pipeline/textures/depth_texels.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// The channels that receive the result r: luminance (r,r,r,1), also SGIX_shadow's result; intensity (r,r,r,r); alpha
// (0,0,0,r), which NV_texture_shader expands to (1,1,1,r) instead.
enum class DepthTextureMode : std::uint8_t { luminance, intensity, alpha, texture_shader_alpha };

struct ShadowCompare {
    CompareFunc func = CompareFunc::lequal;
    DepthTextureMode mode = DepthTextureMode::luminance;
    float fail_value = 0.0f;  // TEXTURE_COMPARE_FAIL_VALUE_ARB, in [0,1]
    TextureTarget target = TextureTarget::two_d;
    TextureFilter filter = TextureFilter::nearest;
    TextureWrap wrap_s = TextureWrap::clamp_to_edge, wrap_t = TextureWrap::clamp_to_edge;
    friend bool operator==(const ShadowCompare&, const ShadowCompare&) = default;
};

// The coordinates of a lookup (s, t) and the compared value r, all already divided by q.
struct ShadowCoordinates {
    const rasterizer::Lanes<float>&s, &t, &r;
};

// A depth image must have one sample. The profile determines the rounding of R (like a depth write) and the snapping of
// nearest lookups. Throws NeedsFrame.
void shadow_compare(const DepthTexels& depth, const ShadowCompare& state, const DeviceProfile& profile,
                    const ShadowCoordinates& at, std::array<rasterizer::Lanes<float>, 4>& rgba, int count);
inline void shadow_compare(const Image& depth, const ShadowCompare& state, const DeviceProfile& profile,
                           const ShadowCoordinates& at, std::array<rasterizer::Lanes<float>, 4>& rgba, int count) {
    shadow_compare(DepthTexels{depth}, state, profile, at, rgba, count);
}

}  // namespace strata::pipeline
