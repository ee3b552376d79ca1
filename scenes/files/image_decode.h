// scenes/files/image_decode.h - decodes a PNG or JPEG in memory to 8-bit RGBA.
//
// Rule     PNG by OpenImageIO's reader "png", JPEG by "jpeg", the format is never guessed. Colours are not multiplied
//          by alpha; colour profiles and gamma chunks are ignored. 16-bit PNG codes become the nearest 8-bit ones: (c +
//          128) / 257 rounded down. Grey is copied to r, g, b; missing alpha is 255. The header is checked first: width
//          and height are at most 16384 texels, and the data must be long enough for the size in the header (deflate
//          packs at most 1032 to 1; a JPEG block takes at least one bit).
// Source   glTF 2.0, 3.8.3; PNG 11.2.2; JPEG: ITU T.81, B.2. JPEG's own arithmetic is libjpeg-turbo's (integer, slow
//          but exact).
// Tests    tests/scenes/gltf/gltf_image_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/gltf/document/container.h"
#include "scenes/gltf/document/file_location.h"
#include "scenes/images/image_module.h"

namespace strata::scenes {

enum class ImageKind : std::uint8_t { png, jpeg };

struct ImageHeader {
    ImageKind kind = ImageKind::png;
    std::uint32_t width = 0, height = 0;
};

// Throws InputError at `location` for anything except a PNG or JPEG of permitted size.
[[nodiscard]] ImageHeader read_image_header(Bytes bytes, const FileLocation& location);

// Throws InputError at `location` for a PNG that a chunk oFFs puts elsewhere than at 0,0 of its page, as cropping does:
// the page's size is in no file, so its pixels have no place in a picture of another size. The header must have been
// read.
void check_png_place(Bytes bytes, const FileLocation& location);

// Throws InputError at `location` if a BMP's pixels are not in the file: the decoder would read them as 0.
void check_bmp_pixels(Bytes bytes, const FileLocation& location);

// Returns width * height * 4 codes, top row first. `header` must be read_image_header's result for the same bytes.
[[nodiscard]] std::vector<std::uint8_t> decode_image(Bytes bytes, const ImageHeader& header,
                                                     const FileLocation& location);

// OpenImageIO's reader for a file's ending: .png, .jpg, .jpeg, .ppm, .pgm, .pbm, .pnm, .tga, .bmp, .hdr, .tif or .tiff,
// in either case. Null for other endings.
[[nodiscard]] const char* reader_of(const std::string& path);
// An image's stored channels and bits, upright, for programs that compare codes; `path` is read whole. InputError if
// the reader cannot read it.
[[nodiscard]] FileCodes read_codes(const std::string& path, const char* reader);

}  // namespace strata::scenes
