// rasterizer/coverage/line_axis.h - what the rules of lines share: the longer direction of a line, and half-planes
// through a point.
#pragma once
#include <algorithm>
#include <cstdint>

#include "rasterizer/coverage/line_coverage.h"

namespace strata::rasterizer {

[[nodiscard]] constexpr std::int64_t magnitude_of(std::int64_t v) noexcept { return v < 0 ? -v : v; }

// The longer axis of a line, x if both are equal, with the line's direction along it.
struct LineAxis {
    bool is_x;
    std::int32_t sign;   // of the change along the axis
    std::int64_t along;  // its magnitude
    std::int64_t slope;  // the change across the axis, for a line that runs towards greater coordinates

    LineAxis(SubpixelPoint a, SubpixelPoint b) noexcept {
        const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
        is_x = magnitude_of(dx) >= magnitude_of(dy);
        sign = (is_x ? dx : dy) < 0 ? -1 : 1;
        along = magnitude_of(is_x ? dx : dy);
        slope = sign * (is_x ? dy : dx);
    }
};

// The half-plane of the points whose value right (x - through.x) + down (y - through.y) is at least -reach, or above it
// if the side does not own its ties.
[[nodiscard]] constexpr HalfPlane half_plane(SubpixelPoint through, std::int64_t right, std::int64_t down,
                                             std::int64_t reach, bool owns_ties) noexcept {
    return {right, down, reach - right * through.x - down * through.y - (owns_ties ? 0 : 1)};
}

// The pixels of the box of both ends, and `more` on every side.
[[nodiscard]] constexpr Rect pixels_around(SubpixelPoint a, SubpixelPoint b, int subpixel_bits, int more) noexcept {
    const auto first = [&](std::int32_t p, std::int32_t q) { return (std::min(p, q) >> subpixel_bits) - more; };
    const auto end = [&](std::int32_t p, std::int32_t q) { return (std::max(p, q) >> subpixel_bits) + more + 1; };
    return {first(a.x, b.x), first(a.y, b.y), end(a.x, b.x), end(a.y, b.y)};
}

// Sets the columns of a line along x, or the rows of one along y, from the pixel `from` to the pixel before `to`, in
// either direction; false if there is none.
[[nodiscard]] inline bool set_run(const LineAxis& axis, int from, int to, Rect& box) noexcept {
    int& first = axis.is_x ? box.x0 : box.y0;
    int& end = axis.is_x ? box.x1 : box.y1;
    first = axis.sign > 0 ? from : to + 1;
    end = axis.sign > 0 ? to : from + 1;
    return first < end;
}

}  // namespace strata::rasterizer
