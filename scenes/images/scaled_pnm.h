// scenes/images/scaled_pnm.h - PNM files whose greatest sample is not 255: OpenImageIO 2.4 rounds their samples down,
// 16-bit ones too.
//
// Rule     A sample s of greatest value m is the code s c / m to the nearest, halves up; c is 255 where m < 256, else
//          65535.
// Source   Netpbm's pages pgm and ppm: P2, P3 in decimals, P5, P6 in bytes or big-endian words behind one blank.
// Tests    tests/tools/oracle/read_picture_test.cpp
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "scenes/images/image_module.h"

namespace strata::scenes::images {

// Of a picture that OpenImageIO has found sound, with that many channels; nothing for other kinds of PNM, and where the
// greatest sample is 255.
[[nodiscard]] std::optional<StoredCodes> scaled_pnm(std::string_view bytes, int width, int height, int channels);

}  // namespace strata::scenes::images
