// scenes/images/scaled_pnm.h - reads PNM files whose maxval is not 255: OpenImageIO 2.4 rounds their samples down, also
// 16-bit ones.
//
// Rule     A sample s of maxval m becomes the code s c / m rounded to nearest, halves up; c is 255 if m < 256, else
//          65535.
// Source   Netpbm's pages pgm and ppm: P2, P3 in decimals, P5, P6 in bytes or big-endian words after one whitespace
//          character.
// Tests    tests/tools/oracle/picture/read_picture_test.cpp
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "scenes/images/image_module.h"

namespace strata::scenes::images {

// For an image that OpenImageIO has accepted, with that many channels; empty for other kinds of PNM and if maxval is
// 255. Fails at `location` for a maxval beyond 1 to 65535.
[[nodiscard]] std::optional<FileCodes> scaled_pnm(std::string_view bytes, const FileLocation& location, int width,
                                                  int height, int channels);

}  // namespace strata::scenes::images
