// pipeline/device/profile.cpp - the built-in devices. The source of each value is in profile_fields.cpp; describe()
// prints it.
#include "pipeline/device/profile.h"

#include <algorithm>

#include "pipeline/device/profile_fields.h"

namespace strata::pipeline {
namespace {

using namespace rasterizer;

// Most rules are supported by captures of NV2A, a chip of this class. Fields that are not set here have the defaults of
// RasterRules (rasterizer/rules/rules.h).
DeviceProfile geforce3() {
    DeviceProfile p;
    p.name = "geforce3";
    p.description = "NV20 (2001): 8-bit targets, integer depth, one blend function; numbers from captures of an NV2A";
    p.raster = {.subpixel_bits = 4,
                .snap = Snap::toward_zero,
                .guard_band_px = 524288,
                .z_clip = ZClip::per_fragment,
                .w_signs = WSigns::by_corner,
                .w_divide = WDivide::reciprocal,
                .window_z = WindowZ::buffer_units,
                .depth_path = DepthPath::window_z,
                .depth_rounding = DepthRounding::floor,
                .offset_unit = OffsetUnit::buffer,
                .offset_rule = OffsetRule::fragments,
                .color = ColorInterpolation::weights_8bit,
                .lines = LineRule::band,
                .points = PointRule::reciprocal,
                .interpolation = {.vertex_color_bits = 14,
                                  .perspective_color = PerspectiveColor::cut_products,
                                  .texture_coordinates = CoordinateRule::cut_weights,
                                  .perspective_coordinates = PerspectiveCoordinates::cut_products}};
    p.alpha_test = AlphaTestPrecision::unorm8;
    p.texture_filter = TextureFilterPrecision::unorm8;
    p.fog = FogRule::bytes;
    p.lighting = LightingRule::float22;
    p.has_d16 = true;
    p.has_depth_clamp = true;
    p.has_signed_blend = true;
    p.has_d16f = true;
    p.has_d24f = true;
    p.has_narrow_surfaces = true;
    p.has_depth_replace = true;
    p.sample_positions = SamplePositions::nv20;
    p.max_samples = 4;
    return p;
}

// The defaults of RasterRules are those of this device.
DeviceProfile geforce8() {
    DeviceProfile p;
    p.name = "geforce8";
    p.description = "G80 (2006): Direct3D 10.0, float targets and depth, eight targets that share one blend equation";
    p.has_d32f = true;
    p.has_float_targets = true;
    p.has_unclamped_depth_clear = true;
    p.has_fragment_programs = true;
    p.has_separate_alpha_blend = true;
    p.has_two_sided_stencil = true;
    p.has_depth_clamp = true;
    p.max_render_targets = 8;
    p.max_texture_units = 16;
    p.max_viewport_px = 8192;
    p.max_samples = 8;
    p.raster.lines = LineRule::diamond_exit;
    p.raster.points = PointRule::square;
    return p;
}

DeviceProfile geforce8_dx101() {
    DeviceProfile p = geforce8();
    p.name = "geforce8_dx101";
    p.description = "GT215 (2009): geforce8 with Direct3D 10.1's independent blend equations";
    p.has_independent_blend = true;
    return p;
}

DeviceProfile ideal() {
    DeviceProfile p = geforce8_dx101();
    p.name = "ideal";
    p.description = "no device: every feature that an algorithm asks for, exact depth, denormals kept";
    p.raster.depth_path = DepthPath::exact;
    p.denormals = DenormalRule::keep;
    p.has_d16 = true;
    p.has_depth_replace = true;
    p.has_ordered_rmw = true;
    p.has_unordered_access = true;
    p.max_viewport_px = 16384;
    return p;
}

// Mesa's software rasterizers, for comparison with Mesa itself: the fields set here are measured
// (pipeline/reference/mesa-rasterizers.md).
DeviceProfile mesa() {
    DeviceProfile p = geforce8_dx101();
    p.raster.clip = ClipVolume::view_volume;
    p.raster.w_divide = WDivide::reciprocal;
    p.raster.plane_origin = PlaneOrigin::unsnapped;
    p.raster.perspective = PerspectiveDivide::reciprocal;
    p.raster.depth_rounding = DepthRounding::product_even;
    p.raster.offset_unit = OffsetUnit::two_codes;
    p.raster.lines = LineRule::shifted_ends;
    p.raster.points = PointRule::subpixel_square;
    p.half_rounding = HalfRounding::toward_zero;
    p.unorm_rounding = UnormRounding::product_even;
    p.blend_rounding = BlendRounding::each_product;
    p.has_d16 = true;
    p.max_texture_units = 32;
    p.max_viewport_px = 16384;
    p.max_samples = p.min_samples = 4;
    p.resolve = ResolveRule::single;
    p.alpha_to_coverage = ShareRounding::up;
    p.sample_coverage = ShareRounding::down;
    p.centroid = CentroidSamples::passing;
    return p;
}

DeviceProfile llvmpipe() {
    DeviceProfile p = mesa();
    p.name = "llvmpipe";
    p.description = "no device: Mesa 22.3's llvmpipe on a processor with fused multiply-add";
    p.raster.tie_rule = TieRule::bottom_left;
    p.texture_filter = TextureFilterPrecision::code_lerps_fused;
    p.raster.viewport = ViewportArithmetic::fused_given;
    p.raster.sample_divisor = SampleDivisor::centre;
    p.raster.plane_rule = PlaneRule::reciprocal_area_fused;
    p.has_unordered_access = true;
    return p;
}

DeviceProfile llvmpipe_sse() {
    DeviceProfile p = llvmpipe();
    p.name = "llvmpipe_sse";
    p.description = "no device: Mesa 22.3's llvmpipe on a processor without fused multiply-add";
    p.raster.viewport = ViewportArithmetic::separate;
    p.raster.plane_rule = PlaneRule::reciprocal_area;
    p.texture_filter = TextureFilterPrecision::code_lerps;
    return p;
}

DeviceProfile softpipe() {
    DeviceProfile p = mesa();
    p.name = "softpipe";
    p.description = "no device: Mesa 22.3's softpipe, whose blends round when a cached tile is put back";
    p.raster.coverage = CoverageRule::float_spans;
    p.raster.lines = LineRule::pixel_steps;
    p.raster.points = PointRule::two_triangles;
    p.raster.plane_rule = PlaneRule::least_corner;
    p.raster.perspective = PerspectiveDivide::quotient;
    p.raster.depth_rounding = DepthRounding::product_floor;
    p.raster.depth_limits = DepthLimits::wrap;
    p.blend_rounding = BlendRounding::nearest;
    p.blend_storage = BlendStorage::cached_tiles;
    p.min_max_nan = MinMaxNan::propagate;
    p.texture_filter = TextureFilterPrecision::single_lerps;
    p.max_samples = 1;
    return p;
}

// Chromium's WebGL without a GPU: the fields set here are measured (swiftshader-rasterizer.md).
DeviceProfile swiftshader() {
    DeviceProfile p = geforce8_dx101();
    p.name = "swiftshader";
    p.description = "no device: SwiftShader as headless Chromium 156 runs WebGL 2 on it";
    p.has_logic_op = false;
    p.raster = {.subpixel_bits = 4,
                .snap = Snap::nearest_even,
                .guard_band_px = 524288,
                .clip = ClipVolume::view_volume_depth_first,
                .w_divide = WDivide::reciprocal,
                .viewport = ViewportArithmetic::half_pixel_first,
                .y_axis = YAxis::clip,
                .area_sign = AreaSign::single,
                .plane_rule = PlaneRule::greatest_w,
                .plane_corners = PlaneCorners::given,
                .perspective = PerspectiveDivide::reciprocal,
                .depth_rounding = DepthRounding::product_even,
                .depth_limits = DepthLimits::zero_to_one,
                .offset_unit = OffsetUnit::differences};
    p.blend_rounding = BlendRounding::unrounded_source;
    p.half_rounding = HalfRounding::no_infinity;
    p.unorm_rounding = UnormRounding::product_even_wide;
    p.min_max_nan = MinMaxNan::destination;
    p.depth24 = Depth24::binary32;
    p.has_d16 = true;
    p.has_unclamped_depth_clear = false;
    p.max_texture_units = 32;
    p.max_samples = p.min_samples = 4;
    return p;
}

// The class of devices that the Direct3D 11.3 functional specification describes (devices.md 8). Where it leaves a
// choice, the value is that of geforce8_dx101.
DeviceProfile direct3d11() {
    DeviceProfile p = geforce8_dx101();
    p.name = "direct3d11";
    p.description = "no one device: the rules of Direct3D 11.3, with unordered access and ordered views";
    p.half_rounding = HalfRounding::toward_zero;
    p.has_d16 = true;
    p.has_unclamped_depth_clear = false;
    p.has_ordered_rmw = true;
    p.has_logic_op = false;
    p.has_unordered_access = true;
    p.max_viewport_px = 16384;
    return p;
}

// The index of a profile in ProfileField::source.
int source_column(std::string_view name) {
    if (name == "geforce3") return 0;
    if (name == "geforce8" || name == "geforce8_dx101") return 1;
    if (name == "swiftshader") return 4;
    if (name == "direct3d11") return 5;
    return name == "ideal" ? 2 : 3;
}

}  // namespace

const std::vector<DeviceProfile>& builtin_profiles() {
    static const std::vector<DeviceProfile> profiles{geforce3(), geforce8(),    geforce8_dx101(),
                                                     ideal(),    llvmpipe(),    llvmpipe_sse(),
                                                     softpipe(), swiftshader(), direct3d11()};
    return profiles;
}

DeviceProfile with_origin(DeviceProfile profile, Origin origin) {
    if (profile.origin == origin) return profile;
    profile.origin = origin;
    if (profile.raster.y_axis == YAxis::clip) return profile;  // its ties are named along clip-space y
    TieRule& ties = profile.raster.tie_rule;
    switch (ties) {
        case TieRule::top_left: ties = TieRule::bottom_left; break;
        case TieRule::bottom_left: ties = TieRule::top_left; break;
        case TieRule::top_right: ties = TieRule::bottom_right; break;
        case TieRule::bottom_right: ties = TieRule::top_right; break;
    }
    return profile;
}

const DeviceProfile* find_profile(std::string_view name) {
    const auto& all = builtin_profiles();
    const auto found = std::find_if(all.begin(), all.end(), [&](const DeviceProfile& p) { return p.name == name; });
    return found == all.end() ? nullptr : &*found;
}

std::vector<ProfileEntry> describe(const DeviceProfile& profile) {
    const DeviceProfile* const builtin = find_profile(profile.name);
    std::vector<ProfileEntry> entries;
    for (const ProfileField& field : profile_fields()) {
        const bool is_sourced = builtin != nullptr && field.value(*builtin) == field.value(profile);
        const auto column = static_cast<std::size_t>(source_column(profile.name));
        entries.push_back({std::string{field.key}, text_of(field, profile),
                           is_sourced ? std::string{field.source[column]} : "the profile's own file"});
    }
    return entries;
}

}  // namespace strata::pipeline
