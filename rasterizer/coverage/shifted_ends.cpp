// rasterizer/coverage/shifted_ends.cpp - llvmpipe's lines as half-planes, and the boxes of its points (shifted_ends.h).
#include "rasterizer/coverage/shifted_ends.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/coverage/line_axis.h"

namespace strata::rasterizer {
namespace {

// Half away from zero, with the sum in binary32.
[[nodiscard]] std::int32_t rounded(float v) noexcept {
    return static_cast<std::int32_t>(v >= 0.0f ? v + 0.5f : v - 0.5f);
}

// Subpixels from the centre of pixel 0.
[[nodiscard]] std::int32_t snapped(float position, int bits) noexcept {
    return rounded(static_cast<float>(1 << bits) * (position - 0.5f));
}

[[nodiscard]] bool same_sign(float a, float b) noexcept { return (a >= 0.0f) == (b >= 0.0f); }

// A position within its pixel. `along` and `across` are relative to the centre and negated for lines along y, so that
// one text serves both axes.
struct EndInPixel {
    float raw_along, fraction_across;
    float along, across;
    [[nodiscard]] bool is_in_diamond() const noexcept { return std::abs(along) + std::abs(across) < 0.5f; }
};

// The axis of a line, and differences from the second end to the first.
struct FloatAxis {
    bool is_x;
    float flip;           // -1 for lines along y
    float along, across;  // flipped
    float slope;          // the change across for one pixel along

    [[nodiscard]] EndInPixel in_pixel(const std::array<float, 2>& p) const noexcept {
        const float u = is_x ? p[0] : p[1], v = is_x ? p[1] : p[0];
        const float raw = u - std::floor(u) - 0.5f, fraction = v - std::floor(v);
        return {raw, fraction, flip * raw, flip * (fraction - 0.5f)};
    }
    // Where the line crosses the middle of the pixel that the end is in, from the pixel's border.
    [[nodiscard]] float at_middle(const EndInPixel& end) const noexcept {
        return end.fraction_across + end.raw_along * slope;
    }

    [[nodiscard]] bool draws_start(const EndInPixel& end) const noexcept {
        if (end.is_in_diamond()) return true;
        if (same_sign(end.along, -along)) return false;
        if (!same_sign(-end.across, across)) return true;
        const float middle = at_middle(end);
        return middle < 1.0f && middle > 0.0f;
    }
    [[nodiscard]] bool draws_end(EndInPixel end) const noexcept {
        // An end on the border towards which the line falls is taken as on the opposite one.
        if (flip * end.across == -0.5f && flip * across < 0.0f) end.across = flip * 0.5f;
        if (end.is_in_diamond() || !same_sign(end.along, -along)) return false;
        if (same_sign(-end.across, across)) return true;
        const float middle = at_middle(end);
        return middle < 1.0f && (is_x ? middle > 0.0f : middle >= 0.0f);
    }
};

// An end of the parallelogram, along and across.
struct ShiftedEnd {
    float along, across;
};

[[nodiscard]] ShapeCoverage parallelogram(const std::array<SubpixelPoint, 4>& corner, int bits) noexcept {
    const std::int32_t half = 1 << (bits - 1);
    ShapeCoverage line;
    for (std::size_t i = 0; i < corner.size(); ++i) {
        const SubpixelPoint& from = corner[i];
        const SubpixelPoint& to = corner[(i + 1) % corner.size()];
        const std::int64_t right = std::int64_t{to.y} - from.y, down = std::int64_t{from.x} - to.x;
        line.side[i] =
            half_plane({from.x + half, from.y + half}, right, down, 0, right > 0 || (right == 0 && down < 0));
    }
    const auto [x0, x1] = std::minmax({corner[0].x, corner[1].x, corner[2].x, corner[3].x});
    const auto [y0, y1] = std::minmax({corner[0].y, corner[1].y, corner[2].y, corner[3].y});
    const std::int32_t below = (1 << bits) - 1;
    line.box = {(x0 + below) >> bits, (y0 >> bits) + 1, (x1 + below) >> bits, (y1 >> bits) + 1};
    if (line.box.area() == 0) line.box = {};
    return line;
}

}  // namespace

ShapeCoverage shifted_ends(const std::array<float, 2>& a, const std::array<float, 2>& b, float width_px,
                           int subpixel_bits) noexcept {
    const float dx = a[0] - b[0], dy = a[1] - b[1];
    if (dx * dx + dy * dy == 0.0f) return {};
    const bool is_x = std::abs(dx) >= std::abs(dy);
    const float flip = is_x ? 1.0f : -1.0f;
    const FloatAxis axis{is_x, flip, flip * (is_x ? dx : dy), flip * (is_x ? dy : dx), is_x ? dy / dx : dx / dy};
    const EndInPixel start = axis.in_pixel(a), end = axis.in_pixel(b);
    // The start is on the left of a line along x, the lower end of one along y.
    const bool starts_low = axis.along < 0.0f;
    const bool has_start = starts_low ? start.along <= 0.0f : start.along > 0.0f;
    const bool has_end = starts_low ? end.along >= 0.0f : end.along <= 0.0f;
    const auto moved = [&](const std::array<float, 2>& p, const EndInPixel& in_pixel, bool is_right) {
        const float to_border = -in_pixel.along + (starts_low ? -0.5f : 0.5f);
        const float along = is_right ? 0.0f : flip * to_border, across = is_right ? 0.0f : along * axis.slope;
        return ShiftedEnd{(is_x ? p[0] : p[1]) + along, (is_x ? p[1] : p[0]) + across};
    };
    const ShiftedEnd first = moved(a, start, has_start == axis.draws_start(start)),
                     second = moved(b, end, has_end == axis.draws_end(end));
    const std::int32_t half = rounded(std::max(1.0f, width_px)) * (1 << subpixel_bits) / 2;
    const auto corner = [&](const ShiftedEnd& e, std::int32_t by) -> SubpixelPoint {
        const std::int32_t along = snapped(e.along, subpixel_bits), across = snapped(e.across, subpixel_bits) + by;
        return is_x ? SubpixelPoint{along, across} : SubpixelPoint{across, along};
    };
    const ShiftedEnd& from = starts_low ? second : first;
    const ShiftedEnd& to = starts_low ? first : second;
    return parallelogram({corner(from, -half), corner(to, -half), corner(to, half), corner(from, half)}, subpixel_bits);
}

Rect subpixel_square(const std::array<float, 2>& p, float size_px, int subpixel_bits) noexcept {
    const std::int32_t pixel = 1 << subpixel_bits;
    const std::int32_t side = std::max(pixel, rounded(static_cast<float>(pixel) * std::min(size_px, 255.0f)));
    const std::int32_t x = snapped(p[0], subpixel_bits) - side / 2, y = snapped(p[1], subpixel_bits) - side / 2;
    return {(x + pixel - 1) >> subpixel_bits, (y >> subpixel_bits) + 1, (x + side + pixel - 1) >> subpixel_bits,
            ((y + side) >> subpixel_bits) + 1};
}

}  // namespace strata::rasterizer
