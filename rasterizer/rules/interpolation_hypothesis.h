// rasterizer/rules/interpolation_hypothesis.h - what is not known for certain about colours and texture coordinates, as
// values to vary.
//
// Rule     As depth_hypothesis.h: a default is what captures of silicon prove where they do ([M]), else our assumption
//          ([A]). interpolation_hypotheses (hypotheses.h) names the others.
// Source   attributes.md 2.2 to 2.5, 3.2 and 3.3; chip-depth.md 8; chip-geometry.md 5.1.
// Tests    tests/rasterizer/chip/color_weights_test.cpp, cut_coordinates_test.cpp
#pragma once
#include <cstdint>

namespace strata::rasterizer {

// The weights b of colours where 1/w differs: those of the w buffer, every step cut (perspective_weights.h) [M]
// (chip-float-depth.md 7: 5 of 800,480 pixels wrong); or p_i = e_i (1/w_i), products of the edge values, normalised in
// binary64; or of the weights for equal w, normalised by a reciprocal cut to 28 bits. [A] the two others.
enum class PerspectiveColor : std::uint8_t { edge_products, weight_products, cut_products };

// Texture coordinates where w differs: the exact plane over that of 1/w, or the chip's sum by the weights of the w
// buffer. One capture cannot tell them (attributes.md 3.3).
enum class PerspectiveCoordinates : std::uint8_t { exact_plane, cut_products };

// Texture coordinates where w is equal at all corners: the exact plane rounded once, or the chip's sum by cut weights
// (cut_coordinates.h) [M]. Where w differs: the exact plane [A].
enum class CoordinateRule : std::uint8_t { exact_plane, cut_weights };

struct InterpolationHypothesis {
    // Leading bits of a vertex colour that reach its 8-bit code (9 to 24), the rest is cut. [M] 14: all of 3,944 greys
    // of suite Depth_buffer, while 13 gives 25 wrong, 15 gives 14, all 24 give 29.
    int vertex_color_bits = 24;
    PerspectiveColor perspective_color = PerspectiveColor::edge_products;
    CoordinateRule texture_coordinates = CoordinateRule::exact_plane;
    PerspectiveCoordinates perspective_coordinates = PerspectiveCoordinates::exact_plane;
    friend bool operator==(const InterpolationHypothesis&, const InterpolationHypothesis&) = default;
};

}  // namespace strata::rasterizer
