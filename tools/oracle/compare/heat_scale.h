// tools/oracle/compare/heat_scale.h - maps distances in codes to colours, with a legend.
//
// Rule     0 is black. From 1 code to the scale's end the logarithm of the distance is the position in a table whose
//          lightness (CIE L*) rises in even steps: doubling the distance adds the same lightness everywhere on the
//          scale. The end is 255 codes, or, if the greatest distance is larger, the least 2^k - 1 that is not less.
// Source   the upper three quarters of the colour map Inferno (S. van der Walt, N. Smith, matplotlib; CC0)
// Tests    tests/tools/oracle/compare/heat_scale_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/formats/image.h"

namespace strata::oracle {

class HeatScale {
  public:
    // For distances of at most `greatest` codes.
    explicit HeatScale(std::uint32_t greatest) noexcept;
    [[nodiscard]] std::uint32_t end() const noexcept { return end_; }
    // Red, green, blue; distances beyond the end have the end's colour.
    [[nodiscard]] std::array<std::uint8_t, 3> color(std::uint32_t distance) const noexcept;
    // The position on a legend of a distance of at least 1 code: 0 at 1 code, 1 at the end.
    [[nodiscard]] double position(std::uint32_t distance) const noexcept;
    // Distances that are labelled in a legend, ascending: 1 code, at most three powers of two, the end.
    [[nodiscard]] std::vector<std::uint32_t> marks() const;
    // A legend's colours in even steps from 1 code to the end, with linear interpolation between them.
    [[nodiscard]] static std::span<const std::array<std::uint8_t, 3>> stops() noexcept;

  private:
    std::uint32_t end_;
};

// The minimum width has room for "4294967295 codes".
inline constexpr int legend_height_px = 26, least_legend_width_px = 132;

// Draws the scale into an rgba8 image: a bar from `left`, `width` wide, which must be at least least_legend_width_px,
// and below it the labels. It takes legend_height_px rows from `top`.
void draw_legend(pipeline::Image& image, int left, int top, int width, const HeatScale& scale);

}  // namespace strata::oracle
