// rasterizer/coverage/line_stipple.h - the fragments of a line in the order in which a stipple counts them.
//
// Rule     The fragments of a line one pixel wide are numbered from its start on; a wider line has the number of its
//          column (row) everywhere. Only fragments in the viewport count. Fragment s is kept if bit s / factor mod 16
//          of the pattern is set.
// Source   OpenGL 2.1 3.4.2; rasterizer/reference/lines-and-points.md 8.
// Tests    tests/rasterizer/coverage/line_stipple_test.cpp
#pragma once
#include "rasterizer/coverage/coverage.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::rasterizer {

struct StippleRun {
    bool is_x = true;         // along x: a number for each column
    int first = 0, step = 1;  // the column (row) of fragment 0, and the direction
    std::uint32_t count = 0;

    [[nodiscard]] constexpr std::int64_t number(int x, int y) const noexcept {
        return std::int64_t{step} * ((is_x ? x : y) - first);
    }
};

// Of a line by diamond exit, with its snapped ends in submission order.
[[nodiscard]] StippleRun stipple_run(SubpixelPoint a, SubpixelPoint b, const Rect& viewport,
                                     int subpixel_bits) noexcept;

// Numbers below 0, beside the first fragment, count backwards.
[[nodiscard]] constexpr bool is_kept(const LineStipple& stipple, std::int64_t number) noexcept {
    const std::int64_t period = std::int64_t{16} * stipple.factor, within = (number % period + period) % period;
    return (stipple.pattern >> (within / stipple.factor) & 1) != 0;
}

}  // namespace strata::rasterizer
