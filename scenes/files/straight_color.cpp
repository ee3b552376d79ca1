// scenes/files/straight_color.cpp - converts targets to 8-bit colours that are not premultiplied, which every program
// can show.
//
// Rule     A target of 8-bit codes in the encoded space that is not premultiplied is copied. Otherwise value / alpha if
//          the target is premultiplied (0 if alpha is not above 0), then clamp, and 255 x rounded half up; in the
//          linear space encode_srgb8 instead.
#include <algorithm>
#include <cassert>

#include "pipeline/formats/unorm8.h"
#include "rasterizer/base/float_environment.h"
#include "scenes/files/image_formats.h"
#include "scenes/numbers/srgb_encode.h"

namespace strata::scenes {
namespace {

using pipeline::ChannelType;
using pipeline::ColorSpace;
using pipeline::Format;
using pipeline::Image;

// 255 c / a rounded to the nearest code, halves up. c and a are at most 255, so every product is below 2^18. A
// premultiplied colour above its alpha gives 255.
std::uint32_t divided_by_alpha(std::uint32_t c, std::uint32_t a) noexcept {
    return a == 0 ? 0 : std::min((2 * 255 * c + a) / (2 * a), 255u);
}

// The conversion of codes with integers alone. A target that is not premultiplied is copied.
void convert_codes(const std::uint32_t* from, std::uint32_t* to, bool premultiplied) noexcept {
    const std::uint32_t alpha = from[3];
    for (int c = 0; c < 3; ++c) to[c] = premultiplied ? divided_by_alpha(from[c], alpha) : from[c];
    to[3] = alpha;
}

// The colours of srgb8_alpha8 are decoded to linear light whatever the frame's space is.
bool is_linear(const OutputColor& image) noexcept {
    return image.space == ColorSpace::linear || image.color.format == Format::srgb8_alpha8;
}

// The conversion of values, for packed, half and binary32 targets and for the linear space. Alpha is a coverage and
// never sRGB-encoded.
void convert_values(const std::uint32_t* from, std::uint32_t* to, const OutputColor& image) noexcept {
    const Format format = image.color.format;
    const float alpha = blended_value(format, 3, from[3]);
    for (int c = 0; c < 3; ++c) {
        float v = blended_value(format, c, from[c]);
        if (image.premultiplied) v = alpha > 0 ? v / alpha : 0.0f;
        to[c] = is_linear(image) ? encode_srgb8(v) : pipeline::to_unorm8(v);
    }
    to[3] = pipeline::to_unorm8(alpha);
}

}  // namespace

Image as_straight_rgba8(const OutputColor& image) {
    const FloatEnvironment environment;
    const Image& color = image.color;
    assert(color.channels() == 4 && color.samples == 1);
    const ChannelType type = pipeline::info(color.format).type;
    // An rgba8 target of a linear frame has linear codes and must be encoded like any other.
    const bool copies_codes = type == ChannelType::unorm8 && !is_linear(image);
    Image result{Format::rgba8, color.width, color.height};
    // Red, green, blue and alpha are four consecutive codes per pixel.
    for (std::size_t i = 0; i < color.codes.size(); i += 4) {
        if (copies_codes)
            convert_codes(&color.codes[i], &result.codes[i], image.premultiplied);
        else
            convert_values(&color.codes[i], &result.codes[i], image);
    }
    return result;
}

}  // namespace strata::scenes
