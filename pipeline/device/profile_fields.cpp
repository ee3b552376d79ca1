#include "pipeline/device/profile_fields.h"

#include <utility>

#include "rasterizer/base/enum_values.h"

namespace strata::pipeline {
namespace {

using Names = std::span<const std::string_view>;
using Sources = std::array<std::string_view, 4>;
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

template <auto member>
constexpr ProfileField row(std::string_view key, FieldKind kind, const Sources& source) {
    ProfileField field;
    field.key = key;
    field.kind = kind;
    field.value = [](const Profile& p) { return static_cast<int>(at<member>(p)); };
    field.set = [](Profile& p, int value) {
        at<member>(p) = static_cast<std::remove_reference_t<decltype(at<member>(p))>>(value);
    };
    field.source = source;
    return field;
}

template <auto member>
constexpr ProfileField boolean(std::string_view key, const Sources& source) {
    return row<member>(key, FieldKind::boolean, source);
}

template <auto member>
constexpr ProfileField choice_of(std::string_view key, Names names, const Sources& source) {
    ProfileField field = row<member>(key, FieldKind::choice, source);
    field.choices = names;
    field.highest = static_cast<int>(names.size()) - 1;
    return field;
}

// The values of an enum, by their identifiers: a new one is in the table at once.
template <auto member>
constexpr ProfileField choice(std::string_view key, const Sources& source) {
    using Enum = std::remove_cvref_t<decltype(at<member>(std::declval<Profile&>()))>;
    return choice_of<member>(key, enum_names<Enum>, source);
}

struct Range {
    int lowest, highest, step = 1;
};

template <auto member>
constexpr ProfileField integer(std::string_view key, Range range, const Sources& source) {
    ProfileField field = row<member>(key, FieldKind::integer, source);
    field.lowest = range.lowest;
    field.highest = range.highest;
    field.step = range.step;
    return field;
}

// 16 to 24 and full_double, as the names above count them.
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
constexpr std::string_view drawn = "[M] tools/bench/README.md: Mesa 22.3 draws the same fragments";
constexpr std::string_view opengl = "[D] OpenGL 4.5, which Mesa 22.3 implements";
constexpr std::string_view unused = "[A] of path window_z, which this profile lacks";
constexpr std::string_view unweighted = "[A] of 8-bit colour weights, which this profile lacks";
constexpr std::string_view unmeasured = "[A] as geforce8_dx101";

// Sources: [D] documented, [M] measured by others, [A] our assumption; then the section of hardware.md.
constexpr std::array fields{
    integer<&Rules::subpixel_bits>(
        "raster.subpixel_bits", {4, 12, 4},
        {"[M] 1: hardware tests on NV2A; the minimum OpenGL allows", "[D] 1: D3D 11.3 3.4.1", ours, drawn}),
    choice<&Rules::snap>("raster.snap",
                         {"[M] 1: 0.5624 lands on 0.5", "[A] 1: 0.6 ULP is allowed, the ideal is taken", ours, drawn}),
    choice<&Rules::tie_rule>("raster.tie_rule",
                             {"[M] 1: 298,500 of 298,500 pixels", "[D] 1: D3D 11.3 3.4.2.1", ours, drawn}),
    integer<&Rules::guard_band_px>("raster.guard_band_px", {1, 32768},
                                   {"[A] 1: the fixed-point range", "[D] 1: D3D 11.3 15.6.1", ours,
                                    "[A] Mesa cuts at the viewport: compare scenes that lie inside it"}),
    choice<&Rules::z_clip>("raster.z_clip", {"[M] 1: fragments outside zmin..zmax are discarded",
                                             "[D] 1: D3D 11.3 15.4", ours, "[D] OpenGL 4.5 13.7"}),
    choice<&Rules::w_clip>("raster.w_clip", {"[A] 1", "[D] 1: D3D 11.3 15.4", ours, "[D] OpenGL 4.5 13.7"}),
    choice<&Rules::w_divide>("raster.w_divide", {"[D] 1: decisions.md 1", "[A] decisions.md 1", ours, drawn}),
    choice<&Rules::viewport>("raster.viewport", {"[A] decisions.md 1", "[A] decisions.md 1", ours,
                                                 "[A] either: half of 1024 scales exactly"}),
    choice<&Rules::plane_origin>("raster.plane_origin",
                                 {"[M] 1: nxdk vertex_shader_rounding_tests", "[D] 1: D3D 11.3 15.16.2", ours,
                                  "[M] Mesa 22.3: planes start at the float32 positions"}),
    choice<&Rules::window_z>("raster.window_z", {"[M] nv2a-geometry.md 4", "[A] decisions.md 1", ours, unmeasured}),
    choice<&Rules::depth_path>(
        "raster.depth_path",
        {"[M] nv2a-depth.md 1: 4,927,976 of 4,927,976 words", "[A] 2: D3D 11.3 16.3.1 fixes all but the last bit", ours,
         "[A] Mesa rounds each step of its plane; the exact plane is taken"}),
    choice<&Rules::depth_rounding>("raster.depth_rounding",
                                   {"[M] 2: NV2A floors integer depth", "[D] 2: D3D 11.3 17.10", ours, unmeasured}),
    choice<&Rules::offset_unit>("raster.offset_unit", {"[A] 1: one code", "[D] 1: D3D 11.3 15.10", ours, unmeasured}),
    choice<&Rules::color>("raster.color", {"[M] nv2a-fragment.md R6: 489,784 of 489,788 pixels",
                                           "[A] 11: exact plane, one rounding", ours, unmeasured}),
    interpolant_bits("raster.interpolant_bits", {"[A] 5: binary32", "[A] decisions.md 1: binary32", ours, unmeasured}),
    choice<&Hypothesis::divide>("raster.divide", {"[A] 5: rounded once; nv2a-geometry.md 2 knows no bit-exact rule",
                                                  "[A] decisions.md 1: rounded once", ours, unmeasured}),
    choice<&Hypothesis::window_z>("raster.window_z_rule",
                                  {"[M] nv2a-depth.md 1: 4,927,976 of 4,927,976 words", unused, unused, unused}),
    integer<&Hypothesis::reciprocal_bits>("raster.reciprocal_bits", {24, 30},
                                          {"[M] nv2a-depth.md 4: fits three areas of four", unused, unused, unused}),
    integer<&Hypothesis::sum_bits>("raster.sum_bits", {24, 29},
                                   {"[M] nv2a-depth.md 1: a 29-bit aligned add", unused, unused, unused}),
    boolean<&Hypothesis::quantize_reference>(
        "raster.quantize_reference",
        {"[M] nv2a-geometry.md 3.2: R is cut like a depth write", "[D] 4: D3D 11.3 22.4.19", ours, unmeasured}),
    choice<&Hypothesis::plane_anchor>("raster.plane_anchor",
                                      {"[A] either is in use", "[A] either is in use", ours, "[A] either is in use"}),
    integer<&Interpolation::vertex_color_bits>(
        "raster.vertex_color_bits", {9, 24},
        {"[M] interpolation_hypothesis.h: all of 3,944 greys", unweighted, unweighted, unweighted}),
    choice<&Interpolation::perspective_color>(
        "raster.perspective_color",
        {"[A] nv2a-fragment.md 8: equal w alone is measured", unweighted, unweighted, unweighted}),
    choice<&Interpolation::texture_coordinates>(
        "raster.texture_coordinates",
        {"[M] cut_coordinates.h: 41,274 coordinates, for equal w", "[D] 3: D3D 11.3 15.10", ours, unmeasured}),
    choice<&Profile::alpha_test>(
        "alpha_test", {"[M] 7: nv2a-fragment.md R7, 16 of 16", "[D] 7: ARB_color_buffer_float", ours, unmeasured}),
    choice<&Profile::blend_rounding>("blend_rounding", {"[M] 8: nv2a-fragment.md R1, 1,673 of 1,673",
                                                        "[A] 8: the contract that NV2A confirms", ours, unmeasured}),
    choice<&Profile::half_rounding>(
        "half_rounding",
        {"[A] 8: no float targets", "[A] 8: GL and NV round to nearest, D3D allows zero", ours, unmeasured}),
    choice<&Profile::min_max_nan>("min_max_nan", {"[A] 8: no float targets",
                                                  "[A] 8: D3D 11.3 22.10.10, envytools fp32_minmax", ours, unmeasured}),
    choice<&Profile::denormals>(
        "denormals", {"[A] 8: no float targets", "[A] 8: flushed in and out, as the shader does", ours, unmeasured}),
    choice<&Profile::texture_filter>("texture_filter",
                                     {"[A] decisions.md 1: one rounding to 8 bits",
                                      "[A] decisions.md 1: binary32 in a fixed order", ours, unmeasured}),
    boolean<&Profile::has_d16>("has_d16", {"[M] 2: Z16", "[M] 2: Z16 only from G200 on", ours, opengl}),
    boolean<&Profile::has_d24>("has_d24", {"[M] 2: Z24S8", "[M] 2: Z24S8", ours, opengl}),
    boolean<&Profile::has_d32f>("has_d32f",
                                {"[M] 2: no such format", "[M] 2: Z32F among G80's depth formats", ours, opengl}),
    boolean<&Profile::has_d16f>(
        "has_d16f", {"[M] nv2a-geometry.md 4: 98 pictures", "[M] 2: not among G80's depth formats", ours, opengl}),
    boolean<&Profile::has_narrow_surfaces>("has_narrow_surfaces",
                                           {"[M] nv2a-fragment.md R10", "[A] 2: none is emulated", ours, opengl}),
    boolean<&Profile::has_float_targets>(
        "has_float_targets", {"[D] 8: NV30 had the first, without blending", "[D] 8: Bavoil and Myers", ours, opengl}),
    boolean<&Profile::has_unclamped_depth_clear>(
        "has_unclamped_depth_clear",
        {"[D] 2: NV_depth_buffer_float", "[D] 2: NV_depth_buffer_float", ours, "[A] as geforce8_dx101"}),
    boolean<&Profile::has_fragment_programs>(
        "has_fragment_programs",
        {"[D] decisions.md 4: combiners and texture shaders", "[D] decisions.md 4", ours, opengl}),
    boolean<&Profile::has_separate_alpha_blend>(
        "has_separate_alpha_blend",
        {"[M] 6: one factor pair and one equation", "[M] 6: register fields since NV30 and NV40", ours, opengl}),
    boolean<&Profile::has_independent_blend>(
        "has_independent_blend",
        {"[M] 6", "[M] 8: a shared equation; per target from GT215 (DirectX 10.1) on", ours, opengl}),
    boolean<&Profile::has_two_sided_stencil>("has_two_sided_stencil", {"[D] 7: EXT_stencil_two_side came with NV30",
                                                                       "[D] 7: STENCIL_TWO_SIDE_ENABLE", ours, opengl}),
    boolean<&Profile::has_depth_clamp>(
        "has_depth_clamp", {"[M] 1: clamped when depth clamp is on", "[D] 1: NV_depth_clamp", ours, opengl}),
    boolean<&Profile::has_depth_replace>(
        "has_depth_replace",
        {"[D] 5: NV_texture_shader", "[D] decisions.md 4: refused", ours, "[A] as geforce8_dx101"}),
    boolean<&Profile::has_sequential_depth_units>(
        "has_sequential_depth_units",
        {"[A] decisions.md 4: an emulator extension", "[A] decisions.md 4: an emulator extension", ours,
         "[A] decisions.md 4: an emulator extension"}),
    boolean<&Profile::has_ordered_rmw>("has_ordered_rmw",
                                       {"[A] decisions.md 4", "[A] decisions.md 4", ours, "[A] decisions.md 4"}),
    boolean<&Profile::has_signed_blend>(
        "has_signed_blend", {"[M] nv2a-fragment.md R3: 478 of 478 pictures", "[D] 8: no such equation", ours, opengl}),
    integer<&Profile::max_render_targets>(
        "max_render_targets", {1, 8},
        {"[D] 8: one colour buffer", "[D] 8: D3D 11.3 17.14", ours, "[M] Mesa 22.3: GL_MAX_DRAW_BUFFERS"}),
    integer<&Profile::max_texture_units>("max_texture_units", {1, 32},
                                         {"[D] 5: four texture shader stages", "[A] sixteen samplers of Direct3D 10",
                                          ours, "[M] Mesa 22.3: GL_MAX_TEXTURE_IMAGE_UNITS"}),
    integer<&Profile::max_viewport_px>("max_viewport_px", {1, 16384},
                                       {"[A] 1: never found documented", "[A] 1: the limit of Direct3D 10.0", ours,
                                        "[M] Mesa 22.3: GL_MAX_VIEWPORT_DIMS"}),
    integer<&Profile::max_samples>(
        "max_samples", {1, 8},
        {"[A] 4-sample multisampling", "[A] 8-sample multisampling", ours, "[M] Mesa 22.3: GL_MAX_SAMPLES"}),
};

}  // namespace

std::span<const ProfileField> profile_fields() { return fields; }

std::string text_of(const ProfileField& field, const DeviceProfile& profile) {
    const int value = field.value(profile);
    switch (field.kind) {
        case FieldKind::boolean: return value != 0 ? "true" : "false";
        case FieldKind::integer: return std::to_string(value);
        case FieldKind::choice: return std::string{field.choices[static_cast<std::size_t>(value)]};
    }
    return {};  // unreachable: the enum is closed
}

}  // namespace strata::pipeline
