// rasterizer/set_up/guard_band.h - the maximal distance of a position from the window's origin.
//
// Rule     x and y within +-`raster.guard_band_px` pixels, and within +-2^27 subpixels.
// Source   rasterizer/reference/coverage.md 1.3; the value of geforce3 is measured (chip-geometry.md 5.3).
// Numbers  Edge functions are exact up to 2^27 subpixels (edge.h): 32768 pixels at 12 subpixel bits, 524288 at 8, more
//          at 4.
// Tests    tests/rasterizer/set_up/window_test.cpp
#pragma once
#include <algorithm>

#include "rasterizer/rules/rules.h"

namespace strata::rasterizer {

[[nodiscard]] constexpr int guard_band(const RasterRules& rules) noexcept {
    return std::min(rules.guard_band_px, 1 << (27 - rules.subpixel_bits));
}

}  // namespace strata::rasterizer
