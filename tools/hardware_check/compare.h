// tools/hardware_check/compare.h - a drawn picture against the chip's.
//
// Rule     Both are read as a word a pixel: r g b a from the lowest byte on; 1 where a pixel is not the background; a
//          16-bit depth, which a capture shows as R5G6B5 widened; a 24-bit depth above its stencil, which it shows in A
//          R G and B. Label pixels of a colour capture, (255, 255, 255, 0) and what was overdrawn, and hidden
//          rectangles are not compared. Colours differ by their largest channel difference in 1/255, the rest by units.
// Source   the captures' own descriptions, as repeated in chip-fragment.md and chip-geometry.md.
// Tests    tests/tools/hardware_check/suites_test.cpp
#pragma once
#include <array>
#include <map>

#include "tools/hardware_check/picture.h"

namespace strata::hardware_check {

// The outcome for one picture. Counts are pixels.
struct Comparison {
    std::uint64_t compared = 0, differing = 0;
    // The greatest difference of a pixel: 1/255 of a colour, else units of depth with the stencil
    // below.
    std::uint32_t largest = 0;
    // Theirs minus ours, to the number of such pixels. A colour's difference has no sign: the size
    // of its worst channel stands for it.
    std::map<std::int64_t, std::uint64_t> histogram{};
    // x, y of the first differing pixel in rows from the top, and both words there.
    std::array<int, 2> first{};
    std::uint32_t ours = 0, theirs = 0;
    // At most as many pixels as `Picture::bound` allows, each by at most its units.
    bool within_bound = false;
};

// `capture`: rgba8. Throws InputError, naming `path`, if its size is another.
[[nodiscard]] Comparison compare(const Picture& drawn, const pipeline::Image& capture, const std::string& path);

// For people: what differs, red where theirs is more and cyan where it is less; labels are white.
[[nodiscard]] pipeline::Image difference_picture(const Picture& drawn, const pipeline::Image& capture);

// The smallest rectangle round all label pixels; empty if there are none.
[[nodiscard]] rasterizer::Rect label_box(const Picture& drawn, const pipeline::Image& capture);
// Digest of the words outside a rectangle and the hidden ones, those inside taken as 0: of the picture, or of the
// capture.
[[nodiscard]] std::string digest_outside(const rasterizer::Rect& box, const Picture& drawn);
[[nodiscard]] std::string digest_outside(const rasterizer::Rect& box, const Picture& drawn,
                                         const pipeline::Image& capture);

}  // namespace strata::hardware_check
