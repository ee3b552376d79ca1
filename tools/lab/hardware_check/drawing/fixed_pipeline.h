// tools/lab/hardware_check/drawing/fixed_pipeline.h - the transform of the test suite's default camera with the
// fixed-function pipeline, to the window.
//
// Rule     Eye (0, 0, -7) looking along +z, field of view 45 degrees, 4:3, near 1, far 200; w = z + 7. Window x = 320 +
//          320 * 1.81066 X / w, y = 240 - 240 * 2.41421 Y / w, z = M (200 / 199) (1 - 1 / w); the viewport adds 0.53125
//          to x and y. In binary64, rounded once. The z of the NV2A chip: the matrix contains S = M (200 / 199) and 6
//          S, each rounded to binary32, and the vertex engine computes (z S + 6 S) (1 / (z + 7)) with its truncations
//          and its reciprocal (rasterizer/base/nv20_arithmetic.h). A CompositeMatrix contains all rows of another
//          camera: one dot product per row, then x, y and z times the reciprocal of w, then the viewport's offset.
// Source   rasterizer/reference/chip-geometry.md 1.3, 5.4 and 6. The chip's z: [M] suite Depth_buffer_fixed_function at
//          24 bits, every word of 327 quads except 24 of one strip, whose slope is steep
//          (rasterizer/reference/chip-depth.md 4). Its x and y: rasterizer/reference/chip-float-depth.md 9.2.
// Tests    tests/tools/lab/hardware_check/suites_test.cpp
#pragma once
#include "rasterizer/base/nv20_arithmetic.h"
#include "tools/lab/hardware_check/drawing/shapes.h"

namespace strata::hardware_check {

inline constexpr float viewport_offset = 0.53125f;
inline constexpr double cotangent = 2.414213562373095;  // cotangent of 22.5 degrees

// Window z of world z; `units` (M) is the buffer's greatest value.
[[nodiscard]] constexpr double window_z(double z, double units) {
    return units * (200.0 / 199.0) * (1.0 - 1.0 / (z + 7.0));
}

// window_z with the arithmetic of the chip's vertex engine (rasterizer/base/nv20_arithmetic.h).
[[nodiscard]] constexpr float chip_window_z(float z, float units) {
    namespace nv20 = rasterizer::nv20;
    const auto scale = static_cast<float>(double{units} * 200.0 / 199.0);
    const float clip_z = nv20::sum<2>({nv20::multiply(z, scale), 6.0f * scale});
    return nv20::multiply(clip_z, nv20::reciprocal(nv20::sum<2>({z, 7.0f})));
}

// The scales of clip y and x as the test has them in binary32: the cotangent of half of f32(pi / 4), which is one step
// below the rounded cotangent of 22.5 degrees, and the same divided by 4:3.
inline constexpr float chip_cotangent = 0x1.3504f2p+1f, chip_cotangent_x = chip_cotangent / (4.0f / 3.0f);

// The matrix that the test sets in the fixed-function pipeline: rows for x, y, z and w, each with the factors of a
// point's x, y, z and w (1 in the world).
struct CompositeMatrix {
    std::array<float, 4> x, y, z, w;
};

// One dot product per row, with the vertex engine's arithmetic.
[[nodiscard]] constexpr std::array<float, 4> chip_product(const CompositeMatrix& m, const std::array<float, 4>& point) {
    namespace nv20 = rasterizer::nv20;
    const auto dot = [&](const std::array<float, 4>& row) {
        return nv20::sum<4>({nv20::multiply(row[0], point[0]), nv20::multiply(row[1], point[1]),
                             nv20::multiply(row[2], point[2]), nv20::multiply(row[3], point[3])});
    };
    return {dot(m.x), dot(m.y), dot(m.z), dot(m.w)};
}

// x, y and z times the chip's reciprocal of w; w is unchanged.
[[nodiscard]] constexpr std::array<float, 4> chip_quotient(const std::array<float, 4>& p) {
    namespace nv20 = rasterizer::nv20;
    const float inverse = nv20::reciprocal(p[3]);
    return {nv20::multiply(p[0], inverse), nv20::multiply(p[1], inverse), nv20::multiply(p[2], inverse), p[3]};
}

// The window's x, y and z of a point with the vertex engine's arithmetic, and the viewport's offset in x and y; the
// fourth component is w.
[[nodiscard]] constexpr std::array<float, 4> chip_window_point(const CompositeMatrix& m,
                                                               const std::array<float, 4>& point,
                                                               float offset = viewport_offset) {
    const auto [x, y, z, w] = chip_quotient(chip_product(m, point));
    return {rasterizer::nv20::sum<2>({x, offset}), rasterizer::nv20::sum<2>({y, offset}), z, w};
}

// A world point in the window, without the viewport's offset.
[[nodiscard]] inline ClipVertex project(double x, double y, double z, double units, const std::array<float, 4>& color) {
    const double w = z + 7.0;
    return at(static_cast<float>(320.0 + 240.0 * cotangent * x / w),
              static_cast<float>(240.0 - 240.0 * cotangent * y / w), static_cast<float>(window_z(z, units)), color,
              static_cast<float>(w));
}

}  // namespace strata::hardware_check
