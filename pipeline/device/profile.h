// pipeline/device/profile.h - the features and numeric rules of an emulated device. A value: it can be compared,
// printed and stored as JSON.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/format.h"
#include "rasterizer/rules/raster_state.h"
#include "rasterizer/rules/rules.h"

namespace strata::pipeline {

// The alpha test compares 8-bit codes always, or only on 8-bit targets (pipeline/reference/fragment-stages.md 3).
enum class AlphaTestPrecision : std::uint8_t { unorm8, by_target };
// The rounding of an 8-bit blend (fragment-stages.md 8.2). nearest: the exact sum, half up. truncate: the exact sum,
// truncated. each_product: each product separately. unrounded_source: everything in binary32, with a source that is not
// rounded to a code.
enum class BlendRounding : std::uint8_t { nearest, truncate, each_product, unrounded_source };
// The destination of a blend: the target's codes, or binary32 values in a cache of tiles, which are rounded when a tile
// leaves the cache or the pass ends (fragment-stages.md 9.5).
enum class BlendStorage : std::uint8_t { target, cached_tiles };
// The result of MIN and MAX of one NaN and one number; destination: also of two equal operands (fragment-stages.md
// 9.3).
enum class MinMaxNan : std::uint8_t { other_operand, propagate, destination };
// Whether binary32 blending flushes operands and results below 2^-126 to zero (fragment-stages.md 9.1).
enum class DenormalRule : std::uint8_t { flush, keep };
// The contents of 24-bit depth buffers: 24-bit codes, or the binary32 of a D32F buffer (rasterizer/reference/depth.md
// 2.10).
enum class Depth24 : std::uint8_t { codes, binary32 };
// The result of a filtered lookup: a multiple of 1/255, or binary32; or texels mixed by linear interpolations, as codes
// or in binary32 (pipeline/reference/texturing.md 3). It also affects nearest lookups and pass-through coordinates
// (devices.md 4).
enum class TextureFilterPrecision : std::uint8_t { unorm8, single, code_lerps, code_lerps_fused, single_lerps };
// How fog is computed: OpenGL's formulas in binary32, or NV2A's registers and tables of bytes (fog-and-lighting.md 1
// and 2).
enum class FogRule : std::uint8_t { single, bytes };
// How vertices are lit and a secondary colour is added: OpenGL's formulas in binary32, or NV2A's unit of 22-bit floats
// and sums of bytes (lighting.md).
enum class LightingRule : std::uint8_t { single, float22 };
// The corner of the image at which memory begins: upper_left as in Direct3D and under glClipControl(GL_UPPER_LEFT);
// lower_left as OpenGL draws into framebuffer objects without that call. All rules apply in memory order (devices.md
// 3.8); output images have the upper row first.
enum class Origin : std::uint8_t { upper_left, lower_left };

// The sample positions within a pixel: as in Direct3D; or as NV20's modes are named, a corner and the centre, or a
// square (fragment-stages.md 13.1).
enum class SamplePositions : std::uint8_t { standard, nv20 };
// The samples whose first one is the centroid of a pixel that a triangle covers in part: those that it covers, or those
// of them that pass the depth test (fragment-stages.md 13.7).
enum class CentroidSamples : std::uint8_t { covered, passing };
// How a share of n samples becomes a number of samples (fragment-stages.md 13.6).
enum class ShareRounding : std::uint8_t { nearest, up, down };

// A device. Everything that differs between devices is a field, and no code depends on the name (devices.md 1);
// profile.cpp defines the built-in ones.
struct DeviceProfile {
    // In JSON the name has at most 64 bytes, the description at most 1000 (devices.md 1).
    std::string name;
    std::string description;
    rasterizer::RasterRules raster;
    Origin origin = Origin::upper_left;
    // The convention of frames whose caller states none (devices.md 3.9); a RasterState has the one in effect.
    rasterizer::ClipDepth clip_depth = rasterizer::ClipDepth::minus_one_to_one;
    rasterizer::DepthOrder depth_order = rasterizer::DepthOrder::less;

    // Stages
    AlphaTestPrecision alpha_test = AlphaTestPrecision::by_target;
    BlendRounding blend_rounding = BlendRounding::nearest;
    BlendStorage blend_storage = BlendStorage::target;
    HalfRounding half_rounding = HalfRounding::nearest_even;
    UnormRounding unorm_rounding = UnormRounding::half_up;
    MinMaxNan min_max_nan = MinMaxNan::other_operand;
    DenormalRule denormals = DenormalRule::flush;
    TextureFilterPrecision texture_filter = TextureFilterPrecision::single;
    Depth24 depth24 = Depth24::codes;
    FogRule fog = FogRule::single;
    LightingRule lighting = LightingRule::single;

