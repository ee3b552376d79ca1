#include <algorithm>
#include <array>

#include "rasterizer/rules/hypotheses.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {

namespace {

using Subject = rasterizer::HypothesisSubject;

constexpr Subjects set_of(Subject subject) { return static_cast<Subjects>(1u << static_cast<unsigned>(subject)); }
// The sets of subjects in use. A suite has a subject if its pictures can distinguish values of an undetermined constant
// of that subject.
constexpr Subjects colors = set_of(Subject::color), coordinates = set_of(Subject::coordinates),
                   words = set_of(Subject::window_depth), quotients = set_of(Subject::texture_depth);

}  // namespace

// In ASCII order of the names.
std::span<const Suite> suites() {
    static constexpr std::array all{
        Suite{"2D_Lines", draw_two_d_lines},
        Suite{"3D_primitive", draw_three_d_primitive, colors},
        Suite{"Alpha_func", draw_alpha_func, colors},
        Suite{"Antialiasing_tests", draw_antialiasing},
        Suite{"Attrib_carryover", draw_attrib_carryover, colors},
        Suite{"Attrib_float", draw_attrib_float, colors},
        Suite{"Blend_surface", draw_blend_surface},
        Suite{"Blend_tests", draw_blend_tests},
        Suite{"Clear", draw_clear},
        Suite{"Color_mask_blend", draw_color_mask_blend, colors},
        Suite{"Combiner", draw_combiner, coordinates},
        Suite{"Depth_Clamp", draw_depth_clamp, coordinates},
        Suite{"Depth_buffer", draw_depth_buffer, words | colors},
        Suite{"Depth_buffer_fixed_function", draw_depth_buffer_fixed_function, words | colors},
        Suite{"Depth_function", draw_depth_function},
        Suite{"Edge_flag", draw_edge_flag, colors},
        Suite{"Fog", draw_fog, coordinates},
        Suite{"Fog_carryover", draw_fog_carryover},
        Suite{"Fog_coord_vec4", draw_fog_coord_vec4},
        Suite{"Fog_exceptional_value", draw_fog_exceptional_value},
        Suite{"Fog_gen", draw_fog_gen, coordinates},
        Suite{"Fog_inf_coord", draw_fog_inf_coord},
        Suite{"Fog_param", draw_fog_param},
        Suite{"Fog_vsh", draw_fog_vsh, coordinates},
        Suite{"Front_face", draw_front_face},
        Suite{"Lighting_normals", draw_lighting_normals, colors},
        Suite{"Line_width", draw_line_width, colors},
        Suite{"Material_alpha", draw_material_alpha, colors},
        Suite{"Material_color", draw_material_color},
        Suite{"Material_color_source", draw_material_color_source, coordinates},
        Suite{"Pixel_shader", draw_pixel_shader, quotients | coordinates, draw_pixel_shader_with},
        Suite{"Point_params", draw_point_params, coordinates},
        Suite{"Point_size", draw_point_size},
        Suite{"SetVertexData", draw_set_vertex_data},
        Suite{"Shade_model", draw_shade_model, colors | coordinates},
        Suite{"Smoothing_control", draw_smoothing_control, colors},
        Suite{"Specular", draw_specular, colors},
        Suite{"Stencil", draw_stencil},
        Suite{"Stencil_func", draw_stencil_func},
        Suite{"Stipple_tests", draw_stipple, colors},
        Suite{"Surface_clip", draw_surface_clip},
        Suite{"Texture_perspective", draw_texture_perspective, colors | coordinates},
        Suite{"Texture_shadow_comparator", draw_texture_shadow_comparator, quotients | coordinates},
        Suite{"Vertex_shader_rounding_tests", draw_vertex_shader_rounding},
        Suite{"Vertex_shader_swizzle_tests", draw_vertex_swizzle},
        Suite{"Viewport", draw_viewport},
        Suite{"W_buffering", draw_w_buffering, words | coordinates},
        Suite{"W_param", draw_w_param, coordinates},
        Suite{"Window_clip", draw_window_clip},
        Suite{"ZMinMaxControl", draw_z_min_max_control, colors},
        Suite{"ZPass_pixel_count", draw_zpass_pixel_count}};
    return all;
}

const Suite* find_suite(std::string_view name) {
    const auto all = suites();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Suite& s) { return s.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace strata::hardware_check
