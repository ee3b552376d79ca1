// rasterizer/coverage/coverage.h - the pixels of a rectangle that a triangle covers, row by row.
//
// Rule     edge.h at every pixel centre. The covered pixels of a row are one span because the triangle is convex.
// Numbers  All integers: |E| <= 2^57 inside the guard band, a row of 2^16 pixels adds at most 2^16 * 2^28 * 2^12 =
//          2^56.
// Tests    tests/rasterizer/coverage/coverage_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "rasterizer/coverage/edge.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {

using EdgeValues = std::array<std::int64_t, 3>;

// The centre of pixel (x, y) in subpixels: an integer because n >= 1.
[[nodiscard]] constexpr SubpixelPoint pixel_centre(int x, int y, int subpixel_bits) noexcept {
    const int half = 1 << (subpixel_bits - 1);
    return {x * 2 * half + half, y * 2 * half + half};
}

// The three sides of a triangle of either winding, edge i opposite corner i, oriented so that the interior is positive.
class TriangleEdges {
  public:
    constexpr TriangleEdges(const std::array<SubpixelPoint, 3>& p, TieRule rule) noexcept
        : TriangleEdges(p, rule, Edge{p[0], p[1]}.at(p[2]), 0) {}
    // For a triangle with negative w at the corners of `negative_w` (bit i). Their edges are negated, so that the
    // covered pixels are again those where no edge value is negative; the tie rule of such a side is inverted
    // (rasterizer/reference/coverage.md 5.8). For coverage only: `at` does not return the negated values.
    constexpr TriangleEdges(const std::array<SubpixelPoint, 3>& p, TieRule rule, std::uint8_t negative_w) noexcept
        : TriangleEdges(p, rule, Edge{p[0], p[1]}.at(p[2]), negative_w) {}

    // The edge values of a line: 0 for the first corner, and those of its ends for the two others. They fall and rise
    // along `direction`; their sum is the length from `from` to `to` in that direction, which must be positive.
    [[nodiscard]] static constexpr TriangleEdges along(SubpixelPoint from, SubpixelPoint to,
                                                       SubpixelPoint direction) noexcept {
        // An edge turned by 90 degrees: its value is the distance along the direction.
        const SubpixelPoint forward{direction.y, -direction.x}, backward{-direction.y, direction.x};
        const auto end = [](SubpixelPoint p, SubpixelPoint d) { return SubpixelPoint{p.x + d.x, p.y + d.y}; };
        const Edge second{to, end(to, backward)}, third{from, end(from, forward)};
        return {{Edge{from, from}, second, third}, third.at(to)};
    }
    // The edge values of a point: its first corner has the whole area, 1, everywhere.
    [[nodiscard]] static constexpr TriangleEdges everywhere() noexcept {
        constexpr Edge none{{0, 0}, {0, 0}};
        return {{none, none, none}, 1};
    }

    // Twice the area in square subpixels: the sum of the edge values at any point.
    [[nodiscard]] constexpr std::int64_t area() const noexcept { return area_; }
    [[nodiscard]] constexpr const Edge& edge(std::size_t i) const noexcept { return edge_[i]; }
    // 0 if the edge owns its ties, else 1: the edge covers the centre if E - tie >= 0.
    [[nodiscard]] constexpr std::int64_t tie(std::size_t i) const noexcept { return tie_[i]; }
    // Edge values 1 and 2, and the rest of the area for edge 0: the three sum up exactly, so edge 0 needs no products.
    [[nodiscard]] constexpr EdgeValues at(SubpixelPoint p) const noexcept {
        const std::int64_t e1 = edge_[1].at(p), e2 = edge_[2].at(p);
        return {area_ - e1 - e2, e1, e2};
    }

  private:
    constexpr TriangleEdges(const std::array<SubpixelPoint, 3>& p, TieRule rule, std::int64_t area,
                            std::uint8_t turned) noexcept
        : edge_{Edge{p[1], p[2], (area > 0) == ((turned & 1) == 0) ? 1 : -1},
                Edge{p[2], p[0], (area > 0) == ((turned & 2) == 0) ? 1 : -1},
                Edge{p[0], p[1], (area > 0) == ((turned & 4) == 0) ? 1 : -1}},
          tie_{edge_[0].owns_ties(rule) ? 0 : 1, edge_[1].owns_ties(rule) ? 0 : 1, edge_[2].owns_ties(rule) ? 0 : 1},
          area_{area > 0 ? area : -area} {}

    constexpr TriangleEdges(const std::array<Edge, 3>& edge, std::int64_t area) noexcept
        : edge_{edge}, tie_{}, area_{area} {}

