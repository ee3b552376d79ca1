// rasterizer/coverage/float_spans.h - the pixels that a triangle covers, by spans between sides that are stepped in
// binary32 from unsnapped positions.
//
// Rule     CoverageRule::float_spans: corners sorted by y; 1/2 is added to x and subtracted from y. Each side runs over
//          whole rows from ceil(y); row k of a part covers int(left + k slope) up to but excluding int(right + k
//          slope). The rows from the lowest y to the middle corner come first, then those from there to the highest y.
//          Nothing is drawn if 1 / area is not finite. int truncates toward zero; every operation is rounded to
//          binary32.
// Source   pipeline/reference/mesa-rasterizers.md 3.1 and 3.2.
// Numbers  Positions are within the guard band of +-2^15 pixels, but slopes are unbounded: x is clamped to the box
//          before the conversion to an integer.
// Tests    tests/rasterizer/coverage/float_spans_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "rasterizer/base/numerics.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {
inline namespace strict {

using WindowPosition = std::array<float, 2>;

// The indices of the corners in order of y: lowest, middle, highest.
[[nodiscard]] constexpr std::array<std::size_t, 3> by_height(const std::array<WindowPosition, 3>& p) noexcept {
    using Order = std::array<std::size_t, 3>;
    const float y0 = p[0][1], y1 = p[1][1], y2 = p[2][1];
    if (y0 <= y1) return y1 <= y2 ? Order{0, 1, 2} : y2 <= y0 ? Order{2, 0, 1} : Order{0, 2, 1};
    return y0 <= y2 ? Order{1, 0, 2} : y2 <= y1 ? Order{2, 1, 0} : Order{1, 2, 0};
}

// Twice the area in binary32, positive for corners that are clockwise in memory order: its sign decides the facing.
[[nodiscard]] constexpr float float_area(const std::array<WindowPosition, 3>& p) noexcept {
    const float ex = p[0][0] - p[2][0], ey = p[0][1] - p[2][1], fx = p[1][0] - p[2][0], fy = p[1][1] - p[2][1];
    const float down = ex * fy, up = ey * fx;
    return down - up;
}

class FloatSpans {
  public:
    explicit FloatSpans(const std::array<WindowPosition, 3>& p) noexcept {
        const auto [least, middle, greatest] = by_height(p);
        bottom_ = side(p[least], p[middle]);
        longest_ = side(p[least], p[greatest]);
        top_ = side(p[middle], p[greatest]);
        const float across = longest_.dx * bottom_.dy, back = bottom_.dx * longest_.dy;
        area_ = across - back;
        is_drawn_ = std::isfinite(1.0f / area_);
    }
    [[nodiscard]] bool is_drawn() const noexcept { return is_drawn_; }

    // Calls visit(y, x0, x1) for every row of `box` with covered pixels [x0, x1).
    template <class Visit>
    void visit(const Rect& box, const Visit& visit) const {
        // For a triangle outside the region the box has no columns: its bounds are reversed, which std::clamp does not
        // allow.
        if (!is_drawn_ || box.x0 >= box.x1) return;
        Side bottom = bottom_, longest = longest_, top = top_;
        const int rows = bottom.rows, rest = top.rows;
        if (area_ < 0.0f) {
            part(longest, bottom, rows, box, visit);
            part(longest, top, rest, box, visit);
        } else {
            part(bottom, longest, rows, box, visit);
            part(top, longest, rest, box, visit);
        }
    }

  private:
    struct Side {
        float dx = 0, dy = 0, slope = 0;
        float x = 0, y = 0;  // x and y in the side's next row
        int rows = 0;
    };

    [[nodiscard]] static Side side(const WindowPosition& from, const WindowPosition& to) noexcept {
        Side s;
        s.dx = to[0] - from[0];
        s.dy = to[1] - from[1];
        s.slope = s.dy == 0.0f ? 0.0f : s.dx / s.dy;
        const float x = from[0] + 0.5f, y = from[1] - 0.5f, end = to[1] - 0.5f;
        s.y = std::ceil(y);
        s.rows = static_cast<int>(std::ceil(end - s.y));
        const float risen = (s.y - y) * s.slope;
        s.x = x + risen;
        return s;
    }
    // x in row k of a side, clamped to the columns [low, high] and truncated to an integer.
    [[nodiscard]] static int column(const Side& s, int k, int low, int high) noexcept {
        const float moved = static_cast<float>(k) * s.slope;
        const float x = s.x + moved;
        return static_cast<int>(std::clamp(x, static_cast<float>(low), static_cast<float>(high)));
    }
    static void advance(Side& s, int rows) noexcept {
        const float moved = static_cast<float>(rows) * s.slope;
        s.x = s.x + moved;
        s.y = s.y + static_cast<float>(rows);
    }

    template <class Visit>
    static void part(Side& left, Side& right, int rows, const Rect& box, const Visit& visit) {
        const int y = static_cast<int>(left.y);
        for (int k = std::max(0, box.y0 - y); k < std::min(rows, box.y1 - y); ++k) {
            const int x0 = column(left, k, box.x0, box.x1), x1 = column(right, k, box.x0, box.x1);
            if (x0 < x1) visit(y + k, x0, x1);
        }
        advance(left, rows);
        advance(right, rows);
    }

    Side bottom_, longest_, top_;
    float area_ = 0.0f;
    bool is_drawn_ = false;
};

// A box of all pixels that a triangle can cover: one pixel more on every side than its corners.
[[nodiscard]] inline Rect float_box(const std::array<WindowPosition, 3>& p) noexcept {
    const auto [x0, x1] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [y0, y1] = std::minmax({p[0][1], p[1][1], p[2][1]});
    return {static_cast<int>(x0) - 2, static_cast<int>(y0) - 2, static_cast<int>(x1) + 3, static_cast<int>(y1) + 3};
}

// Triangles whose boxes have at most this many pixels in each direction are rasterized during set-up, to find the box
// of their covered pixels (rasterizer/reference/coverage.md 7.1).
inline constexpr int seen_size = 12;
// The bounding box of the covered pixels within `box`; empty if there are none.
[[nodiscard]] inline Rect covered_box(const FloatSpans& spans, const Rect& box) {
    Rect covered{box.x1, box.y1, box.x0, box.y0};
    spans.visit(box, [&](int y, int x0, int x1) {
        covered = {std::min(covered.x0, x0), std::min(covered.y0, y), std::max(covered.x1, x1),
                   std::max(covered.y1, y + 1)};
    });
    return covered.x0 < covered.x1 ? covered : Rect{};
}

}  // namespace strict
}  // namespace strata::rasterizer
