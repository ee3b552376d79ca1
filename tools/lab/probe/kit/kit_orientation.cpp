// tools/lab/probe/kit/kit_orientation.cpp - slivers whose area is lost in binary32: a device that computes the
// orientation of a triangle there draws others than one that computes it exactly
// (rasterizer/reference/coverage.md 6.5).
#include <array>
#include <cstdint>
#include <numeric>

#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/shapes.h"

namespace strata::probe {

namespace {

// A position in sixteenths of a pixel from the first pixel's centre.
struct SixteenthPoint {
    std::int64_t x = 0, y = 0;
};
using Corners = std::array<SixteenthPoint, 3>;

std::int64_t doubled_area(const Corners& p) {
    return (p[0].y - p[2].y) * p[1].x + (p[2].y - p[1].y) * p[0].x + (p[1].y - p[0].y) * p[2].x;
}

// The sum in binary32, for corners that begin with number `first`.
float single_area(const Corners& p, std::size_t first) {
    std::array<float, 3> x{}, y{};
    for (std::size_t i = 0; i < 3; ++i) {
        x[i] = static_cast<float>(p[(first + i) % 3].x);
        y[i] = static_cast<float>(p[(first + i) % 3].y);
    }
    const float one = (y[0] - y[2]) * x[1], two = (y[2] - y[1]) * x[0], three = (y[1] - y[0]) * x[2];
    return (one + two) + three;
}

// A point q with x q.y - y q.x = 1, by Euclid's algorithm; x and y have no common divisor.
SixteenthPoint beside(std::int64_t x, std::int64_t y) {
    SixteenthPoint above{1, 0}, below{0, 1};  // coefficients of the two remainders
    std::int64_t a = x, b = y;
    while (b != 0) {
        const std::int64_t quotient = a / b;
        const SixteenthPoint next{above.x - quotient * below.x, above.y - quotient * below.y};
        above = below;
        below = next;
        a -= quotient * b;
        std::swap(a, b);
    }
    return a < 0 ? SixteenthPoint{above.y, -above.x} : SixteenthPoint{-above.y, above.x};
}

// Corners stay inside the frame, so that no clip volume changes them. Products of a side of 8,176 sixteenths and one of
// 4,080 exceed 2^24, where binary32 has even numbers alone.
constexpr int last_x = 511 * 16, last_y = 255 * 16;
bool is_inside(const SixteenthPoint& p) { return p.x >= 0 && p.y >= 0 && p.x <= last_x && p.y <= last_y; }

// A sliver whose doubled area is one square sixteenth, with a corner on the centre of that pixel: it contains no other
// centre.
Corners sliver(RandomGenerator& random, const SixteenthPoint& centre) {
    for (;;) {
        const SixteenthPoint far{random.below(last_x + 1), random.below(last_y + 1)};
        const std::int64_t x = far.x - centre.x, y = far.y - centre.y;
        if (std::gcd(x, y) != 1) continue;
        const SixteenthPoint q = beside(x, y), third{centre.x + q.x, centre.y + q.y};
        if (!is_inside(third)) continue;
        if (random.below(2) == 0) return {centre, far, third};
        return {centre, third, far};
    }
}

// True if binary32 has another sign, or none, in one of the orders of the corners.
bool is_lost(const Corners& p) {
    for (std::size_t first = 0; first < 3; ++first)
        if (static_cast<double>(single_area(p, first)) * static_cast<double>(doubled_area(p)) <= 0) return true;
    return false;
}

}  // namespace

void add_orientation(std::vector<Item>& items) {
    Item item{.name = "coverage.orientation", .decides = {"raster.area_sign"}, .width = 512, .height = 256};
    RandomGenerator random{80};
    Draw draw;
    for (int number = 0; number < 4096; ++number) {
        const SixteenthPoint centre{(2 + number % 64 * 8) * 16, (2 + number / 64 * 4) * 16};
        Corners p = sliver(random, centre);
        for (int attempt = 0; attempt < 20 && !is_lost(p); ++attempt) p = sliver(random, centre);
        if (!is_lost(p)) continue;
        std::array<FramePosition, 3> corners;
        const auto turn = static_cast<std::size_t>(random.below(3));
        for (std::size_t i = 0; i < 3; ++i) {
            const SixteenthPoint& from = p[(i + turn) % 3];
            corners[i].x = static_cast<float>(from.x) / 16.0f + 0.5f;
            corners[i].y = static_cast<float>(from.y) / 16.0f + 0.5f;
        }
        const Color color = code_color(number);
        add_triangle(item, draw, corners, {color, color, color});
    }
    item.draws = {draw};
    items.push_back(item);
}

}  // namespace strata::probe
