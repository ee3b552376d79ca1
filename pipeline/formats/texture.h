// pipeline/formats/texture.h - textures: 2D and rectangle images, and how they are sampled.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strata::pipeline {

enum class TextureTarget : std::uint8_t {
    two_d,
    rectangle
};  // rectangle: unnormalised coordinates (NV_texture_rectangle)
enum class TextureFilter : std::uint8_t { nearest, linear };
enum class TextureWrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

// Four 8-bit channels a texel, row 0 at t = 0 (glTF's top row), straight alpha, in the frame's encoded colour space.
struct Texture {
    std::string name;
    TextureTarget target = TextureTarget::two_d;
    int width = 1, height = 1;
    TextureFilter filter = TextureFilter::linear;  // magnification's; mip levels are not emulated
    TextureWrap wrap_s = TextureWrap::repeat, wrap_t = TextureWrap::repeat;
    bool decode_srgb = false;  // --colour linear: r g b decoded by the exact 256-entry table (srgb.h) before filtering
    std::vector<std::uint8_t> texels;  // width * height * 4
    friend bool operator==(const Texture&, const Texture&) = default;
};

}  // namespace strata::pipeline
