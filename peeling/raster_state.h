// peeling/raster_state.h - converts the options' conventions, which are those of the image, to the rasterization state
// of the device's memory.
//
// Tests    tests/peeling/origin_test.cpp
#pragma once
#include "peeling/render_options.h"
#include "pipeline/device/profile.h"

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

}  // namespace strata::peeling
