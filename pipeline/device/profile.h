// pipeline/device/profile.h - what an emulated device can do, and with which numbers. A value: compare it, print it, store it as JSON.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/formats/format.h"
#include "pipeline/formats/half.h"
#include "rasterizer/rules/rules.h"

namespace strata::pipeline {

enum class AlphaTestPrecision : std::uint8_t {
    unorm8,
    by_target
};  // 8-bit compare always, or binary32 on float targets
enum class BlendRounding : std::uint8_t {
    nearest,
    truncate
};  // UNORM8: one rounding of the exact sum, half up, or cut
enum class MinMaxNan : std::uint8_t { other_operand, propagate };     // one NaN operand of MIN / MAX
enum class DenormalRule : std::uint8_t { flush, keep };               // binary32 blending
enum class TextureFilterPrecision : std::uint8_t { unorm8, single };  // result of a bilinear lookup

struct DeviceProfile {
    std::string name;
    std::string description;
    rasterizer::RasterRules raster;

    // Stages
    AlphaTestPrecision alpha_test = AlphaTestPrecision::by_target;
    BlendRounding blend_rounding = BlendRounding::nearest;
    HalfRounding half_rounding = HalfRounding::nearest_even;
    MinMaxNan min_max_nan = MinMaxNan::other_operand;
    DenormalRule denormals = DenormalRule::flush;
    TextureFilterPrecision texture_filter = TextureFilterPrecision::single;

    // Formats
    bool has_d16 = false, has_d24 = true, has_d32f = false;
    bool has_d16f = false;                   // 4 bits of exponent, 12 of mantissa
    bool has_narrow_surfaces = false;        // x8r8g8b8, x1a7r8g8b8, r5g6b5 and x1r5g5b5 (narrow.h)
    bool has_float_targets = false;          // fp16 and fp32 render targets that blend, RG32F and R16F among them
    bool has_unclamped_depth_clear = false;  // NV_depth_buffer_float

    // Features
    bool has_fragment_programs = false;      // ARB_fragment_program, with discard after a compare
    bool has_separate_alpha_blend = false;   // EXT_blend_func_separate, EXT_blend_equation_separate
    bool has_independent_blend = false;      // ARB_draw_buffers_blend
    bool has_two_sided_stencil = false;      // EXT_stencil_two_side
    bool has_depth_clamp = false;            // ARB_depth_clamp, NV_depth_clamp
    bool has_depth_replace = false;          // NV_texture_shader: DOT_PRODUCT_DEPTH_REPLACE
    bool has_sequential_depth_units = true;  // STRATA_depth_units: an emulator extension, reported when used
    bool has_ordered_rmw = false;            // STRATA_ordered_rmw: targets that a program reads and writes
    bool has_signed_blend = false;           // signed add and signed reverse subtract, on 8-bit targets
    int max_render_targets = 1;
    int max_texture_units = 4;
    int max_viewport_px = 4096;
    int max_samples = 1;
    friend bool operator==(const DeviceProfile&, const DeviceProfile&) = default;

    [[nodiscard]] bool has_depth(DepthFormat f) const noexcept {
        switch (f) {
            case DepthFormat::d16: return has_d16;
            case DepthFormat::d24: return has_d24;
            case DepthFormat::d32f: return has_d32f;
            case DepthFormat::d16f: return has_d16f;
        }
        return false;  // unreachable: the enum is closed
    }
};

// geforce3, geforce8, geforce8_dx101, ideal, llvmpipe; in that order.
[[nodiscard]] const std::vector<DeviceProfile>& builtin_profiles();

// Null if there is no such name.
[[nodiscard]] const DeviceProfile* find_profile(std::string_view name);

// What a user may read beside a number: its JSON key, its value as text, its source with the mark S, M or A of devices.md.
struct ProfileEntry {
    std::string key, value, source;
};
[[nodiscard]] std::vector<ProfileEntry> describe(const DeviceProfile& profile);

}  // namespace strata::pipeline
