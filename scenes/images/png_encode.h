// scenes/images/png_encode.h - encodes 8-bit colours as a PNG file with libpng.
//
// Rule     Rows from the top, codes unchanged, without gamma and palette; libpng chooses the filter of each row. Texts
//          precede the image, one tEXt chunk each.
// Source   PNG (ISO/IEC 15948), 11.2 and 11.3.4.3
// Tests    tests/scenes/files/png_encode_test.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "pipeline/formats/image.h"

namespace strata::scenes {

// width x height pixels of `channels` codes: 3 for red, green and blue, 4 with an alpha by which the colours are not
// multiplied.
struct PngPicture {
    int width = 0, height = 0, channels = 4;
    std::function<void(int y, std::uint8_t* codes)> row;  // writes width * channels codes of row y
    std::map<std::string, std::string> texts{};           // a keyword of 1 to 79 bytes of Latin-1, and its text
};

// Passes the file to `put` in parts. Returns "", or libpng's error message, also if `put` returned false. Exceptions of
// `row` and `put` are passed on.
[[nodiscard]] std::string encode_png(const PngPicture& picture,
                                     const std::function<bool(const void* bytes, std::size_t size)>& put);

// Red, green and blue of an rgba8 image as a complete file.
[[nodiscard]] std::string png_bytes(const pipeline::Image& image);

}  // namespace strata::scenes
