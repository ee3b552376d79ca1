// peeling/raster_state.h - how a device rasterizes a frame: the options' conventions as its memory has them.
//
// Tests    tests/peeling/origin_test.cpp
#pragma once
#include "peeling/render_options.h"
#include "pipeline/device/profile.h"

namespace strata::peeling {

// The state of a frame's rasterization: viewport, depth format, and in memory's rows where clip-space +y points and
// what the scissor leaves.
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

}  // namespace strata::peeling
