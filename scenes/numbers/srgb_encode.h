// scenes/numbers/srgb_encode.h - sRGB's transfer function and its inverse, and colours in the frame's colour space.
//
// Rule     encode: 12.92 l up to 0.0031308, above it 1.055 l^(1/2.4) - 0.055; decode: e / 12.92 up to 0.04045, above it
//          ((e + 0.055) / 1.055)^2.4. Binary64 in that order with scenes::pow, rounded once to binary32. Values below 0
//          and NaN count as 0, values above 1 as 1. encode_srgb8: 255 encode(l) rounded exactly to the nearest code,
//          halves up.
// Source   IEC 61966-2-1:1999, 5.2 and 5.3 (the printed constants, which leave a step of 3e-8 at the joint).
// Tests    tests/scenes/numbers/srgb_test.cpp against 50 digits; every binary32 from 0 to 1 under [exhaustive]
#pragma once
#include <cstdint>

#include "pipeline/vertices/draw_list.h"

namespace strata::scenes {

[[nodiscard]] float encode_srgb(float linear) noexcept;
[[nodiscard]] float decode_srgb(float encoded) noexcept;
[[nodiscard]] std::uint8_t encode_srgb8(float linear) noexcept;

// Converts a colour of the given space to the frame's; alpha is never encoded.
[[nodiscard]] pipeline::Rgba from_encoded(pipeline::Rgba encoded, pipeline::ColorSpace frame) noexcept;
[[nodiscard]] pipeline::Rgba from_linear(pipeline::Rgba linear, pipeline::ColorSpace frame) noexcept;

}  // namespace strata::scenes
