// rasterizer/coverage/line_coverage.cpp - the half-planes and boxes of lines and smooth polygons, and the boxes of
// points (line_coverage.h).
#include "rasterizer/coverage/line_coverage.h"

#include <algorithm>
#include <bit>

#include "rasterizer/coverage/diamond_exit.h"
#include "rasterizer/coverage/line_axis.h"
#include "rasterizer/coverage/pixel_steps.h"
#include "rasterizer/coverage/sample_rectangle.h"
#include "rasterizer/coverage/shifted_ends.h"

namespace strata::rasterizer {
namespace {

// The first pixel whose centre is at least c, and one past the last whose centre is at most c.
[[nodiscard]] constexpr int first_centre(std::int64_t c, int bits) noexcept {
    return static_cast<int>((c + (1 << (bits - 1)) - 1) >> bits);
}
[[nodiscard]] constexpr int end_centre(std::int64_t c, int bits) noexcept {
    return static_cast<int>((c - (1 << (bits - 1))) >> bits) + 1;
}

// A rectangle along the line. Half its width is the register times an estimate of the line's length, max + min / 2,
// over the length; right and upper sides own their ties.
[[nodiscard]] ShapeCoverage band(SubpixelPoint a, SubpixelPoint b, const RasterState& state, int bits) noexcept {
    const int width = register_of_size(state.line_width_px);
    const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
    if (width == 0 || (dx == 0 && dy == 0)) return {};
    const std::int64_t most = std::max(magnitude_of(dx), magnitude_of(dy)),
                       least = std::min(magnitude_of(dx), magnitude_of(dy));
    const std::int64_t reach = (std::int64_t{width} << (bits - 4)) * (2 * most + least);
    const auto side = [](SubpixelPoint through, std::int64_t right, std::int64_t down, std::int64_t most_before) {
        return half_plane(through, right, down, most_before, right < 0 || (right == 0 && down > 0));
    };
    return {
        {side(a, -2 * dy, 2 * dx, reach), side(a, 2 * dy, -2 * dx, reach), side(a, dx, dy, 0), side(b, -dx, -dy, 0)},
        pixels_around(a, b, bits, (width + 15) >> 4)};
}

// A pixel per column (row) from that of the first end to the one before that of the second; the pixel in which the line
// crosses the middle of the column. A coordinate on a pixel's border belongs to the right and the upper pixel.
[[nodiscard]] ShapeCoverage thin(SubpixelPoint a, SubpixelPoint b, int bits) noexcept {
    const LineAxis axis{a, b};
    const auto pixel = [&](SubpixelPoint p) { return axis.is_x ? p.x >> bits : (p.y - 1) >> bits; };
    ShapeCoverage line;
    line.box = pixels_around(a, b, bits, 1);
    if (!set_run(axis, pixel(a), pixel(b), line.box)) return {};
    // Across the line: a centre is at most half a pixel away, exactly half a pixel on one side only.
    const std::int64_t half = axis.along << (bits - 1), slope = axis.slope;
    if (axis.is_x) {
        line.side[0] = half_plane(a, -slope, axis.along, half, true);
        line.side[1] = half_plane(a, slope, -axis.along, half, false);
    } else {
        line.side[0] = half_plane(a, -axis.along, slope, half, true);
        line.side[1] = half_plane(a, axis.along, -slope, half, false);
    }
    return line;
}

[[nodiscard]] bool is_thin(const RasterState& state, const RasterRules& rules) noexcept {
    return rules.lines == LineRule::band && state.line_style == LineStyle::thin;
}

// Columns [columns.x0, columns.x1) whose point, `first` in the first column, is covered.
[[nodiscard]] RowSpan span_from(const ShapeCoverage& shape, RowSpan columns, SubpixelPoint first, int bits) noexcept {
    std::int64_t begin = 0, end = columns.x1 - columns.x0;
    for (const HalfPlane& side : shape.side) {
        const std::int64_t value = side.at(first), step = side.right * (std::int64_t{1} << bits);
        if (step > 0 && value < 0) begin = std::max(begin, (-value + step - 1) / step);
        if (step <= 0 && value < 0) return {columns.x0, columns.x0};
        if (step < 0) end = std::min(end, value / -step + 1);
    }
    return {columns.x0 + static_cast<int>(std::min(begin, end)), columns.x0 + static_cast<int>(end)};
}

// Sample k of a pixel, in eighths from its upper left corner: (k, 3 k mod 8).
[[nodiscard]] constexpr SubpixelPoint smooth_sample(int k, int x, int y, int bits) noexcept {
    const int eighth = 1 << (bits - 3);
    return {(x << bits) + k * eighth, (y << bits) + 3 * k % smooth_samples * eighth};
}

}  // namespace

ShapeCoverage line_coverage(const WindowCorner& a, const WindowCorner& b, const RasterState& state,
                            const RasterRules& rules) noexcept {
    const int bits = rules.subpixel_bits;
    if (rules.lines == LineRule::pixel_steps) return pixel_steps(a.unsnapped, b.unsnapped, bits);
    if (rules.lines == LineRule::shifted_ends) return shifted_ends(a.unsnapped, b.unsnapped, state.line_width_px, bits);
    if (state.sample && rules.lines == LineRule::diamond_exit)
        return sample_rectangle(a.p, b.p, state.line_width_px, bits);
    if (rules.lines == LineRule::diamond_exit) return diamond_exit(a.p, b.p, state.line_width_px, bits);
    return is_thin(state, rules) ? thin(a.p, b.p, bits) : band(a.p, b.p, state, bits);
}

ShapeCoverage polygon_coverage(const std::array<SubpixelPoint, 3>& p, const RasterRules& rules) noexcept {
    const TriangleEdges edges{p, rules.tie_rule};
    ShapeCoverage polygon;
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = edges.edge(i);
        polygon.side[i] = {edge.step_x(), edge.step_y(), edge.at({0, 0}) - edges.tie(i)};
    }
    const Rect first = pixels_around(p[0], p[1], rules.subpixel_bits, 0),
               second = pixels_around(p[1], p[2], rules.subpixel_bits, 0);
    polygon.box = {std::min(first.x0, second.x0), std::min(first.y0, second.y0), std::max(first.x1, second.x1),
                   std::max(first.y1, second.y1)};
    return polygon;
}

