// pipeline/formats/dither.h - ordered dithering of colours before they are stored in fixed-point channels.
//
// Rule     The 4 x 4 pattern p = 0 .. 15 of a pixel's window position in memory. What is not blended becomes the
//          code floor(v N + (2 p + 1) / 32) of its clamped value v; N is the greatest code. A narrow surface keeps the
//          upper bits of min(k + floor(p u / 16), 255), with k the blender's code and u its codes for one step of the
//          channel.
// Source   pipeline/reference/fragment-stages.md 8.7 (GL 4.6 core 17.3.8 leaves the pattern open: assumed).
// Numbers  v N has at most 34 bits, so that the sum in binary64 has the right floor.
// Tests    tests/pipeline/stages/dither_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "pipeline/formats/narrow.h"

namespace strata::pipeline {

[[nodiscard]] constexpr std::uint32_t dither_pattern(int x, int y) noexcept {
    constexpr std::array<std::array<std::uint8_t, 4>, 4> rows{
        {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}}};
    return rows[static_cast<std::size_t>(y & 3)][static_cast<std::size_t>(x & 3)];
}

// NaN counts as 0.
[[nodiscard]] constexpr std::uint32_t dithered(float value, int greatest, std::uint32_t pattern) noexcept {
    const double v = value > 0.0f ? std::min(double{value}, 1.0) : 0.0;
    return static_cast<std::uint32_t>(v * greatest + (2.0 * pattern + 1.0) / 32.0);
}

[[nodiscard]] constexpr std::uint32_t dithered_narrow(Format format, int channel, std::uint32_t code,
                                                      std::uint32_t pattern) noexcept {
    const std::uint32_t cut = 255 - narrowed(format, channel, 255);
    const std::uint32_t unit = format == Format::x1a7r8g8b8 && channel == 3 ? 2 : cut + 1;
    return narrowed(format, channel, std::min(code + pattern * unit / 16, 255u));
}

}  // namespace strata::pipeline
