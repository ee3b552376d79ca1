// scenes/images/png_encode.h - 8-bit colours as the bytes of a PNG file, by libpng.
//
// Rule     Rows from the top, codes as they are: no gamma, no palette; each row by the filter that libpng chooses.
//          Texts stand in front of the picture, each a chunk tEXt.
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

// width x height pixels of `channels` codes: 3 for red, green and blue, 4 with an alpha that the colours are not
// multiplied by.
struct PngPicture {
    int width = 0, height = 0, channels = 4;
    std::function<void(int y, std::uint8_t* codes)> row;  // writes width * channels codes of row y
    std::map<std::string, std::string> texts{};           // a keyword of 1 to 79 bytes of Latin-1, and its text
};

// Hands the file on in parts. Answers "", or libpng's words for what failed, among them that `put` answered false. What
// `row` and `put` throw comes through.
[[nodiscard]] std::string encode_png(const PngPicture& picture,
                                     const std::function<bool(const void* bytes, std::size_t size)>& put);

// Red, green and blue of an rgba8 image as a whole file.
[[nodiscard]] std::string png_bytes(const pipeline::Image& image);

}  // namespace strata::scenes