// Thin lines take their values half a pixel further along than the centre.
TriangleEdges line_edges(SubpixelPoint a, SubpixelPoint b, const RasterState& state,
                         const RasterRules& rules) noexcept {
    if (!is_thin(state, rules)) return TriangleEdges::along(a, b, {b.x - a.x, b.y - a.y});
    const LineAxis axis{a, b};
    const std::int32_t x = axis.is_x ? axis.sign : 0, y = axis.is_x ? 0 : axis.sign,
                       half = 1 << (rules.subpixel_bits - 1);
    return TriangleEdges::along({a.x - x * half, a.y - y * half}, {b.x - x * half, b.y - y * half}, {x, y});
}

double line_overshoot(SubpixelPoint a, SubpixelPoint b, const RasterState& state, const RasterRules& rules) noexcept {
    if (rules.lines == LineRule::band && state.line_style != LineStyle::smooth) return 0.0;
    const double pixels = 2.0 + state.line_width_px;
    return 2.0 * pixels * (1 << rules.subpixel_bits) / static_cast<double>(LineAxis{a, b}.along);
}

bool may_cover(const ShapeCoverage& shape, const Rect& rect, int subpixel_bits) noexcept {
    return std::ranges::all_of(shape.side, [&](const HalfPlane& side) {
        const int x = side.right > 0 ? rect.x1 - 1 : rect.x0, y = side.down > 0 ? rect.y1 - 1 : rect.y0;
        return side.at(pixel_centre(x, y, subpixel_bits)) >= 0;
    });
}

RowSpan covered_span(const ShapeCoverage& shape, RowSpan columns, int y, int subpixel_bits) noexcept {
    return span_from(shape, columns, pixel_centre(columns.x0, y, subpixel_bits), subpixel_bits);
}

int covered_samples(const ShapeCoverage& shape, int x, int y, int subpixel_bits) noexcept {
    int covered = 0;
    for (int k = 0; k < smooth_samples; ++k) {
        const SubpixelPoint sample = smooth_sample(k, x, y, subpixel_bits);
        covered += std::ranges::all_of(shape.side, [&](const HalfPlane& s) { return s.at(sample) >= 0; }) ? 1 : 0;
    }
    return covered;
}

RowSpan touched_span(const ShapeCoverage& shape, RowSpan columns, int y, int subpixel_bits) noexcept {
    RowSpan all{columns.x1, columns.x0};
    for (int k = 0; k < smooth_samples; ++k) {
        const RowSpan span = span_from(shape, columns, smooth_sample(k, columns.x0, y, subpixel_bits), subpixel_bits);
        if (span.x0 >= span.x1) continue;
        all.x0 = std::min(all.x0, span.x0);
        all.x1 = std::max(all.x1, span.x1);
    }
    return all;
}

Rect point_box(const WindowCorner& corner, const RasterState& state, const RasterRules& rules) noexcept {
    const int bits = rules.subpixel_bits;
    if (rules.points == PointRule::subpixel_square) return subpixel_square(corner.unsnapped, state.point_size_px, bits);
    const SubpixelPoint p = corner.p;
    std::int64_t before = 0, behind = 0;
    if (rules.points == PointRule::reciprocal) {
        const int side = register_of_size(state.point_size_px);
        if (side == 0) return {p.x >> bits, p.y >> bits, (p.x >> bits) + 1, (p.y >> bits) + 1};
        if (state.line_style != LineStyle::band && side == 8)
            return {p.x >> bits, (p.y - 1) >> bits, (p.x >> bits) + 1, ((p.y - 1) >> bits) + 1};
        before = behind = std::int64_t{side} << (bits - 4);
        behind -= std::has_single_bit(static_cast<unsigned>(side)) ? 1 : 0;
    } else {
        // Half the side in subpixels, rounded down: between two subpixels there is no centre.
        const double half = 0.5 * static_cast<double>(state.point_size_px) * (1 << bits);
        before = static_cast<std::int64_t>(half);
        behind = before - (static_cast<double>(before) == half ? 1 : 0);
    }
    return {first_centre(p.x - before, bits), first_centre(p.y - before, bits), end_centre(p.x + behind, bits),
            end_centre(p.y + behind, bits)};
}

}  // namespace strata::rasterizer