    std::array<Edge, 3> edge_;
    EdgeValues tie_;
    std::int64_t area_;
};

// The pixels whose centres are in the bounding box of `p`; n is `subpixel_bits`.
[[nodiscard]] constexpr Rect centre_box(const std::array<SubpixelPoint, 3>& p, int subpixel_bits) noexcept {
    const int half = 1 << (subpixel_bits - 1);
    const auto least = [](std::int32_t a, std::int32_t b, std::int32_t c) { return std::min(std::min(a, b), c); };
    const auto most = [](std::int32_t a, std::int32_t b, std::int32_t c) { return std::max(std::max(a, b), c); };
    const std::int32_t left = least(p[0].x, p[1].x, p[2].x), right = most(p[0].x, p[1].x, p[2].x);
    const std::int32_t top = least(p[0].y, p[1].y, p[2].y), bottom = most(p[0].y, p[1].y, p[2].y);
    const auto first = [&](std::int32_t c) { return (c + half - 1) >> subpixel_bits; };  // first centre >= c
    const auto end = [&](std::int32_t c) {
        return ((c - half) >> subpixel_bits) + 1;
    };  // one past the last centre <= c
    return {first(left), first(top), end(right), end(bottom)};
}

// Pixels [x0, x1) of a row of the surface.
struct RowSpan {
    int x0, x1;
};

// Covered pixels [x0, x1) of a row, and the exact edge values at x0.
struct PixelSpan {
    int x0, x1;
    EdgeValues e;
};

// Steps the edge values along the rows of a box of pixels.
class RowWalker {
  public:
    RowWalker(const TriangleEdges& edges, const Rect& box, int subpixel_bits) noexcept
        : x0_{box.x0}, width_{box.width()} {
        const SubpixelPoint first = pixel_centre(box.x0, box.y0, subpixel_bits);
        for (std::size_t i = 0; i < 3; ++i) {
            value_[i] = edges.edge(i).at(first);
            step_[i] = edges.edge(i).step_x() * (std::int64_t{1} << subpixel_bits);
            down_[i] = edges.edge(i).step_y() * (std::int64_t{1} << subpixel_bits);
            const std::int64_t rise = step_[i] < 0 ? -step_[i] : step_[i];
            const double inverse = rise == 0 ? 0.0 : 1.0 / static_cast<double>(rise);
            crossing_[i] = {rise, -width_ * rise, inverse, edges.tie(i), step_[i] < 0};
        }
    }
    // Change of the three edge values from a pixel to its right neighbour.
    [[nodiscard]] const EdgeValues& step() const noexcept { return step_; }
    void next_row() noexcept {
        for (std::size_t i = 0; i < 3; ++i) value_[i] += down_[i];
    }
    // The covered span of the current row, empty if x0 >= x1.
    [[nodiscard]] PixelSpan span() const noexcept {
        std::int64_t first = 0, end = width_;
        for (std::size_t i = 0; i < 3; ++i) {
            const Crossing& c = crossing_[i];
            const std::int64_t e = value_[i] - c.tie;
            const std::int64_t k = first_reached(c.falls ? -e - 1 : e, c);
            first = c.falls ? first : std::max(first, k);
            end = c.falls ? std::min(end, k) : end;
        }
        const auto at = [&](std::size_t i) { return value_[i] + first * step_[i]; };
        return {x0_ + static_cast<int>(first), x0_ + static_cast<int>(end), {at(0), at(1), at(2)}};
    }

  private:
    // Where an edge crosses a row. `beyond` is -width * rise: an edge value below it stays negative in the whole row. A
    // falling edge ends its span on the right, where -E - 1 reaches 0.
    struct Crossing {
        std::int64_t rise;
        std::int64_t beyond;
        double inverse;
        std::int64_t tie;
        bool falls;
    };

    // The least k >= 0 with e + k rise >= 0, at most the width, without a branch. The estimate is never too high and is
    // low by less than 2: it is at most 2^16 with an error below 2^-35, and an exact quotient that is not an integer is
    // at least 1 / rise above an integer.
    [[nodiscard]] std::int64_t first_reached(std::int64_t e, const Crossing& c) const noexcept {
        const std::int64_t missing = std::clamp(e, c.beyond, std::int64_t{0});
        auto k = static_cast<std::int64_t>(static_cast<double>(-missing) * c.inverse);
        k += e + k * c.rise < 0 ? 1 : 0;
        k += e + k * c.rise < 0 ? 1 : 0;
        return e < c.beyond ? width_ : k;
    }

    int x0_;
    std::int64_t width_;
    EdgeValues value_, step_, down_;
    std::array<Crossing, 3> crossing_;
};

}  // namespace strata::rasterizer
