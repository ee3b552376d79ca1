// tools/lab/hardware_check/drawing/compare.h - compares a drawn picture with a capture of the NV2A chip.
//
// Rule     Each picture is read as one 32-bit word per pixel, of one of four kinds: a colour (r g b a from the lowest
//          byte); coverage (1 if the pixel is not the background); a 16-bit depth, which a capture stores as R5G6B5
//          extended to 8 bits; a 24-bit depth above an 8-bit stencil, which a capture stores in its bytes A R G and B.
//          Not compared: the captures' text labels, whose pixels are (255, 255, 255, 0) or SuitePicture::overdrawn, and
//          the rectangles that a suite of captures hides. Colours differ by their largest channel difference in 1/255,
//          other words by their units. The kept digests of hardware_digests.txt depend on label_box and digest_outside.
// Source   the captures' own descriptions, repeated in pipeline/reference/chip-fragment.md and
//          rasterizer/reference/chip-geometry.md.
// Tests    tests/tools/lab/hardware_check/suites_test.cpp
#pragma once
#include <array>
#include <map>

#include "tools/lab/hardware_check/drawing/picture.h"

namespace strata::hardware_check {

// The result for one picture. Counts are of pixels.
struct CaptureComparison {
    std::uint64_t compared = 0, differing = 0;
    // The largest difference of a pixel: 1/255 for a colour, else units of depth with the stencil in the low byte.
    std::uint32_t largest = 0;
    // The capture's value minus ours, mapped to the number of pixels. For a colour it is the magnitude of the worst
    // channel.
    std::map<std::int64_t, std::uint64_t> histogram{};
    // x, y of the first differing pixel, in rows from the top, and both words there.
    std::array<int, 2> first{};
    std::uint32_t ours = 0, theirs = 0;
    // At most as many pixels differ as `SuitePicture::bound` allows, each by at most its units.
    bool within_bound = false;
};

// `capture` is rgba8. Throws InputError, which names `path`, if its size differs.
[[nodiscard]] CaptureComparison compare(const SuitePicture& drawn, const pipeline::Image& capture,
                                        const std::string& path);

// For viewing: differences, red if the capture's value is larger and cyan if it is smaller; labels are white.
[[nodiscard]] pipeline::Image difference_picture(const SuitePicture& drawn, const pipeline::Image& capture);

// The bounding rectangle of all label pixels; empty if there are none.
[[nodiscard]] rasterizer::Rect label_box(const SuitePicture& drawn, const pipeline::Image& capture);
// Digest of the words outside a rectangle and the hidden ones, with those inside replaced by 0: of the picture, or of
// the capture.
[[nodiscard]] std::string digest_outside(const rasterizer::Rect& box, const SuitePicture& drawn);
[[nodiscard]] std::string digest_outside(const rasterizer::Rect& box, const SuitePicture& drawn,
                                         const pipeline::Image& capture);

}  // namespace strata::hardware_check
