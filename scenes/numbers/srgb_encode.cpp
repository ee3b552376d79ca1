// scenes/numbers/srgb_encode.cpp - the two formulas; encode_srgb8 is the encoding of sRGB targets.
#include "scenes/numbers/srgb_encode.h"

#include <algorithm>

#include "pipeline/formats/srgb_codes.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/numerics.h"
#include "scenes/numbers/elementary.h"

namespace strata::scenes {
namespace {

// A NaN is not above 0 and gives 0.
float clamped(float x) noexcept { return x > 0 ? std::min(x, 1.0f) : 0.0f; }

// Only red, green and blue: alpha is a coverage and never encoded.
template <class Transfer>
pipeline::Rgba with_rgb(pipeline::Rgba color, Transfer transfer) noexcept {
    for (std::size_t i = 0; i < 3; ++i) color[i] = transfer(color[i]);
    return color;
}

}  // namespace

float encode_srgb(float linear) noexcept {
    const FloatEnvironment environment;
    const double l = double{clamped(linear)};
    return static_cast<float>(l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1 / 2.4) - 0.055);
}

float decode_srgb(float encoded) noexcept {
    const FloatEnvironment environment;
    const double e = double{clamped(encoded)};
    return static_cast<float>(e <= 0.04045 ? e / 12.92 : pow((e + 0.055) / 1.055, 2.4));
}

std::uint8_t encode_srgb8(float linear) noexcept { return pipeline::to_srgb8(linear); }

pipeline::Rgba from_encoded(pipeline::Rgba encoded, pipeline::ColorSpace frame) noexcept {
    return frame == pipeline::ColorSpace::encoded ? encoded : with_rgb(encoded, decode_srgb);
}

pipeline::Rgba from_linear(pipeline::Rgba linear, pipeline::ColorSpace frame) noexcept {
    return frame == pipeline::ColorSpace::linear ? linear : with_rgb(linear, encode_srgb);
}

}  // namespace strata::scenes
