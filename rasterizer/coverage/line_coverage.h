// rasterizer/coverage/line_coverage.h - the pixels that a line or a smooth polygon covers: a box, cut by up to four
// half-planes; and the box of a point.
//
// Rule     rasterizer/reference/lines-and-points.md 2 and 3. Everything is an exact integer in subpixels.
// Numbers  Positions are below 2^27 subpixels, differences below 2^28, their products below 2^56; a value sums four of
//          them at most.
// Tests    tests/rasterizer/coverage/line_coverage_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/coverage/coverage.h"
#include "rasterizer/coverage/window_corner.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {

// Covers (x, y) if right x + down y + constant >= 0. Sides that exclude their own points have a constant smaller by 1.
struct HalfPlane {
    std::int64_t right = 0, down = 0, constant = 0;
    [[nodiscard]] constexpr std::int64_t at(SubpixelPoint p) const noexcept {
        return right * p.x + down * p.y + constant;
    }
};

// NV2A's registers of widths and sizes: eighths of a pixel, cut, nine bits.
[[nodiscard]] constexpr int register_of_size(float px) noexcept {
    return static_cast<int>(px < 0.0f ? 0.0f : px < 511.0f / 8.0f ? px * 8.0f : 511.0f);
}

struct ShapeCoverage {
    std::array<HalfPlane, 4> side;  // the default covers everything
    Rect box{};                     // empty: the shape covers nothing
};

// The two ends, in submission order; rules.lines must not be none.
[[nodiscard]] ShapeCoverage line_coverage(const WindowCorner& a, const WindowCorner& b, const RasterState& state,
                                          const RasterRules& rules) noexcept;
// The edge values from which a line's values are interpolated (lines-and-points.md 7).
[[nodiscard]] TriangleEdges line_edges(SubpixelPoint a, SubpixelPoint b, const RasterState& state,
                                       const RasterRules& rules) noexcept;

// How far beyond 0 and 1 the weights of the covered pixels' ends can be: a bound.
[[nodiscard]] double line_overshoot(SubpixelPoint a, SubpixelPoint b, const RasterState& state,
                                    const RasterRules& rules) noexcept;

// True if some pixel of `rect` may be covered, its box aside: no side has all their centres outside.
[[nodiscard]] bool may_cover(const ShapeCoverage& shape, const Rect& rect, int subpixel_bits) noexcept;
// The covered pixels of columns [columns.x0, columns.x1) of row y, the box aside; empty if x0 >= x1.
[[nodiscard]] RowSpan covered_span(const ShapeCoverage& shape, RowSpan columns, int y, int subpixel_bits) noexcept;

// The sides of a triangle and the pixels around it.
[[nodiscard]] ShapeCoverage polygon_coverage(const std::array<SubpixelPoint, 3>& p, const RasterRules& rules) noexcept;

// Smooth shapes: how many of the eight samples of pixel (x, y) are covered, and the alpha that this number becomes; a
// span that contains every pixel of the row with a covered sample.
inline constexpr int smooth_samples = 8;
[[nodiscard]] int covered_samples(const ShapeCoverage& shape, int x, int y, int subpixel_bits) noexcept;
[[nodiscard]] constexpr float smooth_alpha(int samples) noexcept {
    return static_cast<float>(samples == smooth_samples ? 255 : 32 * samples - 1) / 255.0f;
}
[[nodiscard]] RowSpan touched_span(const ShapeCoverage& shape, RowSpan columns, int y, int subpixel_bits) noexcept;

// The pixels that a point covers; rules.points must not be none.
[[nodiscard]] Rect point_box(const WindowCorner& corner, const RasterState& state, const RasterRules& rules) noexcept;

}  // namespace strata::rasterizer
