// pipeline/formats/texture.h - textures: 2D and rectangle images, and how they are sampled.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strata::pipeline {

// two_d takes coordinates 0..1, rectangle takes texel coordinates (NV_texture_rectangle).
enum class TextureTarget : std::uint8_t { two_d, rectangle };
enum class TextureFilter : std::uint8_t { nearest, linear };
// The wrap mode of texels outside the image (pipeline/reference/texturing.md 2.3); rectangle textures always clamp.
enum class TextureWrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

// Four 8-bit channels per texel, row 0 at t = 0 (glTF's top row), straight alpha, in the frame's encoded colour space.
struct Texture {
    std::string name;
    TextureTarget target = TextureTarget::two_d;
    int width = 1, height = 1;
    // The magnification filter: mip levels are not emulated.
    TextureFilter filter = TextureFilter::linear;
    TextureWrap wrap_s = TextureWrap::repeat, wrap_t = TextureWrap::repeat;
    // --color-space linear: r g b are converted to linear by the table of srgb.h before filtering; alpha never is.
    bool decode_srgb = false;
    // width * height * 4 bytes, row by row.
    std::vector<std::uint8_t> texels;
    friend bool operator==(const Texture&, const Texture&) = default;
};

}  // namespace strata::pipeline
