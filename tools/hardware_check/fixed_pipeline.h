// tools/hardware_check/fixed_pipeline.h - the test suite's default camera through the fixed pipeline, to the window.
//
// Rule     Eye (0, 0, -7) looking along +z, field of view 45 degrees, 4:3, near 1, far 200; w = z + 7. Window
//          x = 320 + 320 * 1.81066 X / w, y = 240 - 240 * 2.41421 Y / w, z = M (200 / 199) (1 - 1 / w); the viewport
//          adds 0.53125 to x and y. In binary64, rounded once. The chip's own z: the matrix holds S = M (200 / 199)
//          and 6 S, each rounded to binary32, and the vertex engine computes (z S + 6 S) (1 / (z + 7)) by its cuts
//          and its reciprocal (nv20_arithmetic.h).
// Source   chip-geometry.md 1.3, 5.4 and 6. The chip's z: [M] suite Depth_buffer_fixed_function at 24 bits, every
//          word of 327 quads but 24 of one strip, whose slope is steep (chip-depth.md 4).
// Tests    tests/tools/hardware_check/suites_test.cpp
#pragma once
#include "rasterizer/base/nv20_arithmetic.h"
#include "tools/hardware_check/shapes.h"

namespace strata::hardware_check {

inline constexpr float viewport_offset = 0.53125f;
inline constexpr double cotangent = 2.414213562373095;  // of 22.5 degrees

// Window z of world z, `units` (M) being the buffer's greatest value.
[[nodiscard]] constexpr double window_z(double z, double units) {
    return units * (200.0 / 199.0) * (1.0 - 1.0 / (z + 7.0));
}

// window_z by the arithmetic of the chip's vertex engine (rasterizer/base/nv20_arithmetic.h).
[[nodiscard]] constexpr float chip_window_z(float z, float units) {
    namespace nv20 = rasterizer::nv20;
    const auto scale = static_cast<float>(double{units} * 200.0 / 199.0);
    const float clip_z = nv20::sum<2>({nv20::multiply(z, scale), 6.0f * scale});
    return nv20::multiply(clip_z, nv20::reciprocal(nv20::sum<2>({z, 7.0f})));
}

// A world point in the window, without the viewport's offset.
[[nodiscard]] inline ClipVertex project(double x, double y, double z, double units, const std::array<float, 4>& color) {
    const double w = z + 7.0;
    return at(static_cast<float>(320.0 + 240.0 * cotangent * x / w),
              static_cast<float>(240.0 - 240.0 * cotangent * y / w), static_cast<float>(window_z(z, units)), color,
              static_cast<float>(w));
}

}  // namespace strata::hardware_check
