// rasterizer/coverage/pixel_steps.cpp - softpipe's thin lines as half-planes of pixels, and the corners of its wide
// lines and points (pixel_steps.h).
#include "rasterizer/coverage/pixel_steps.h"

#include <cmath>

#include "rasterizer/coverage/line_axis.h"

namespace strata::rasterizer {
namespace {

constexpr float greatest_px = 255.0f;
// Added to the right and upwards, so that centres on a side belong to one triangle.
constexpr float bias = 0.125f;

// The pixel of a position, cut toward zero.
[[nodiscard]] SubpixelPoint pixel_of(const WindowPosition& p) noexcept {
    return {static_cast<std::int32_t>(p[0]), static_cast<std::int32_t>(p[1])};
}

// The pixels (x, y) with right x + down y + constant >= 0, as the half-plane of their centres.
[[nodiscard]] HalfPlane of_pixels(std::int64_t right, std::int64_t down, std::int64_t constant, int bits) noexcept {
    const std::int64_t unit = std::int64_t{1} << bits;
    return {right, down, constant * unit - (right + down) * (unit / 2)};
}

}  // namespace

// After i of n steps a line is at the pixel j across with -n <= 2 (i m - j n) < n, where m is its extent across.
ShapeCoverage pixel_steps(const WindowPosition& a, const WindowPosition& b, int subpixel_bits) noexcept {
    const SubpixelPoint from = pixel_of(a), to = pixel_of(b);
    const LineAxis axis{from, to};
    ShapeCoverage line;
    line.box = {std::min(from.x, to.x), std::min(from.y, to.y), std::max(from.x, to.x) + 1, std::max(from.y, to.y) + 1};
    if (!set_run(axis, axis.is_x ? from.x : from.y, axis.is_x ? to.x : to.y, line.box)) return {};
    const std::int64_t n = axis.along, m = magnitude_of(axis.slope),
                       across = (axis.is_x ? to.y < from.y : to.x < from.x) ? -1 : 1;
    const std::int64_t step = 2 * m * axis.sign, row = -2 * n * across;
    const std::int64_t right = axis.is_x ? step : row, down = axis.is_x ? row : step;
    const std::int64_t at_start = right * from.x + down * from.y;
    line.side[0] = of_pixels(right, down, n - at_start, subpixel_bits);
    line.side[1] = of_pixels(-right, -down, n - 1 + at_start, subpixel_bits);
    return line;
}

QuadCorners wide_line_corners(const WindowPosition& a, const WindowPosition& b, float width_px) noexcept {
    const float half = 0.5f * std::min(width_px, greatest_px);
    const bool is_x = std::abs(a[0] - b[0]) > std::abs(a[1] - b[1]);
    const std::size_t along = is_x ? 0 : 1, across = 1 - along;
    const float to_side = is_x ? -bias : bias, back = a[along] < b[along] ? -0.5f : 0.5f;
    QuadCorners corner{a, a, b, b};
    for (std::size_t i = 0; i < corner.size(); ++i) {
        const float moved = corner[i][across] + (i % 2 == 0 ? -half : half);
        corner[i][across] = moved + to_side;
        corner[i][along] += back;
    }
    return corner;
}

QuadCorners point_corners(const WindowPosition& p, float size_px) noexcept {
    const float half = 0.5f * std::min(size_px, greatest_px);
    const float left = -half + bias, right = half + bias, upper = -half - bias, lower = half - bias;
    return {{{p[0] + left, p[1] + upper},
             {p[0] + left, p[1] + lower},
             {p[0] + right, p[1] + upper},
             {p[0] + right, p[1] + lower}}};
}

}  // namespace strata::rasterizer
