// tools/lab/hardware_check/drawing/suite.h - one function per suite, each in its own file.
#pragma once
#include "tools/lab/hardware_check/drawing/picture.h"

namespace strata::hardware_check {

// The result for a name that the suite does not have.
inline const Drawing unknown_name{std::nullopt, std::string{unknown_name_reason}};

// Each takes the name of a capture without folder and ending. Names come from files and are untrusted. Each throws
// Refused if the profile lacks what the picture needs.
Drawing draw_alpha_func(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_antialiasing(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_attrib_carryover(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_attrib_float(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_blend_surface(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_blend_tests(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_clear(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_color_mask_blend(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_combiner(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_depth_buffer(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_depth_buffer_fixed_function(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_depth_clamp(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_depth_function(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_edge_flag(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog_carryover(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog_coord_vec4(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog_exceptional_value(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog_gen(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog_inf_coord(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog_param(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_fog_vsh(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_front_face(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_lighting_normals(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_line_width(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_material_alpha(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_material_color(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_material_color_source(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_pixel_shader(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_pixel_shader_with(std::string_view name, const pipeline::DeviceProfile& profile,
                               const std::string& textures);
Drawing draw_point_params(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_point_size(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_set_vertex_data(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_shade_model(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_smoothing_control(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_specular(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_stencil(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_stencil_func(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_stipple(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_surface_clip(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_texture_perspective(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_texture_shadow_comparator(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_three_d_primitive(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_two_d_lines(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_vertex_shader_rounding(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_vertex_swizzle(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_viewport(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_w_buffering(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_w_param(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_window_clip(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_z_min_max_control(std::string_view name, const pipeline::DeviceProfile& profile);
Drawing draw_zpass_pixel_count(std::string_view name, const pipeline::DeviceProfile& profile);

}  // namespace strata::hardware_check
