#include <algorithm>
#include <array>

#include "rasterizer/rules/hypotheses.h"
#include "tools/hardware_check/suite.h"

namespace strata::hardware_check {

namespace {

using rasterizer::Subject;

// The set of two subjects, which may be the same one.
constexpr Subjects set_of(Subject a, Subject b) {
    return static_cast<Subjects>(1u << static_cast<unsigned>(a) | 1u << static_cast<unsigned>(b));
}
// The sets of subjects that occur. A suite has one if its pictures can decide between values of an
// open constant on that subject.
constexpr Subjects colors = set_of(Subject::color, Subject::color);
constexpr Subjects coordinates = set_of(Subject::coordinates, Subject::coordinates);
constexpr Subjects quotients_and_coordinates = set_of(Subject::texture_depth, Subject::coordinates);
constexpr Subjects words = set_of(Subject::window_depth, Subject::window_depth);
constexpr Subjects words_and_colors = set_of(Subject::window_depth, Subject::color);

}  // namespace

// In ASCII order of the names.
std::span<const Suite> suites() {
    static constexpr std::array all{
        Suite{"Alpha_func", draw_alpha_func, colors},
        Suite{"Blend_surface", draw_blend_surface},
        Suite{"Blend_tests", draw_blend_tests},
        Suite{"Clear", draw_clear},
        Suite{"Color_mask_blend", draw_color_mask_blend, colors},
        Suite{"Combiner", draw_combiner, coordinates},
        Suite{"Depth_Clamp", draw_depth_clamp},
        Suite{"Depth_buffer", draw_depth_buffer, words_and_colors},
        Suite{"Depth_buffer_fixed_function", draw_depth_buffer_fixed_function, words_and_colors},
        Suite{"Depth_function", draw_depth_function},
        Suite{"Front_face", draw_front_face},
        Suite{"Pixel_shader", draw_pixel_shader, quotients_and_coordinates, draw_pixel_shader_with},
        Suite{"Shade_model", draw_shade_model, colors},
        Suite{"Stencil", draw_stencil},
        Suite{"Stencil_func", draw_stencil_func},
        Suite{"Surface_clip", draw_surface_clip},
        Suite{"Texture_perspective", draw_texture_perspective, set_of(Subject::color, Subject::coordinates)},
        Suite{"Texture_shadow_comparator", draw_texture_shadow_comparator, quotients_and_coordinates},
        Suite{"Vertex_shader_rounding_tests", draw_vertex_shader_rounding},
        Suite{"Viewport", draw_viewport},
        Suite{"W_buffering", draw_w_buffering, words},
        Suite{"W_param", draw_w_param},
        Suite{"Window_clip", draw_window_clip},
        Suite{"ZMinMaxControl", draw_z_min_max_control},
        Suite{"ZPass_pixel_count", draw_zpass_pixel_count}};
    return all;
}

const Suite* find_suite(std::string_view name) {
    const auto all = suites();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Suite& s) { return s.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace strata::hardware_check
