// rasterizer/coverage/window_corner.h - a vertex in window space, and the box of pixels that a triangle can cover.
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/coverage/edge.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {

// A vertex in window space, shared by all triangles that use it.
struct WindowCorner {
    // Snapped, y down, and moved if a sample is not at the centre (window.h): used for coverage, area and facing, and
    // for planes unless PlaneOrigin::unsnapped.
    SubpixelPoint p;
    // The position before snapping, in pixels.
    std::array<float, 2> unsnapped{};
    // Window z before polygon offset, in units of rules.window_z; binary32 1 / w.
    float z = 0, inverse_w = 1;
};

// Pixels [x0, x1) x [y0, y1), relative to the viewport's corner.
struct PixelBox {
    std::uint16_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
// Precondition: `box` is within the viewport, which is at most 65535 pixels wide and high.
[[nodiscard]] constexpr PixelBox in_viewport(const Rect& box, const Rect& viewport) noexcept {
    const auto x = [&](int column) { return static_cast<std::uint16_t>(column - viewport.x0); };
    const auto y = [&](int row) { return static_cast<std::uint16_t>(row - viewport.y0); };
    return {x(box.x0), y(box.y0), x(box.x1), y(box.y1)};
}

}  // namespace strata::rasterizer
