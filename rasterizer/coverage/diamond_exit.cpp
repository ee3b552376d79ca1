// rasterizer/coverage/diamond_exit.cpp - OpenGL's aliased lines as half-planes and a run of pixels (diamond_exit.h).
//
// A line along x crosses the middle of each of its columns inside of a diamond, and never leaves a diamond before its
// middle. So all columns between those of the ends have a fragment; whether the columns of the ends do depends on which
// side of the middle the end is, and on its diamond. Rows are down here: the move is by (-e, +e^2).
#include "rasterizer/coverage/diamond_exit.h"

#include <cmath>

#include "rasterizer/coverage/line_axis.h"

namespace strata::rasterizer {
namespace {

// An end of a line, moved: its pixel, and where in the pixel it is.
struct MovedEnd {
    SubpixelPoint from_centre;  // of its pixel
    int pixel;                  // the column of a line along x, the row of one along y
    std::int32_t half;          // half a pixel in subpixels

    MovedEnd(SubpixelPoint p, const LineAxis& axis, int bits) noexcept {
        const int column = (p.x - 1) >> bits, row = p.y >> bits;
        const SubpixelPoint centre = pixel_centre(column, row, bits);
        from_centre = {p.x - centre.x, p.y - centre.y};
        pixel = axis.is_x ? column : row;
        half = 1 << (bits - 1);
    }
    // Beyond the middle in the line's direction: an end exactly in the middle is moved to its left or below it.
    [[nodiscard]] bool is_past_middle(const LineAxis& axis) const noexcept {
        if (axis.is_x) return axis.sign > 0 ? from_centre.x > 0 : from_centre.x <= 0;
        return axis.sign > 0 ? from_centre.y >= 0 : from_centre.y < 0;
    }
    // A point on the diamond's border moves left: into the diamond on its right side.
    [[nodiscard]] bool is_in_diamond() const noexcept {
        const std::int64_t distance = magnitude_of(from_centre.x) + magnitude_of(from_centre.y);
        return distance < half || (distance == half && from_centre.x > 0);
    }
};

// OpenGL rounds the width to the nearest integer; 0 becomes 1.
[[nodiscard]] std::int64_t rounded_width(float px) noexcept {
    return px < 1.0f ? 1 : static_cast<std::int64_t>(std::floor(px + 0.5f));
}

}  // namespace

ShapeCoverage diamond_exit(SubpixelPoint a, SubpixelPoint b, float width_px, int subpixel_bits) noexcept {
    const LineAxis axis{a, b};
    if (axis.along == 0) return {};
    const std::int64_t width = rounded_width(width_px);
    ShapeCoverage line;
    line.box = pixels_around(a, b, subpixel_bits, static_cast<int>(width / 2) + 1);
    // The ends are those of the lowest (leftmost) copy.
    const auto shift = static_cast<std::int32_t>((width - 1) << (subpixel_bits - 1));
    const auto lowest = [&](SubpixelPoint p) {
        return axis.is_x ? SubpixelPoint{p.x, p.y + shift} : SubpixelPoint{p.x - shift, p.y};
    };
    const MovedEnd start{lowest(a), axis, subpixel_bits}, end{lowest(b), axis, subpixel_bits};
    const bool has_first = !start.is_past_middle(axis) || start.is_in_diamond();
    const bool has_last = end.is_past_middle(axis) && !end.is_in_diamond();
    const int from = start.pixel + (has_first ? 0 : axis.sign), to = end.pixel + (has_last ? axis.sign : 0);
    if (!set_run(axis, from, to, line.box)) return {};
    const std::int64_t reach = axis.along * width * (std::int64_t{1} << (subpixel_bits - 1));
    if (axis.is_x) {
        // The move lowers a line that rises to the right in memory's rows, and raises one that falls.
        const bool is_lowered = axis.slope >= 0;
        line.side[0] = half_plane(a, -axis.slope, axis.along, reach, !is_lowered);
        line.side[1] = half_plane(a, axis.slope, -axis.along, reach, is_lowered);
    } else {
        line.side[0] = half_plane(a, -axis.along, axis.slope, reach, false);
        line.side[1] = half_plane(a, axis.along, -axis.slope, reach, true);
    }
    return line;
}

}  // namespace strata::rasterizer
