// peeling/raster_state.h - converts the options' conventions, which are those of the image, to the rasterization state
// of the device's memory.
//
// Tests    tests/peeling/frame/origin_test.cpp
#pragma once
#include "peeling/programs/algorithm_options.h"
#include "peeling/render_options.h"
#include "pipeline/device/profile.h"
#include "pipeline/vertices/draw_list.h"

namespace strata::peeling {

// The rasterization state of a frame: viewport and depth format, and, in rows of memory, the direction of clip-space +y
// and the scissor.
[[nodiscard]] inline rasterizer::RasterState raster_state(const RenderOptions& options,
                                                          const pipeline::DeviceProfile& profile) noexcept {
    using enum rasterizer::YDirection;
    rasterizer::RasterState state = options.raster;
    state.viewport = {0, 0, options.width, options.height};
    state.depth_format = profile.depth_buffer(options.depth);
    if (profile.origin == pipeline::Origin::upper_left) return state;
    state.y_direction = state.y_direction == up ? down : up;
    if (state.scissor) {
        const rasterizer::Rect shown = *state.scissor;
        state.scissor = {shown.x0, options.height - shown.y1, shown.x1, options.height - shown.y0};
    }
    return state;
}

// The uniforms with which a program computes the distance from the eye (peeling/reference/algorithms.md 18.2), in
// binary64, each rounded once. Precondition: rows z and w of the projection depend on z alone.
[[nodiscard]] inline EyeDistance eye_distance(const pipeline::View& view,
                                              const rasterizer::RasterState& state) noexcept {
    const double near = state.depth_near, far = state.depth_far;
    const bool is_half = state.clip_depth == rasterizer::ClipDepth::minus_one_to_one;
    const double scale = is_half ? (far - near) / 2 : far - near, middle = is_half ? (far + near) / 2 : near;
    const pipeline::Matrix& p = view.projection;  // p[column][row]
    const double z_of_z = p[2][2], z_of_1 = p[3][2], w_of_z = p[2][3], w_of_1 = p[3][3];
    return {static_cast<float>(z_of_1 * scale + middle * w_of_1), static_cast<float>(-w_of_1),
            static_cast<float>(-z_of_z * scale - middle * w_of_z), static_cast<float>(w_of_z)};
}

}  // namespace strata::peeling
