// pipeline/formats/narrow.h - colour surfaces that store less than 8 bits per channel, or no alpha.
//
// Rule     A store truncates: 5 or 6 bits of a colour channel, 7 bits of x1a7r8g8b8's alpha. The blender reads back
//          colours with zeros in the low bits, alpha as a7 << 1 | a7 >> 6, and 255 if there is no alpha. A target
//          stores its codes as they are read back, so storing them again does not change them. With 16 bits per pixel
//          the source colours are truncated to these bits before blending too; source alpha is not.
// Source   pipeline/reference/formats.md 4, chip-fragment.md 5: 16 captures and 16 sets of corners. The truncation of
//          the source follows from the capture R5G6B5_Add_SrcA_1-SrcA: with it all pixels are equal, without it 11,524
//          differ. For surfaces with only 5-bit channels it is assumed.
// Tests    tests/pipeline/formats/narrow_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/formats/format.h"

namespace strata::pipeline {

// Narrows `code`, the blender's 8-bit result. Channel 0 is r, 3 is a.
[[nodiscard]] constexpr std::uint32_t narrowed(Format format, int channel, std::uint32_t code) noexcept {
    const bool is_alpha = channel == 3;
    switch (format) {
        case Format::x8r8g8b8: return is_alpha ? 255 : code;
        case Format::x1a7r8g8b8: return is_alpha ? (code >> 1 << 1) | code >> 7 : code;
        case Format::r5g6b5: return is_alpha ? 255 : channel == 1 ? code & 0xfcu : code & 0xf8u;
        case Format::x1r5g5b5: return is_alpha ? 255 : code & 0xf8u;
        default: return code;
    }
}

}  // namespace strata::pipeline