    // Formats
    bool has_d16 = false, has_d24 = true, has_d32f = false;
    // 4 bits of exponent and 12 of mantissa, as stored by NV2A (depth.md 1.2).
    bool has_d16f = false;
    // 8 bits of exponent and 16 of mantissa (depth.md 1.3).
    bool has_d24f = false;
    // x8r8g8b8, x1a7r8g8b8, r5g6b5 and x1r5g5b5 (narrow.h).
    bool has_narrow_surfaces = false;
    // fp16 and binary32 render targets with blending, including RG32F and R16F.
    bool has_float_targets = false;
    // NV_depth_buffer_float: a D32F clear is stored unclamped.
    bool has_unclamped_depth_clear = false;

    // Features
    // ARB_fragment_program, with discard after a compare.
    bool has_fragment_programs = false;
    // EXT_blend_func_separate, EXT_blend_equation_separate.
    bool has_separate_alpha_blend = false;
    // ARB_draw_buffers_blend: separate equation and factors for each target.
    bool has_independent_blend = false;
    // EXT_stencil_two_side.
    bool has_two_sided_stencil = false;
    // ARB_depth_clamp, NV_depth_clamp.
    bool has_depth_clamp = false;
    // NV_texture_shader's DOT_PRODUCT_DEPTH_REPLACE, and with it texture shaders in general (devices.md 6).
    bool has_depth_replace = false;
    // STRATA_depth_units: an emulator extension, reported whenever it is used.
    bool has_sequential_depth_units = true;
    // STRATA_ordered_rmw: targets that a program both reads and writes.
    bool has_ordered_rmw = false;
    // ARB_shader_image_load_store, ARB_shader_storage_buffer_object: a program reads and writes buffers, and changes
    // them atomically.
    bool has_unordered_access = false;
    // Signed add and signed reverse subtract, on 8-bit targets (fragment-stages.md 8.3).
    bool has_signed_blend = false;
    // Logical operations in place of blending (fragment-stages.md 8.6).
    bool has_logic_op = true;
    SamplePositions sample_positions = SamplePositions::standard;
    ResolveRule resolve = ResolveRule::codes_half_up;
    ShareRounding alpha_to_coverage = ShareRounding::nearest;
    ShareRounding sample_coverage = ShareRounding::nearest;
    CentroidSamples centroid = CentroidSamples::covered;
    // Limits (devices.md 7): colour targets per pass, texture units, the viewport's larger side in pixels, samples per
    // pixel, and the smallest supported number of samples above 1.
    int max_render_targets = 1;
    int max_texture_units = 4;
    int max_viewport_px = 4096;
    int max_samples = 1;
    int min_samples = 2;
    friend bool operator==(const DeviceProfile&, const DeviceProfile&) = default;

    [[nodiscard]] ColorRounding color_rounding() const noexcept { return {half_rounding, unorm_rounding}; }
    // True if targets follow the rules that kernels outside the stages implement: 8-bit codes round the exact value
    // once, and halves have an infinity.
    [[nodiscard]] bool rounds_codes_once() const noexcept {
        return unorm_rounding == UnormRounding::half_up && half_rounding != HalfRounding::no_infinity &&
               (blend_rounding == BlendRounding::nearest || blend_rounding == BlendRounding::truncate) &&
               blend_storage == BlendStorage::target;
    }

    // The format in which a depth buffer of that format is stored.
    [[nodiscard]] DepthFormat stored(DepthFormat f) const noexcept {
        return f == DepthFormat::d24 && has_d24 && depth24 == Depth24::binary32 ? DepthFormat::d32f : f;
    }
    // The same for the requested format, or for the best one if none is requested.
    [[nodiscard]] DepthFormat depth_buffer(std::optional<DepthFormat> requested) const noexcept {
        return stored(requested.value_or(has_d32f ? DepthFormat::d32f : DepthFormat::d24));
    }
    // True if the device has depth buffers of that format; d24s8 is a d24 with a separate stencil.
    [[nodiscard]] bool has_depth(DepthFormat f) const noexcept {
        switch (f) {
            case DepthFormat::d16: return has_d16;
            case DepthFormat::d24: return has_d24;
            case DepthFormat::d32f: return has_d32f;
            case DepthFormat::d16f: return has_d16f;
            case DepthFormat::d24f: break;
        }
        return has_d24f;
    }
};

// In the order geforce3, geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader, direct3d11.
[[nodiscard]] const std::vector<DeviceProfile>& builtin_profiles();

// The same device drawing from another corner: its tie rule is unchanged in the image and therefore inverted in memory,
// unless raster.y_axis is clip.
[[nodiscard]] DeviceProfile with_origin(DeviceProfile profile, Origin origin);

// Null if there is no profile of that name.
[[nodiscard]] const DeviceProfile* find_profile(std::string_view name);

// One field of a profile for display: JSON key, value as text, source with the mark S, M or A of devices.md.
struct ProfileEntry {
    std::string key, value, source;
};
[[nodiscard]] std::vector<ProfileEntry> describe(const DeviceProfile& profile);

}  // namespace strata::pipeline
