// rasterizer/coverage.h - the pixels of a rectangle that a set-up triangle covers, row by row.
//
// Rule     edge.h at every pixel centre; a row's covered pixels are one span because the triangle is convex.
// Numbers  All integers: |E| <= 2^57 inside the guard band, a row of 2^16 pixels adds at most 2^16 * 2^28 * 2^12 =
// 2^56. Tests    tests/rasterizer/coverage_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "rasterizer/edge.h"
#include "rasterizer/raster_state.h"

namespace strata::rasterizer {

using EdgeValues = std::array<std::int64_t, 3>;

// The centre of pixel (x, y): an integer number of subpixels because n >= 1.
[[nodiscard]] constexpr SubpixelPoint pixel_centre(int x, int y, int subpixel_bits) noexcept {
    const int half = 1 << (subpixel_bits - 1);
    return {x * 2 * half + half, y * 2 * half + half};
}

// The three sides of a triangle of either winding, edge i opposite corner i, turned so that the interior is positive.
class TriangleEdges {
  public:
    constexpr TriangleEdges(const std::array<SubpixelPoint, 3>& p, TieRule rule) noexcept
        : TriangleEdges(p, rule, Edge{p[0], p[1]}.at(p[2])) {}

    [[nodiscard]] constexpr std::int64_t area() const noexcept {
        return area_;
    }  // twice the area: the sum of the edge values
    [[nodiscard]] constexpr const Edge& edge(std::size_t i) const noexcept { return edge_[i]; }
    // 0 if the edge owns its ties, else 1: the edge takes the centre if E - tie >= 0.
    [[nodiscard]] constexpr std::int64_t tie(std::size_t i) const noexcept { return tie_[i]; }
    [[nodiscard]] constexpr EdgeValues at(SubpixelPoint p) const noexcept {
        const std::int64_t e1 = edge_[1].at(p), e2 = edge_[2].at(p);
        return {area_ - e1 - e2, e1, e2};
    }

  private:
    constexpr TriangleEdges(const std::array<SubpixelPoint, 3>& p, TieRule rule, std::int64_t area) noexcept
        : edge_{area > 0 ? std::array{Edge{p[1], p[2]}, Edge{p[2], p[0]}, Edge{p[0], p[1]}}
                         : std::array{Edge{p[2], p[1]}, Edge{p[0], p[2]}, Edge{p[1], p[0]}}},
          tie_{edge_[0].owns_ties(rule) ? 0 : 1, edge_[1].owns_ties(rule) ? 0 : 1, edge_[2].owns_ties(rule) ? 0 : 1},
          area_{area > 0 ? area : -area} {}

    std::array<Edge, 3> edge_;
    EdgeValues tie_;
    std::int64_t area_;
};

// The pixels whose centres lie in the bounding box of `p`; n is `subpixel_bits`.
[[nodiscard]] constexpr Rect centre_box(const std::array<SubpixelPoint, 3>& p, int subpixel_bits) noexcept {
    const int half = 1 << (subpixel_bits - 1);
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto first = [&](std::int32_t c) { return (c + half - 1) >> subpixel_bits; };  // first centre >= c
    const auto end = [&](std::int32_t c) {
        return ((c - half) >> subpixel_bits) + 1;
    };  // one past the last centre <= c
    return {first(left), first(top), end(right), end(bottom)};
}

struct PixelSpan {
    int x0, x1;    // pixels [x0, x1)
    EdgeValues e;  // exact edge values at x0
};

// Edge values along one row of pixels of a box; `step` is the change per pixel to the right.
class RowWalker {
  public:
    RowWalker(const TriangleEdges& edges, const Rect& box, int subpixel_bits) noexcept : box_{box} {
        const SubpixelPoint corner = pixel_centre(box.x0, box.y0, subpixel_bits);
        value_ = edges.at(corner);
        for (std::size_t i = 0; i < 3; ++i) {
            tie_[i] = edges.tie(i);
            step_[i] = edges.edge(i).step_x() * (std::int64_t{1} << subpixel_bits);
            down_[i] = edges.edge(i).step_y() * (std::int64_t{1} << subpixel_bits);
        }
    }
    [[nodiscard]] const EdgeValues& step() const noexcept { return step_; }
    void next_row() noexcept {
        for (std::size_t i = 0; i < 3; ++i) value_[i] += down_[i];
    }
    // The covered span of the present row, empty if x0 >= x1. Short rows are stepped through, long ones divided.
    [[nodiscard]] PixelSpan span() const noexcept {
        constexpr int short_row = 12;
        return box_.width() <= short_row ? stepped() : divided();
    }

  private:
    [[nodiscard]] PixelSpan stepped() const noexcept {
        EdgeValues e{value_[0] - tie_[0], value_[1] - tie_[1], value_[2] - tie_[2]};
        int x = box_.x0;
        const auto outside = [&] { return (e[0] | e[1] | e[2]) < 0; };
        const auto advance = [&] {
            for (std::size_t i = 0; i < 3; ++i) e[i] += step_[i];
            ++x;
        };
        while (x < box_.x1 && outside()) advance();
        PixelSpan span{x, x, {e[0] + tie_[0], e[1] + tie_[1], e[2] + tie_[2]}};
        while (x < box_.x1 && !outside()) advance();
        span.x1 = x;
        return span;
    }
    // E(k) = value - tie + k step >= 0 for k in [0, width), solved exactly for each edge.
    [[nodiscard]] PixelSpan divided() const noexcept {
        std::int64_t first = 0, end = box_.width();
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int64_t e = value_[i] - tie_[i], step = step_[i];
            if (e < 0) {
                if (step <= 0) return {box_.x0, box_.x0, {}};
                first = std::max(first, (-e + step - 1) / step);
            } else if (step < 0) {
                end = std::min(end, e / -step + 1);
            }
        }
        const auto at = [&](std::size_t i) { return value_[i] + first * step_[i]; };
        return {box_.x0 + static_cast<int>(std::min<std::int64_t>(first, box_.width())),
                box_.x0 + static_cast<int>(end), first < end ? EdgeValues{at(0), at(1), at(2)} : EdgeValues{}};
    }

    Rect box_;
    EdgeValues value_, tie_, step_, down_;
};

}  // namespace strata::rasterizer
