// rasterizer/values/attributes/chip_attributes.h - colours and texture coordinates as NV2A interpolates them.
//
// Rule     Colours by 8-bit weights: color_weights.h. Coordinates by truncated weights: truncated_coordinates.h. The
//          kernels of chip_lanes.h compute them where they suit, else the definitions.
// Tests    tests/rasterizer/values/chip_lanes_test.cpp, truncated_coordinates_test.cpp
#pragma once
#include <array>
#include <span>

#include "rasterizer/values/triangle_fragments.h"

namespace strata::rasterizer {
inline namespace strict {
struct ChipKernels;  // chip_lanes.h
}

// A coordinate interpolated by truncated weights: its values at the corners, and the output array.
struct TruncatedCoordinate {
    std::array<float, 3> u;
    float* out;
};

// A colour: r g b a of the three corners, and the output array of each channel.
struct ChipColor {
    std::array<const float*, 3> corner;
    std::array<float*, color_channels> out;
};

// `kernels` is null if the definitions run.
void fill_chip_colors(const ChipKernels* kernels, const TriangleFragments& fragments, const TriangleLanes& lanes,
                      const ChipColor& color) noexcept;
void fill_chip_coordinates(const ChipKernels* kernels, const DrawnTriangle& triangle, const TriangleLanes& lanes,
                           std::span<const TruncatedCoordinate> coordinates) noexcept;

}  // namespace strata::rasterizer
