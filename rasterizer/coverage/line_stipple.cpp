// rasterizer/coverage/line_stipple.cpp - finds the columns or rows in which a line has fragments (line_stipple.h).
#include "rasterizer/coverage/line_stipple.h"

#include <algorithm>

#include "rasterizer/coverage/diamond_exit.h"
#include "rasterizer/coverage/line_axis.h"

namespace strata::rasterizer {

StippleRun stipple_run(SubpixelPoint a, SubpixelPoint b, const Rect& viewport, int subpixel_bits) noexcept {
    const LineAxis axis{a, b};
    const ShapeCoverage line = diamond_exit(a, b, 1.0f, subpixel_bits);
    const Rect box = intersection(line.box, viewport);
    int least = 0, end = 0;  // columns or rows with a fragment, without a gap
    for (int y = box.y0; y < box.y1; ++y) {
        const RowSpan span = covered_span(line, {box.x0, box.x1}, y, subpixel_bits);
        if (span.x0 >= span.x1) continue;
        const int from = axis.is_x ? span.x0 : y, to = axis.is_x ? span.x1 : y + 1;
        least = least == end ? from : std::min(least, from);
        end = std::max(end, to);
    }
    return {axis.is_x, axis.sign > 0 ? least : end - 1, axis.sign, static_cast<std::uint32_t>(end - least)};
}

}  // namespace strata::rasterizer
