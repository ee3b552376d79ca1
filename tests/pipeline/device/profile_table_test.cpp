// Tests the built-in profiles against independent tables with a row per field; columns: geforce3, geforce8,
// geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader, direct3d11.
#include <catch2/catch.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/device/profile_fields.h"

namespace {

using namespace strata::pipeline;

struct FieldOfDevices {
    std::string_view key;
    std::array<std::string_view, 9> value;
};

constexpr FieldOfDevices device_table[] = {
    {"raster.subpixel_bits", {"4", "8", "8", "8", "8", "8", "8", "4", "8"}},
    {"raster.snap",
     {"toward_zero", "nearest_even", "nearest_even", "nearest_even", "nearest_even", "nearest_even", "nearest_even",
      "nearest_even", "nearest_even"}},
    {"raster.coverage",
     {"snapped_edges", "snapped_edges", "snapped_edges", "snapped_edges", "snapped_edges", "snapped_edges",
      "float_spans", "snapped_edges", "snapped_edges"}},
    {"raster.tie_rule",
     {"top_left", "top_left", "top_left", "top_left", "bottom_left", "bottom_left", "top_left", "top_left",
      "top_left"}},
    {"raster.guard_band_px", {"524288", "32768", "32768", "32768", "32768", "32768", "32768", "524288", "32768"}},
    {"raster.clip",
     {"guard_band", "guard_band", "guard_band", "guard_band", "view_volume", "view_volume", "view_volume",
      "view_volume_depth_first", "guard_band"}},
    {"raster.z_clip",
     {"per_fragment", "per_primitive", "per_primitive", "per_primitive", "per_primitive", "per_primitive",
      "per_primitive", "per_primitive", "per_primitive"}},
    {"raster.w_clip", {"clip", "clip", "clip", "clip", "clip", "clip", "clip", "clip", "clip"}},
    {"raster.w_signs",
     {"by_corner", "ignored", "ignored", "ignored", "ignored", "ignored", "ignored", "ignored", "ignored"}},
    {"raster.w_divide",
     {"reciprocal", "quotient", "quotient", "quotient", "reciprocal", "reciprocal", "reciprocal", "reciprocal",
      "quotient"}},
    {"raster.viewport",
     {"separate", "separate", "separate", "separate", "fused_given", "separate", "separate", "half_pixel_first",
      "separate"}},
    {"raster.y_axis", {"memory", "memory", "memory", "memory", "memory", "memory", "memory", "clip", "memory"}},
    {"raster.area_sign", {"exact", "exact", "exact", "exact", "exact", "exact", "exact", "single", "exact"}},
    {"raster.plane_origin",
     {"snapped", "snapped", "snapped", "snapped", "unsnapped", "unsnapped", "unsnapped", "snapped", "snapped"}},
    {"raster.plane_rule",
     {"exact", "exact", "exact", "exact", "reciprocal_area_fused", "reciprocal_area", "least_corner", "greatest_w",
      "exact"}},
    {"raster.plane_corners",
     {"clipped", "clipped", "clipped", "clipped", "clipped", "clipped", "clipped", "given", "clipped"}},
    {"raster.perspective",
     {"quotient", "quotient", "quotient", "quotient", "reciprocal", "reciprocal", "quotient", "reciprocal",
      "quotient"}},
    {"raster.sample_divisor",
     {"sample", "sample", "sample", "sample", "centre", "centre", "sample", "sample", "sample"}},
    {"raster.window_z",
     {"buffer_units", "unit_interval", "unit_interval", "unit_interval", "unit_interval", "unit_interval",
      "unit_interval", "unit_interval", "unit_interval"}},
    {"raster.depth_path",
     {"window_z", "float32", "float32", "exact", "float32", "float32", "float32", "float32", "float32"}},
    {"raster.depth_rounding",
     {"floor", "nearest", "nearest", "nearest", "product_even", "product_even", "product_floor", "product_even",
      "nearest"}},
    {"raster.depth_limits", {"clamp", "clamp", "clamp", "clamp", "clamp", "clamp", "wrap", "zero_to_one", "clamp"}},
    {"raster.offset_unit",
     {"buffer", "format", "format", "format", "two_codes", "two_codes", "two_codes", "differences", "format"}},
    {"raster.offset_rule",
     {"fragments", "corners", "corners", "corners", "corners", "corners", "corners", "corners", "corners"}},
    {"raster.color",
     {"weights_8bit", "exact_plane", "exact_plane", "exact_plane", "exact_plane", "exact_plane", "exact_plane",
      "exact_plane", "exact_plane"}},
    {"raster.equal_colors",
     {"interpolated", "interpolated", "interpolated", "interpolated", "interpolated", "interpolated", "interpolated",
      "interpolated", "interpolated"}},
    {"raster.lines",
     {"band", "diamond_exit", "diamond_exit", "diamond_exit", "shifted_ends", "shifted_ends", "pixel_steps", "none",
      "diamond_exit"}},
    {"raster.points",
     {"reciprocal", "square", "square", "square", "subpixel_square", "subpixel_square", "two_triangles", "none",
      "square"}},
    {"raster.interpolant_bits", {"24", "24", "24", "24", "24", "24", "24", "24", "24"}},
    {"raster.divide", {"exact", "exact", "exact", "exact", "exact", "exact", "exact", "exact", "exact"}},
    {"raster.window_z_rule", {"chip", "chip", "chip", "chip", "chip", "chip", "chip", "chip", "chip"}},
    {"raster.weights",
     {"cut_edges", "cut_edges", "cut_edges", "cut_edges", "cut_edges", "cut_edges", "cut_edges", "cut_edges",
      "cut_edges"}},
    {"raster.reciprocal_bits", {"29", "29", "29", "29", "29", "29", "29", "29", "29"}},
    {"raster.reciprocal_deficit", {"2", "2", "2", "2", "2", "2", "2", "2", "2"}},
    {"raster.sum_bits", {"29", "29", "29", "29", "29", "29", "29", "29", "29"}},
    {"raster.quantize_reference", {"true", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"raster.w_slope",
     {"first_quad", "first_quad", "first_quad", "first_quad", "first_quad", "first_quad", "first_quad", "first_quad",
      "first_quad"}},
    {"raster.plane_anchor",
     {"first_vertex", "first_vertex", "first_vertex", "first_vertex", "first_vertex", "first_vertex", "first_vertex",
      "first_vertex", "first_vertex"}},
    {"raster.vertex_color_bits", {"14", "24", "24", "24", "24", "24", "24", "24", "24"}},
    {"raster.perspective_color",
     {"cut_products", "edge_products", "edge_products", "edge_products", "edge_products", "edge_products",
      "edge_products", "edge_products", "edge_products"}},
    {"raster.texture_coordinates",
     {"cut_weights", "exact_plane", "exact_plane", "exact_plane", "exact_plane", "exact_plane", "exact_plane",
      "exact_plane", "exact_plane"}},
    {"raster.perspective_coordinates",
     {"cut_products", "exact_plane", "exact_plane", "exact_plane", "exact_plane", "exact_plane", "exact_plane",
      "exact_plane", "exact_plane"}},
    {"origin",
     {"upper_left", "upper_left", "upper_left", "upper_left", "upper_left", "upper_left", "upper_left", "upper_left",
      "upper_left"}},
    {"clip_depth",
     {"minus_one_to_one", "minus_one_to_one", "minus_one_to_one", "minus_one_to_one", "minus_one_to_one",
      "minus_one_to_one", "minus_one_to_one", "minus_one_to_one", "minus_one_to_one"}},
    {"depth_order", {"less", "less", "less", "less", "less", "less", "less", "less", "less"}},
    {"alpha_test",
     {"unorm8", "by_target", "by_target", "by_target", "by_target", "by_target", "by_target", "by_target",
      "by_target"}},
    {"blend_rounding",
     {"nearest", "nearest", "nearest", "nearest", "each_product", "each_product", "nearest", "unrounded_source",
      "nearest"}},
    {"blend_storage", {"target", "target", "target", "target", "target", "target", "cached_tiles", "target", "target"}},
    {"half_rounding",
     {"nearest_even", "nearest_even", "nearest_even", "nearest_even", "toward_zero", "toward_zero", "toward_zero",
      "no_infinity", "toward_zero"}},
    {"unorm_rounding",
     {"half_up", "half_up", "half_up", "half_up", "product_even", "product_even", "product_even", "product_even_wide",
      "half_up"}},
    {"min_max_nan",
     {"other_operand", "other_operand", "other_operand", "other_operand", "other_operand", "other_operand", "propagate",
      "destination", "other_operand"}},
    {"denormals", {"flush", "flush", "flush", "keep", "flush", "flush", "flush", "flush", "flush"}},
    {"texture_filter",
     {"unorm8", "single", "single", "single", "code_lerps_fused", "code_lerps", "single_lerps", "single", "single"}},
    {"depth24", {"codes", "codes", "codes", "codes", "codes", "codes", "codes", "binary32", "codes"}},
    {"fog", {"bytes", "single", "single", "single", "single", "single", "single", "single", "single"}},
    {"lighting", {"float22", "single", "single", "single", "single", "single", "single", "single", "single"}},
    {"has_d16", {"true", "false", "false", "true", "true", "true", "true", "true", "true"}},
    {"has_d24", {"true", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_d32f", {"false", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_d16f", {"true", "false", "false", "false", "false", "false", "false", "false", "false"}},
    {"has_d24f", {"true", "false", "false", "false", "false", "false", "false", "false", "false"}},
    {"has_narrow_surfaces", {"true", "false", "false", "false", "false", "false", "false", "false", "false"}},
    {"has_float_targets", {"false", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_unclamped_depth_clear", {"false", "true", "true", "true", "true", "true", "true", "false", "false"}},
    {"has_fragment_programs", {"false", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_separate_alpha_blend", {"false", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_independent_blend", {"false", "false", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_two_sided_stencil", {"false", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_depth_clamp", {"true", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_depth_replace", {"true", "false", "false", "true", "false", "false", "false", "false", "false"}},
    {"has_sequential_depth_units", {"true", "true", "true", "true", "true", "true", "true", "true", "true"}},
    {"has_ordered_rmw", {"false", "false", "false", "true", "false", "false", "false", "false", "true"}},
    {"has_unordered_access", {"false", "false", "false", "true", "true", "true", "false", "false", "true"}},
    {"has_signed_blend", {"true", "false", "false", "false", "false", "false", "false", "false", "false"}},
    {"has_logic_op", {"true", "true", "true", "true", "true", "true", "true", "false", "false"}},
    {"sample_positions",
     {"nv20", "standard", "standard", "standard", "standard", "standard", "standard", "standard", "standard"}},
    {"resolve",
     {"codes_half_up", "codes_half_up", "codes_half_up", "codes_half_up", "single", "single", "single", "codes_half_up",
      "codes_half_up"}},
    {"alpha_to_coverage", {"nearest", "nearest", "nearest", "nearest", "up", "up", "up", "nearest", "nearest"}},
    {"sample_coverage", {"nearest", "nearest", "nearest", "nearest", "down", "down", "down", "nearest", "nearest"}},
    {"centroid", {"covered", "covered", "covered", "covered", "passing", "passing", "passing", "covered", "covered"}},
    {"max_render_targets", {"1", "8", "8", "8", "8", "8", "8", "8", "8"}},
    {"max_texture_units", {"4", "16", "16", "16", "32", "32", "32", "32", "16"}},
    {"max_viewport_px", {"4096", "8192", "8192", "16384", "16384", "16384", "16384", "8192", "16384"}},
    {"max_samples", {"4", "8", "8", "8", "4", "4", "1", "4", "8"}},
    {"min_samples", {"2", "2", "2", "2", "4", "4", "4", "4", "2"}},
};

struct NamesOfField {
    std::string_view key;
    std::vector<std::string_view> names;  // names of the values 0, 1, ...
};

// In the order of the enums in their headers.
const std::vector<NamesOfField> choice_names{
    {"raster.snap", {"toward_zero", "nearest_even"}},
    {"raster.coverage", {"snapped_edges", "float_spans"}},
    {"raster.tie_rule", {"top_left", "bottom_left", "top_right", "bottom_right"}},
    {"raster.clip", {"guard_band", "view_volume", "view_volume_depth_first"}},
    {"raster.z_clip", {"per_primitive", "per_fragment"}},
    {"raster.w_clip", {"clip", "drop"}},
    {"raster.w_signs", {"ignored", "by_corner"}},
    {"raster.w_divide", {"quotient", "reciprocal", "nv20"}},
    {"raster.viewport", {"separate", "fused", "fused_given", "half_pixel_first"}},
    {"raster.y_axis", {"memory", "clip"}},
    {"raster.area_sign", {"exact", "single"}},
    {"raster.plane_origin", {"snapped", "unsnapped"}},
    {"raster.plane_rule", {"exact", "reciprocal_area", "reciprocal_area_fused", "least_corner", "greatest_w"}},
    {"raster.plane_corners", {"clipped", "given"}},
    {"raster.perspective", {"quotient", "reciprocal"}},
    {"raster.sample_divisor", {"sample", "centre"}},
    {"raster.window_z", {"unit_interval", "buffer_units"}},
    {"raster.depth_path",
     {"window_z", "perspective_rq", "depth_replace", "float32", "float32_plane", "exact", "w_buffer", "logarithmic",
      "packed_rgba8"}},
    {"raster.depth_rounding", {"floor", "nearest", "product_even", "product_floor"}},
    {"raster.depth_limits", {"clamp", "wrap", "zero_to_one"}},
    {"raster.offset_unit", {"format", "float_exponent", "buffer", "two_codes", "differences"}},
    {"raster.offset_rule", {"corners", "fragments"}},
    {"raster.color", {"exact_plane", "weights_8bit"}},
    {"raster.lines", {"none", "band", "diamond_exit", "shifted_ends", "pixel_steps"}},
    {"raster.points", {"none", "square", "reciprocal", "subpixel_square", "two_triangles"}},
    {"raster.equal_colors", {"interpolated", "kept"}},
    {"raster.interpolant_bits", {"16", "17", "18", "19", "20", "21", "22", "23", "24", "double"}},
    {"raster.divide", {"exact", "cut_reciprocal", "low_reciprocal"}},
    {"raster.window_z_rule", {"chip", "exact", "float32"}},
    {"raster.weights", {"area", "cut_edges"}},
    {"raster.w_slope", {"first_quad", "last_quad"}},
    {"raster.plane_anchor", {"first_vertex", "window_corner"}},
    {"raster.perspective_color", {"edge_products", "weight_products", "cut_products"}},
    {"raster.texture_coordinates", {"exact_plane", "cut_weights"}},
    {"raster.perspective_coordinates", {"exact_plane", "cut_products"}},
    {"origin", {"upper_left", "lower_left"}},
    {"clip_depth", {"minus_one_to_one", "zero_to_one"}},
    {"depth_order", {"less", "greater"}},
    {"alpha_test", {"unorm8", "by_target"}},
    {"blend_rounding", {"nearest", "truncate", "each_product", "unrounded_source"}},
    {"blend_storage", {"target", "cached_tiles"}},
    {"half_rounding", {"nearest_even", "toward_zero", "no_infinity"}},
    {"unorm_rounding", {"half_up", "product_even", "product_even_wide"}},
    {"min_max_nan", {"other_operand", "propagate", "destination"}},
    {"denormals", {"flush", "keep"}},
    {"texture_filter", {"unorm8", "single", "code_lerps", "code_lerps_fused", "single_lerps"}},
    {"depth24", {"codes", "binary32"}},
    {"fog", {"single", "bytes"}},
    {"lighting", {"single", "float22"}},
    {"sample_positions", {"standard", "nv20"}},
    {"resolve", {"codes_half_up", "single"}},
    {"alpha_to_coverage", {"nearest", "up", "down"}},
    {"sample_coverage", {"nearest", "up", "down"}},
    {"centroid", {"covered", "passing"}},
};

[[nodiscard]] const ProfileField* field_named(std::string_view key) {
    for (const ProfileField& field : profile_fields())
        if (field.key == key) return &field;
    return nullptr;
}

}  // namespace

TEST_CASE("every field of every built-in device has the value in the table of devices") {
    REQUIRE(builtin_profiles().size() == 9);
    REQUIRE(std::size(device_table) == profile_fields().size());
    std::size_t at = 0;
    for (const FieldOfDevices& expected : device_table) {
        const ProfileField& field = profile_fields()[at++];
        CHECK(field.key == expected.key);
        for (std::size_t device = 0; device < 8; ++device) {
            INFO(expected.key << " of " << builtin_profiles()[device].name);
            CHECK(text_of(field, builtin_profiles()[device]) == expected.value[device]);
        }
    }
}

TEST_CASE("every choice has its enumerator's name value by value and is read back from that name") {
    std::size_t choices = 0;
    for (const ProfileField& field : profile_fields()) choices += field.kind == FieldKind::choice ? 1 : 0;
    CHECK(choices == choice_names.size());
    for (const NamesOfField& expected : choice_names) {
        INFO(expected.key);
        const ProfileField* const field = field_named(expected.key);
        REQUIRE(field != nullptr);
        CHECK(std::vector(field->choices.begin(), field->choices.end()) == expected.names);
        CHECK(field->highest + 1 == static_cast<int>(expected.names.size()));
        DeviceProfile profile;
        for (int value = 0; value < static_cast<int>(expected.names.size()); ++value) {
            field->set(profile, value);
            CHECK(text_of(*field, profile) == expected.names[static_cast<std::size_t>(value)]);
        }
    }
}

TEST_CASE("setting a choice sets the member that its key names to the enumerator that its text names") {
    using namespace strata::rasterizer;
    DeviceProfile p;
    const auto set = [&](std::string_view key, std::string_view text) {
        const ProfileField& field = *field_named(key);
        for (int value = field.lowest; value <= field.highest; value += field.step) {
            field.set(p, value);
            if (text_of(field, p) == text) return true;
        }
        return false;
    };
    CHECK((set("raster.snap", "toward_zero") && p.raster.snap == Snap::toward_zero));
    CHECK((set("raster.tie_rule", "top_right") && p.raster.tie_rule == TieRule::top_right));
    CHECK((set("raster.coverage", "float_spans") && p.raster.coverage == CoverageRule::float_spans));
    CHECK((set("raster.clip", "view_volume") && p.raster.clip == ClipVolume::view_volume));
    CHECK((set("raster.plane_rule", "least_corner") && p.raster.plane_rule == PlaneRule::least_corner));
    CHECK((set("raster.clip", "view_volume_depth_first") && p.raster.clip == ClipVolume::view_volume_depth_first));
    CHECK((set("raster.viewport", "half_pixel_first") && p.raster.viewport == ViewportArithmetic::half_pixel_first));
    CHECK((set("raster.y_axis", "clip") && p.raster.y_axis == YAxis::clip));
    CHECK((set("raster.area_sign", "single") && p.raster.area_sign == AreaSign::single));
    CHECK((set("raster.plane_rule", "greatest_w") && p.raster.plane_rule == PlaneRule::greatest_w));
    CHECK((set("raster.plane_corners", "given") && p.raster.plane_corners == PlaneCorners::given));
    CHECK((set("raster.offset_unit", "differences") && p.raster.offset_unit == OffsetUnit::differences));
    CHECK((set("depth24", "binary32") && p.depth24 == Depth24::binary32));
    CHECK((set("raster.perspective", "reciprocal") && p.raster.perspective == PerspectiveDivide::reciprocal));
    CHECK((set("unorm_rounding", "product_even") && p.unorm_rounding == UnormRounding::product_even));
    CHECK((set("raster.z_clip", "per_fragment") && p.raster.z_clip == ZClip::per_fragment));
    CHECK((set("raster.w_clip", "drop") && p.raster.w_clip == WClip::drop));
    CHECK((set("raster.w_signs", "by_corner") && p.raster.w_signs == WSigns::by_corner));
    CHECK((set("raster.offset_rule", "fragments") && p.raster.offset_rule == OffsetRule::fragments));
    CHECK((set("raster.weights", "area") && p.raster.hypothesis.weights == WeightRule::area));
    CHECK((set("raster.reciprocal_deficit", "3") && p.raster.hypothesis.reciprocal_deficit == 3));
    CHECK((set("raster.w_slope", "last_quad") && p.raster.hypothesis.w_slope == WSlope::last_quad));
    CHECK((set("raster.perspective_coordinates", "cut_products") &&
           p.raster.interpolation.perspective_coordinates == PerspectiveCoordinates::cut_products));
    CHECK((set("raster.w_divide", "nv20") && p.raster.w_divide == WDivide::nv20));
    CHECK((set("raster.viewport", "fused") && p.raster.viewport == ViewportArithmetic::fused));
    CHECK((set("raster.plane_origin", "unsnapped") && p.raster.plane_origin == PlaneOrigin::unsnapped));
    CHECK((set("raster.window_z", "buffer_units") && p.raster.window_z == WindowZ::buffer_units));
    CHECK((set("raster.depth_path", "depth_replace") && p.raster.depth_path == DepthPath::depth_replace));
    CHECK((set("raster.depth_rounding", "floor") && p.raster.depth_rounding == DepthRounding::floor));
    CHECK((set("raster.depth_limits", "wrap") && p.raster.depth_limits == DepthLimits::wrap));
    CHECK((set("raster.offset_unit", "float_exponent") && p.raster.offset_unit == OffsetUnit::float_exponent));
    CHECK((set("raster.color", "weights_8bit") && p.raster.color == ColorInterpolation::weights_8bit));
    CHECK((set("raster.equal_colors", "kept") && p.raster.equal_colors == EqualColors::kept));
    CHECK((set("raster.interpolant_bits", "double") && p.raster.hypothesis.interpolant_bits == full_double));
    CHECK((set("raster.interpolant_bits", "19") && p.raster.hypothesis.interpolant_bits == 19));
    CHECK((set("raster.divide", "low_reciprocal") && p.raster.hypothesis.divide == DivideRule::low_reciprocal));
    CHECK((set("raster.window_z_rule", "float32") && p.raster.hypothesis.window_z == WindowZRule::float32));
    CHECK((set("raster.reciprocal_bits", "25") && p.raster.hypothesis.reciprocal_bits == 25));
    CHECK((set("raster.sum_bits", "26") && p.raster.hypothesis.sum_bits == 26));
    CHECK((set("raster.quantize_reference", "false") && !p.raster.hypothesis.quantize_reference));
    CHECK((set("raster.plane_anchor", "window_corner") &&
           p.raster.hypothesis.plane_anchor == PlaneAnchor::window_corner));
    CHECK((set("raster.vertex_color_bits", "9") && p.raster.interpolation.vertex_color_bits == 9));
    CHECK((set("raster.perspective_color", "weight_products") &&
           p.raster.interpolation.perspective_color == PerspectiveColor::weight_products));
    CHECK((set("raster.texture_coordinates", "cut_weights") &&
           p.raster.interpolation.texture_coordinates == CoordinateRule::cut_weights));
    CHECK((set("origin", "lower_left") && p.origin == Origin::lower_left));
    CHECK((set("clip_depth", "zero_to_one") && p.clip_depth == ClipDepth::zero_to_one));
    CHECK((set("depth_order", "greater") && p.depth_order == DepthOrder::greater));
    CHECK((set("alpha_test", "unorm8") && p.alpha_test == AlphaTestPrecision::unorm8));
    CHECK((set("blend_rounding", "truncate") && p.blend_rounding == BlendRounding::truncate));
    CHECK((set("blend_storage", "cached_tiles") && p.blend_storage == BlendStorage::cached_tiles));
    CHECK((set("half_rounding", "toward_zero") && p.half_rounding == HalfRounding::toward_zero));
    CHECK((set("min_max_nan", "propagate") && p.min_max_nan == MinMaxNan::propagate));
    CHECK((set("denormals", "keep") && p.denormals == DenormalRule::keep));
    CHECK((set("texture_filter", "unorm8") && p.texture_filter == TextureFilterPrecision::unorm8));
    CHECK((set("fog", "bytes") && p.fog == FogRule::bytes));
    CHECK((set("lighting", "float22") && p.lighting == LightingRule::float22));
    CHECK_FALSE(set("raster.subpixel_bits", "13"));
    CHECK_FALSE(set("raster.subpixel_bits", "-1"));
    CHECK((set("raster.subpixel_bits", "0") && p.raster.subpixel_bits == 0));
    CHECK((set("raster.subpixel_bits", "12") && p.raster.subpixel_bits == 12));
}

TEST_CASE("a device states the source of every number in its own column of sources") {
    const auto source = [](std::string_view device, std::string_view key) {
        for (const ProfileEntry& entry : describe(*find_profile(device)))
            if (entry.key == key) return entry.source;
        return std::string{};
    };
    const std::string_view limit = "max_render_targets";
    for (const std::string_view device : {"geforce3", "geforce8", "llvmpipe"})
        CHECK(source(device, limit).starts_with("["));
    CHECK(source("geforce3", limit).find("one colour buffer") != std::string::npos);
    CHECK(source("geforce8", limit).find("D3D 11.3") != std::string::npos);
    CHECK(source("geforce8_dx101", limit) == source("geforce8", limit));
    CHECK(source("llvmpipe", limit).find("GL_MAX_DRAW_BUFFERS") != std::string::npos);
    CHECK(source("swiftshader", limit).find("Chromium") != std::string::npos);
    CHECK(source("swiftshader", "raster.plane_anchor") == "[A] as geforce8_dx101");
    CHECK(source("ideal", limit) == "ideal: no device");
    DeviceProfile own = *find_profile("geforce8");
    own.name = "mine";  // a profile file with another name is the source of all its values
    for (const ProfileEntry& entry : describe(own)) CHECK(entry.source == "the profile's own file");
    for (const DeviceProfile& profile : builtin_profiles())
        for (const ProfileEntry& entry : describe(profile)) CHECK(entry.source != "the profile's own file");
}
