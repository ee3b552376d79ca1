// rasterizer/rules/interpolation_hypothesis.h - parameters of the interpolation of colours and texture coordinates
// whose hardware value is not certain. The chip is NV2A.
//
// Rule     As in depth_hypothesis.h, defaults are measured on hardware ([M]) or assumed ([A]). interpolation_hypotheses
//          (hypotheses.h) lists the alternatives.
// Source   rasterizer/reference/attributes.md 2.2 to 2.5, 3.2 and 3.3; chip-depth.md 8; chip-geometry.md 5.1.
// Tests    tests/rasterizer/chip/color_weights_test.cpp, tests/rasterizer/values/truncated_coordinates_test.cpp
#pragma once
#include <cstdint>

namespace strata::rasterizer {

// The weights b of colours if 1/w differs between the corners. cut_products: those of the w buffer, every step
// truncated (perspective_weights.h) [M] (chip-float-depth.md 7: 5 of 800,480 pixels wrong). edge_products [A]: p_i =
// e_i (1/w_i), products of the edge values, normalized in binary64. weight_products [A]: products of the weights for
// equal w, normalized by a reciprocal truncated to 28 bits.
enum class PerspectiveColor : std::uint8_t { edge_products, weight_products, cut_products };

// Texture coordinates if w differs: the exact plane divided by that of 1/w, or the chip's sum with the weights of the w
// buffer. The only capture cannot distinguish them (attributes.md 3.3).
enum class PerspectiveCoordinates : std::uint8_t { exact_plane, cut_products };

// Texture coordinates if w is equal at all corners: the exact plane rounded once, or the chip's sum with truncated
// weights (truncated_coordinates.h) [M]. If w differs: the exact plane [A].
enum class CoordinateRule : std::uint8_t { exact_plane, cut_weights };

struct InterpolationHypothesis {
    // Leading bits of a vertex colour that are converted to its 8-bit code (9 to 24); the rest is truncated. [M] 14:
    // all 3,944 greys of suite Depth_buffer are right, while 13 gives 25 wrong, 15 gives 14, all 24 give 29.
    int vertex_color_bits = 24;
    PerspectiveColor perspective_color = PerspectiveColor::edge_products;
    CoordinateRule texture_coordinates = CoordinateRule::exact_plane;
    PerspectiveCoordinates perspective_coordinates = PerspectiveCoordinates::exact_plane;
    friend bool operator==(const InterpolationHypothesis&, const InterpolationHypothesis&) = default;
};

}  // namespace strata::rasterizer
