// rasterizer/chip/w_buffer.cpp - the slope of w between two pixels of a triangle, for the polygon offset of NV2A's w
// buffer (w_buffer.h).
#include "rasterizer/chip/w_buffer.h"

#include "rasterizer/set_up/polygon_offset.h"

namespace strata::rasterizer {
inline namespace strict {
namespace {

// The first row of `rows` in which the triangle covers a pixel, and its span; empty if there is none.
struct FirstRow {
    int y = 0, x0 = 0, x1 = 0;
};
[[nodiscard]] FirstRow first_row(const TriangleEdges& edges, const Rect& rows, int subpixel_bits) noexcept {
    RowWalker walker{edges, rows, subpixel_bits};
    for (int y = rows.y0; y < rows.y1; ++y, walker.next_row()) {
        const PixelSpan span = walker.span();
        if (span.x0 < span.x1) return {y, span.x0, span.x1};
    }
    return {};
}

// w at a pixel's centre, exact except for binary64 rounding: the sum of e over the sum of e / w.
[[nodiscard]] double w_at(const EdgeValues& e, const std::array<float, 3>& w) noexcept {
    double above = 0.0, below = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        above += static_cast<double>(e[i]);
        below += static_cast<double>(e[i]) / double{w[i]};
    }
    return above / below;
}

}  // namespace

double w_slope(const SetupTriangle& t, const std::array<float, 3>& w, const Rect& clip,
               const RasterRules& rules) noexcept {
    const int bits = rules.subpixel_bits;
    const TriangleEdges edges{t.p, rules.tie_rule};
    const FirstRow row = first_row(edges, intersection(clip, centre_box(t.p, bits)), bits);
    if (row.x0 >= row.x1) return 0.0;
    // The chip starts below the topmost corner: at the pixel of the first row that is nearest to it.
    const auto top = std::min_element(t.p.begin(), t.p.end(), [](auto a, auto b) { return a.y < b.y; });
    const int x = std::clamp(top->x >> bits, row.x0, row.x1 - 1);
    // 1 / w is linear: its steeper axis is that of w.
    double right = 0.0, down = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        right += static_cast<double>(edges.edge(i).step_x()) / double{w[i]};
        down += static_cast<double>(edges.edge(i).step_y()) / double{w[i]};
    }
    const bool by_rows = magnitude(down) >= magnitude(right);
    const int first = by_rows ? row.y : x;
    const int second = rules.hypothesis.w_slope == WSlope::first_quad ? first | 1 : first | 3;
    const auto at = [&](int p) {
        return w_at(edges.at(by_rows ? pixel_centre(x, p, bits) : pixel_centre(p, row.y, bits)), w);
    };
    return magnitude(at(second) - at(second - 1));
}

}  // namespace strict
}  // namespace strata::rasterizer
