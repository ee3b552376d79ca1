// pipeline/device/profile_fields.cpp - the table of a profile's fields and their sources (profile_fields.h).
#include "pipeline/device/profile_fields.h"

#include <utility>

#include "rasterizer/base/enum_values.h"

namespace strata::pipeline {
namespace {

using Names = std::span<const std::string_view>;
// The last two entries are for swiftshader and direct3d11. If omitted, the source of geforce8_dx101 applies: it is
// Direct3D 11.3 itself wherever that states the value.
using Sources = std::array<std::string_view, 6>;
using Profile = DeviceProfile;
using Rules = rasterizer::RasterRules;
using Hypothesis = rasterizer::DepthHypothesis;
using Interpolation = rasterizer::InterpolationHypothesis;

constexpr std::string_view interpolant_names[] = {"16", "17", "18", "19", "20", "21", "22", "23", "24", "double"};

// A member of DeviceProfile, of its RasterRules or of their hypotheses.
template <auto member>
[[nodiscard]] constexpr auto& at(auto& profile) {
    if constexpr (requires { profile.*member; }) {
        return profile.*member;
    } else if constexpr (requires { profile.raster.hypothesis.*member; }) {
        return profile.raster.hypothesis.*member;
    } else if constexpr (requires { profile.raster.interpolation.*member; }) {
        return profile.raster.interpolation.*member;
    } else {
        return profile.raster.*member;
    }
}

// A field without its range. value and set are plain functions that use `at`, so that the table can be constexpr.
template <auto member>
constexpr ProfileField field_of(std::string_view key, FieldKind kind, const Sources& source) {
    ProfileField field;
    field.key = key;
    field.kind = kind;
    field.value = [](const Profile& p) { return static_cast<int>(at<member>(p)); };
    field.set = [](Profile& p, int value) {
        at<member>(p) = static_cast<std::remove_reference_t<decltype(at<member>(p))>>(value);
    };
    field.source = source;
    if (field.source[4].empty()) field.source[4] = "[A] as geforce8_dx101";
    if (field.source[5].empty()) field.source[5] = field.source[1];
    return field;
}

template <auto member>
constexpr ProfileField boolean(std::string_view key, const Sources& source) {
    return field_of<member>(key, FieldKind::boolean, source);
}

// A choice whose names are not the identifiers of an enum.
template <auto member>
constexpr ProfileField choice_of(std::string_view key, Names names, const Sources& source) {
    ProfileField field = field_of<member>(key, FieldKind::choice, source);
    field.choices = names;
    field.highest = static_cast<int>(names.size()) - 1;
    return field;
}

// A choice among the values of an enum, named by their identifiers: a new value is included automatically.
template <auto member>
constexpr ProfileField choice(std::string_view key, const Sources& source) {
    using Enum = std::remove_cvref_t<decltype(at<member>(std::declval<Profile&>()))>;
    return choice_of<member>(key, enum_names<Enum>, source);
}

struct NumberRange {
    int lowest, highest, step = 1;
};

template <auto member>
constexpr ProfileField integer(std::string_view key, NumberRange range, const Sources& source) {
    ProfileField field = field_of<member>(key, FieldKind::integer, source);
    field.lowest = range.lowest;
    field.highest = range.highest;
    field.step = range.step;
    return field;
}

// The values 16 to 24 and full_double, as indices into interpolant_names.
constexpr ProfileField interpolant_bits(std::string_view key, const Sources& source) {
    ProfileField field = choice_of<&Hypothesis::interpolant_bits>(key, interpolant_names, source);
    field.value = [](const Profile& p) {
        const int bits = p.raster.hypothesis.interpolant_bits;
        return bits == rasterizer::full_double ? 9 : bits - 16;
    };
    field.set = [](Profile& p, int value) {
        p.raster.hypothesis.interpolant_bits = value == 9 ? rasterizer::full_double : value + 16;
    };
    return field;
}

constexpr std::string_view ours = "ideal: no device";
constexpr std::string_view unruled = "[A] lines-and-points.md 1: refused, for its rule is not known here";
constexpr std::string_view shapes = "[M] lines-and-points.md 4.1: llvmpipe's in 36 pictures; softpipe's is not known";
constexpr std::string_view drawn = "[M] tools/lab/bench/README.md: Mesa 22.3 draws the same fragments";
constexpr std::string_view opengl = "[S] OpenGL 4.5, which Mesa 22.3 implements";
constexpr std::string_view unused = "[A] of path window_z, which this profile lacks";
constexpr std::string_view unweighted = "[A] of 8-bit colour weights, which this profile lacks";
constexpr std::string_view webgl = "[M] Chromium 156 answers so in WebGL 2";
constexpr std::string_view initial = "[S] devices.md 3.9: OpenGL's initial state";
constexpr std::string_view converted = "[A] devices.md 3.9: views are converted for Direct3D's own convention";
constexpr std::string_view unmeasured = "[A] as geforce8_dx101";

// Sources: [S] a specification, [M] measured, [A] our assumption (pipeline/reference/devices.md); then the page and
// section of the specification.
constexpr std::array fields{
    integer<&Rules::subpixel_bits>(
        "raster.subpixel_bits", {0, 12, 1},
        {"[M] coverage.md 1.2: hardware tests on NV2A; the minimum OpenGL allows",
         "[S] coverage.md 1.2: D3D 11.3 3.4.1", ours, drawn, "[M] swiftshader-rasterizer.md 1.1: SUBPIXEL_BITS"}),
    choice<&Rules::snap>("raster.snap", {"[M] coverage.md 4.1: 0.5624 lands on 0.5",
                                         "[A] coverage.md 4.1: 0.6 ULP is allowed, the ideal is taken", ours, drawn,
                                         "[M] swiftshader-rasterizer.md 1.1"}),
    choice<&Rules::coverage>(
        "raster.coverage", {"[M] chip-geometry.md 1.5: 298,500 of 298,500 pixels",
                            "[S] coverage.md 5.3: D3D 11.3 3.4.2.1", ours, drawn, "[M] swiftshader-rasterizer.md 1.3"}),
    choice<&Rules::tie_rule>("raster.tie_rule", {"[M] chip-geometry.md 1.5: 298,500 of 298,500 pixels",
                                                 "[S] coverage.md 5.3: D3D 11.3 3.4.2.1", ours, drawn,
                                                 "[M] swiftshader-rasterizer.md 1.3: by the rows of y_axis"}),
    integer<&Rules::guard_band_px>(
        "raster.guard_band_px", {1, 524288},
        {"[M] chip-geometry.md 5.3: 513,000 pixels keep their place", "[S] coverage.md 1.3: D3D 11.3 15.6.1", ours,
         "[A] Mesa cuts at the viewport: compare scenes that lie inside it", "[A] none: it cuts at the view volume"}),
    choice<&Rules::clip>("raster.clip", {"[A] coverage.md 2.3: the guard band", "[S] coverage.md 1.3: D3D 11.3 15.6.1",
                                         ours, "[M] mesa-rasterizers.md 1.2", "[M] swiftshader-rasterizer.md 1.2"}),
    choice<&Rules::z_clip>("raster.z_clip", {"[M] depth.md 5.2: fragments outside zmin..zmax are discarded",
                                             "[S] depth.md 5.2: D3D 11.3 15.4", ours, "[S] OpenGL 4.5 13.7",
                                             "[M] swiftshader-rasterizer.md 1.2"}),
    choice<&Rules::w_clip>("raster.w_clip",
                           {"[A] coverage.md 2.1", "[S] coverage.md 2.1: D3D 11.3 15.4", ours, "[S] OpenGL 4.5 13.7"}),
    choice<&Rules::w_signs>("raster.w_signs", {"[M] chip-float-depth.md 8: 40 of 40 pictures",
                                               "[A] coverage.md 5.8: no such positions", ours, unmeasured}),
    choice<&Rules::w_divide>("raster.w_divide", {"[S] coverage.md 3.2", "[A] coverage.md 3.2", ours, drawn,
                                                 "[M] swiftshader-rasterizer.md 1.1"}),
    choice<&Rules::viewport>("raster.viewport",
                             {"[A] coverage.md 3.3", "[A] coverage.md 3.3", ours,
                              "[A] either: half of 1024 scales exactly", "[M] swiftshader-rasterizer.md 1.1"}),
    choice<&Rules::y_axis>("raster.y_axis",
                           {"[A] coverage.md 3.7: no picture tells", "[A] coverage.md 3.7: no picture tells", ours,
                            unmeasured, "[M] swiftshader-rasterizer.md 1.1"}),
    choice<&Rules::area_sign>(
        "raster.area_sign", {"[A] coverage.md 6.5: the exact area", "[S] coverage.md 6.2: D3D 11.3 15.11", ours, drawn,
                             "[M] swiftshader-rasterizer.md 1.4"}),
    choice<&Rules::plane_origin>(
        "raster.plane_origin",
        {"[M] chip-geometry.md 2.2: 99.80 % of 65,536 pixels", "[S] depth.md 3.7: D3D 11.3 15.16.2", ours,
         "[M] Mesa 22.3: planes start at the float32 positions", "[M] swiftshader-rasterizer.md 2.2"}),
    choice<&Rules::plane_rule>(
        "raster.plane_rule",
        {"[A] depth.md 3.1: the exact plane, rounded once", "[A] depth.md 3.1: the exact plane, rounded once", ours,
         "[M] mesa-rasterizers.md 2.4", "[M] swiftshader-rasterizer.md 2.1"}),
    choice<&Rules::plane_corners>("raster.plane_corners",
                                  {"[A] depth.md 3.10: the pieces'", "[A] depth.md 3.10: the pieces'", ours,
                                   "[M] mesa-rasterizers.md 1.2", "[M] swiftshader-rasterizer.md 2.2"}),
    choice<&Rules::perspective>(
        "raster.perspective",
        {"[A] attributes.md 1.1: a quotient rounded once", "[A] attributes.md 1.1: a quotient rounded once", ours,
         "[M] mesa-rasterizers.md 2.5", "[M] swiftshader-rasterizer.md 2.4"}),
    choice<&Rules::sample_divisor>("raster.sample_divisor",
                                   {"[A] attributes.md 1.10: all at the sample",
                                    "[A] attributes.md 1.10: all at the sample", ours, "[M] mesa-rasterizers.md 2.11"}),
    choice<&Rules::window_z>("raster.window_z", {"[M] chip-depth.md 1.4", "[A] coverage.md 3.4", ours, unmeasured}),
    choice<&Rules::depth_path>("raster.depth_path",
                               {"[M] chip-depth.md 1.1: 4,927,976 of 4,927,976 words",
                                "[A] depth.md 4.1: D3D 11.3 16.3.1 fixes all but the last bit", ours,
                                "[A] Mesa rounds each step of its plane; the exact plane is taken"}),
    choice<&Rules::depth_rounding>("raster.depth_rounding", {"[M] chip-depth.md 1.3: NV2A floors integer depth",
                                                             "[S] depth.md 2.1: D3D 11.3 17.10", ours, unmeasured,
                                                             "[M] swiftshader-rasterizer.md 2.5"}),
    choice<&Rules::depth_limits>("raster.depth_limits",
                                 {"[S] depth.md 2.1: GL 2.1 2.11.1", "[S] depth.md 2.1: D3D 11.3 17.10", ours,
                                  "[M] depth.md 2.9: depths of a program, drawn and read"}),
    choice<&Rules::offset_unit>(
        "raster.offset_unit",
        {"[M] chip-float-depth.md 2.1: 1 in every format", "[S] coverage.md 9.2: D3D 11.3 15.10", ours,
         "[M] mesa-rasterizers.md 1.3: 2 codes at 72 places", "[M] swiftshader-rasterizer.md 2.6"}),
    choice<&Rules::offset_rule>("raster.offset_rule",
                                {"[M] chip-float-depth.md 2.2: 89 of 98 pictures",
                                 "[A] coverage.md 9.1: before the plane is made", ours, unmeasured}),
    choice<&Rules::color>("raster.color", {"[M] chip-fragment.md 3.3: 489,784 of 489,788 pixels",
                                           "[A] attributes.md 1.1: exact plane, one rounding", ours, unmeasured}),
    choice<&Rules::equal_colors>("raster.equal_colors", {"[A] attributes.md 1.9: exact planes keep them",
                                                         "[A] attributes.md 1.9: exact planes keep them", ours,
                                                         "[M] attributes.md 1.9: a varying is stepped"}),
    choice<&Rules::lines>("raster.lines", {"[M] lines-and-points.md 2: 17 of 18 pictures", "[S] lines-and-points.md 4",
                                           ours, shapes, unruled, "[A] lines-and-points.md 4: as OpenGL"}),
    choice<&Rules::points>("raster.points", {"[M] lines-and-points.md 5: 7 of 7 pictures", "[S] lines-and-points.md 5",
                                             ours, shapes, unruled, "[S] lines-and-points.md 5: two triangles"}),
    interpolant_bits("raster.interpolant_bits",
                     {"[A] depth.md 4.5: binary32", "[A] depth.md 4.5: binary32", ours, unmeasured}),
    choice<&Hypothesis::divide>("raster.divide",
                                {"[A] depth.md 8.2: rounded once; chip-depth.md 6.3 knows no bit-exact rule",
                                 "[A] depth.md 8.2: rounded once", ours, unmeasured}),
    choice<&Hypothesis::window_z>("raster.window_z_rule", {"[M] chip-depth.md 1.1: 4,927,976 of 4,927,976 words",
                                                           unused, unused, unused, unused}),
    choice<&Hypothesis::weights>(
        "raster.weights", {"[M] chip-float-depth.md 1.2: 4 of 1,083,110 words wrong", unused, unused, unused, unused}),
    integer<&Hypothesis::reciprocal_bits>("raster.reciprocal_bits", {24, 30},
                                          {"[M] chip-float-depth.md 1.2", unused, unused, unused, unused}),
    integer<&Hypothesis::reciprocal_deficit>(
        "raster.reciprocal_deficit", {0, 8},
        {"[M] chip-float-depth.md 1.1: 1.82 to 2.86", unused, unused, unused, unused}),
    integer<&Hypothesis::sum_bits>("raster.sum_bits", {24, 29},
                                   {"[M] depth.md 8.3: a 29-bit aligned add", unused, unused, unused, unused}),
    boolean<&Hypothesis::quantize_reference>(
        "raster.quantize_reference",
        {"[M] chip-depth.md 7.2: R is cut like a depth write", "[S] depth.md 6.2: D3D 11.3 22.4.19", ours, unmeasured}),
    choice<&Hypothesis::w_slope>("raster.w_slope",
                                 {"[A] chip-float-depth.md 4.5: either occurs", unused, unused, unused, unused}),
    choice<&Hypothesis::plane_anchor>("raster.plane_anchor",
                                      {"[A] depth.md 4.7: either is in use", "[A] depth.md 4.7: either is in use", ours,
                                       "[A] depth.md 4.7: either is in use"}),
    integer<&Interpolation::vertex_color_bits>(
        "raster.vertex_color_bits", {9, 24},
        {"[M] attributes.md 2.2: all of 3,944 greys", unweighted, unweighted, unweighted, unweighted}),
    choice<&Interpolation::perspective_color>(
        "raster.perspective_color",
        {"[M] chip-float-depth.md 7: 5 of 800,480 pixels wrong", unweighted, unweighted, unweighted, unweighted}),
    choice<&Interpolation::texture_coordinates>("raster.texture_coordinates",
                                                {"[M] attributes.md 3.2: 41,274 coordinates, for equal w",
                                                 "[S] attributes.md 3.1: D3D 11.3 15.10", ours, unmeasured}),
    choice<&Interpolation::perspective_coordinates>(
        "raster.perspective_coordinates",
        {"[A] attributes.md 3.3: captures cannot show it", "[S] attributes.md 3.1: D3D 11.3 15.10", ours, unmeasured}),
    choice<&Profile::origin>("origin", {"[M] coverage.md 1.1: the first row of a capture is the upper one",
                                        "[S] coverage.md 1.1: D3D 11.3 3.3.1", ours,
                                        "[M] mesa-rasterizers.md 1.1: measured under GL_UPPER_LEFT",
                                        "[M] swiftshader-rasterizer.md 1.3: either, for y_axis is clip"}),
    choice<&Profile::clip_depth>("clip_depth", {initial, initial, ours, opengl, initial, converted}),
    choice<&Profile::depth_order>("depth_order", {initial, initial, ours, opengl, initial, converted}),
    choice<&Profile::alpha_test>(
        "alpha_test",
        {"[M] chip-fragment.md 2: 16 of 16 pictures", "[S] fragment-stages.md 3: ARB_color_buffer_float", ours,
         unmeasured, unmeasured, "[A] fragment-stages.md 3: a pixel shader discards by a comparison of its own"}),
    choice<&Profile::blend_rounding>(
        "blend_rounding",
        {"[M] chip-fragment.md 1.2: 1,673 of 1,673", "[A] fragment-stages.md 8.2: the contract that NV2A confirms",
         ours, unmeasured, "[M] swiftshader-rasterizer.md 3.2",
         "[S] fragment-stages.md 8.2: D3D 11.3 17.5, within its tolerance"}),
    choice<&Profile::blend_storage>(
        "blend_storage",
        {"[M] chip-fragment.md 1.2: 1,673 of 1,673", "[A] fragment-stages.md 8.2: the contract that NV2A confirms",
         ours, "[M] mesa-rasterizers.md 3.5", "[M] swiftshader-rasterizer.md 3.2"}),
    choice<&Profile::half_rounding>(
        "half_rounding",
        {"[A] formats.md 3.2: no float targets", "[A] formats.md 3.2: GL and NV round to nearest, D3D allows zero",
         ours, unmeasured, "[M] swiftshader-rasterizer.md 3.3", "[S] formats.md 3.2: D3D 11.3 3.2.2, toward zero"}),
    choice<&Profile::unorm_rounding>(
        "unorm_rounding",
        {"[S] formats.md 2.1: D3D 11.3 3.2.3.6", "[S] formats.md 2.1: D3D 11.3 3.2.3.6", ours,
         "[M] mesa-rasterizers.md 2.6: 0 of 303,960 channels wrong", "[M] swiftshader-rasterizer.md 3.1"}),
    choice<&Profile::min_max_nan>(
        "min_max_nan", {"[A] fragment-stages.md 9.3: no float targets",
                        "[A] fragment-stages.md 9.3: D3D 11.3 22.10.10, envytools fp32_minmax", ours, unmeasured,
                        "[M] swiftshader-rasterizer.md 3.4"}),
    choice<&Profile::denormals>("denormals", {"[A] fragment-stages.md 9.1: no float targets",
                                              "[A] fragment-stages.md 9.1: flushed in and out, as the shader does",
                                              ours, unmeasured, "[M] swiftshader-rasterizer.md 3.4"}),
    choice<&Profile::texture_filter>("texture_filter", {"[A] texturing.md 3.2: one rounding to 8 bits",
                                                        "[A] texturing.md 3.1: binary32 in a fixed order", ours,
                                                        "[M] texturing.md 3.4: 0 of 3,538,944 lookups differ",
                                                        unmeasured, "[A] texturing.md 3.1: binary32 in a fixed order"}),
    choice<&Profile::depth24>("depth24", {"[M] chip-depth.md 1.3: codes", "[S] depth.md 2.1: D3D 11.3 17.10", ours,
                                          unmeasured, "[M] swiftshader-rasterizer.md 2.5"}),
    choice<&Profile::fog>("fog", {"[M] fog-and-lighting.md 2: 53 pictures", "[A] fog-and-lighting.md 1.2", ours,
                                  "[A] fog-and-lighting.md 1.2"}),
    choice<&Profile::lighting>("lighting",
                               {"[M] fog-and-lighting.md 5: captures", "[A] lighting.md 3", ours, "[A] lighting.md 3"}),
    boolean<&Profile::has_d16>("has_d16", {"[M] devices.md 5: Z16", "[M] devices.md 5: Z16 only from G200 on", ours,
                                           opengl, webgl, "[S] devices.md 5: DXGI_FORMAT_D16_UNORM"}),
    boolean<&Profile::has_d24>("has_d24", {"[M] devices.md 5: Z24S8", "[M] devices.md 5: Z24S8", ours, opengl, webgl,
                                           "[S] devices.md 5: DXGI_FORMAT_D24_UNORM_S8_UINT"}),
    boolean<&Profile::has_d32f>(
        "has_d32f", {"[M] devices.md 5: no such format", "[M] devices.md 5: Z32F among G80's depth formats", ours,
                     opengl, webgl, "[S] devices.md 5: DXGI_FORMAT_D32_FLOAT"}),
    boolean<&Profile::has_d16f>(
        "has_d16f", {"[M] chip-float-depth.md 3.2: 98 pictures", "[M] devices.md 5: not among G80's depth formats",
                     ours, opengl, webgl, "[S] devices.md 5: no such format"}),
    boolean<&Profile::has_d24f>(
        "has_d24f", {"[M] chip-float-depth.md 3.3: 98 pictures", "[M] devices.md 5: not among G80's depth formats",
                     ours, opengl, webgl, "[S] devices.md 5: no such format"}),
    boolean<&Profile::has_narrow_surfaces>(
        "has_narrow_surfaces", {"[M] chip-fragment.md 5", "[A] devices.md 5: none is emulated", ours, opengl, webgl}),
    boolean<&Profile::has_float_targets>("has_float_targets", {"[S] devices.md 5: NV30 had the first, without blending",
                                                               "[S] devices.md 5: Bavoil and Myers", ours, opengl,
                                                               webgl, "[S] devices.md 5: R16G16B16A16_FLOAT blends"}),
    boolean<&Profile::has_unclamped_depth_clear>(
        "has_unclamped_depth_clear",
        {"[S] formats.md 5.5: NV_depth_buffer_float", "[S] formats.md 5.5: NV_depth_buffer_float", ours,
         "[A] as geforce8_dx101", "[S] WebGL 1 6.7: clearDepth clamps",
         "[S] formats.md 5.5: ClearDepthStencilView clamps"}),
    boolean<&Profile::has_fragment_programs>(
        "has_fragment_programs", {"[S] devices.md 6: combiners and texture shaders", "[S] devices.md 6", ours, opengl,
                                  webgl, "[S] devices.md 6: pixel shaders"}),
    boolean<&Profile::has_separate_alpha_blend>(
        "has_separate_alpha_blend",
        {"[M] devices.md 6: one factor pair and one equation", "[M] devices.md 6: register fields since NV30 and NV40",
         ours, opengl, webgl, "[S] devices.md 6: BlendOpAlpha"}),
    boolean<&Profile::has_independent_blend>(
        "has_independent_blend",
        {"[M] devices.md 6", "[M] devices.md 6: a shared equation; per target from GT215 (DirectX 10.1) on", ours,
         opengl, webgl, "[S] devices.md 6: IndependentBlendEnable"}),
    boolean<&Profile::has_two_sided_stencil>(
        "has_two_sided_stencil",
        {"[S] devices.md 6: EXT_stencil_two_side came with NV30", "[S] devices.md 6: STENCIL_TWO_SIDE_ENABLE", ours,
         opengl, webgl, "[S] devices.md 6: FrontFace and BackFace"}),
    boolean<&Profile::has_depth_clamp>("has_depth_clamp", {"[M] chip-geometry.md 5.3: clamped when depth clamp is on",
                                                           "[S] depth.md 5.3: NV_depth_clamp", ours, opengl, webgl,
                                                           "[S] depth.md 5.3: DepthClipEnable false"}),
    boolean<&Profile::has_depth_replace>(
        "has_depth_replace", {"[S] texture-shader.md 7: NV_texture_shader", "[S] devices.md 6: refused", ours,
                              "[A] as geforce8_dx101", webgl}),
    boolean<&Profile::has_sequential_depth_units>(
        "has_sequential_depth_units",
        {"[A] devices.md 6: an emulator extension", "[A] devices.md 6: an emulator extension", ours,
         "[A] devices.md 6: an emulator extension"}),
    boolean<&Profile::has_ordered_rmw>("has_ordered_rmw",
                                       {"[A] devices.md 6", "[A] devices.md 6", ours, "[A] devices.md 6", unmeasured,
                                        "[S] devices.md 6: rasterizer ordered views"}),
    boolean<&Profile::has_unordered_access>(
        "has_unordered_access",
        {"[S] devices.md 6: Direct3D 11", "[S] devices.md 6: Direct3D 11", ours,
         "[S] devices.md 6: OpenGL 4.5 of llvmpipe, 3.3 of softpipe", "[S] WebGL 2 has no storage buffers"}),
    boolean<&Profile::has_signed_blend>("has_signed_blend",
                                        {"[M] fragment-stages.md 8.3: 478 of 478 pictures",
                                         "[S] fragment-stages.md 8.3: no such equation", ours, opengl, webgl}),
    boolean<&Profile::has_logic_op>(
        "has_logic_op", {"[S] fragment-stages.md 8.6: OpenGL 1.1", "[S] fragment-stages.md 8.6: OpenGL 1.1", ours,
                         opengl, "[S] WebGL 2 has none", "[S] fragment-stages.md 8.6: on integer targets alone"}),
    choice<&Profile::sample_positions>(
        "sample_positions",
        {"[M] fragment-stages.md 13.1: of two samples; four are assumed",
         "[S] fragment-stages.md 13.1: D3D 11.3 19.2.4.1", ours, "[S] fragment-stages.md 13.1: Mesa 22.3's table"}),
    choice<&Profile::resolve>("resolve", {"[A] fragment-stages.md 13.3", "[A] fragment-stages.md 13.3", ours,
                                          "[M] mesa-rasterizers.md 2.11", "[A] fragment-stages.md 13.3"}),
    choice<&Profile::alpha_to_coverage>("alpha_to_coverage",
                                        {"[A] fragment-stages.md 13.6", "[A] fragment-stages.md 13.6", ours,
                                         "[M] fragment-stages.md 13.6", "[A] fragment-stages.md 13.6"}),
    choice<&Profile::sample_coverage>("sample_coverage",
                                      {"[A] fragment-stages.md 13.6", "[A] fragment-stages.md 13.6", ours,
                                       "[S] fragment-stages.md 13.6: Mesa", "[A] fragment-stages.md 13.6"}),
    choice<&Profile::centroid>("centroid", {"[A] fragment-stages.md 13.7", "[A] fragment-stages.md 13.7", ours,
                                            "[M] fragment-stages.md 13.7", "[A] fragment-stages.md 13.7"}),
    integer<&Profile::max_render_targets>("max_render_targets", {1, 8},
                                          {"[S] devices.md 7: one colour buffer", "[S] devices.md 7: D3D 11.3 17.14",
                                           ours, "[M] Mesa 22.3: GL_MAX_DRAW_BUFFERS", webgl}),
    integer<&Profile::max_texture_units>(
        "max_texture_units", {1, 32},
        {"[S] devices.md 7: four texture shader stages", "[A] devices.md 7: sixteen samplers of Direct3D 10", ours,
         "[M] Mesa 22.3: GL_MAX_TEXTURE_IMAGE_UNITS", webgl, "[S] devices.md 7: sixteen samplers of a stage"}),
    integer<&Profile::max_viewport_px>(
        "max_viewport_px", {1, 16384},
        {"[A] coverage.md 1.3: never found documented", "[A] devices.md 7: the limit of Direct3D 10.0", ours,
         "[M] Mesa 22.3: GL_MAX_VIEWPORT_DIMS", webgl, "[S] devices.md 7: 16384 texels of a 2D texture"}),
    integer<&Profile::max_samples>(
        "max_samples", {1, 8},
        {"[A] devices.md 7: 4-sample multisampling", "[A] devices.md 7: 8-sample multisampling", ours,
         "[M] Mesa 22.3: GL_MAX_SAMPLES", webgl, "[S] devices.md 7: 4 and 8 samples are required"}),
    integer<&Profile::min_samples>("min_samples", {2, 8},
                                   {"[S] devices.md 7: CENTER_CORNER_2", "[A] devices.md 7: 2-sample multisampling",
                                    ours, "[S] devices.md 7: 1 and 4 alone", "[A] devices.md 7: 1 and 4 alone",
                                    "[A] devices.md 7: 2 samples are optional"}),
};

}  // namespace

std::span<const ProfileField> profile_fields() { return fields; }

std::string text_of(const ProfileField& field, const DeviceProfile& profile) {
    const int value = field.value(profile);
    switch (field.kind) {
        case FieldKind::boolean: return value != 0 ? "true" : "false";
        case FieldKind::integer: return std::to_string(value);
        case FieldKind::choice: break;
    }
    return std::string{field.choices[static_cast<std::size_t>(value)]};
}

}  // namespace strata::pipeline
