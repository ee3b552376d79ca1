// pipeline/formats/narrow.h - colour surfaces that store less than 8 bits a channel, or no alpha.
//
// Rule     A store cuts: 5 or 6 bits of a colour channel, 7 of x1a7r8g8b8's alpha. What the blender reads back is
//          filled with zeros below for colours, a7 << 1 | a7 >> 6 for alpha, and 255 where there is no alpha. A target
//          holds its codes as they are read back: storing them again changes nothing. With 16 bits a pixel, the colours
//          of the source are cut to these bits before they are blended, too; its alpha is not.
// Source   formats.md 4, chip-fragment.md 5: 16 pictures and 16 sets of corners. The source's cut: our own, of the
//          capture R5G6B5_Add_SrcA_1-SrcA, all of whose pixels are equal with it and 11,524 are not without; of 5-bit
//          channels throughout it is assumed [A].
// Tests    tests/pipeline/formats/narrow_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/formats/format.h"

namespace strata::pipeline {

// Channel 0 r .. 3 a. `code` as the 8-bit blender leaves it.
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
