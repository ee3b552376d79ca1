// tools/oracle/picture/stored_like.h - a rendered target as an image file holds it.
//
// Rule     PNG, JPEG, TGA, BMP and TIFF files of 8 or 16 bits hold sRGB-encoded colours (TargetImage::holds_encoded). A
//          target is converted as the program's writer of PNG does: divided by alpha if the file's colours are
//          straight, encoded if the scene blends linear values, then rounded to a code. Targets of 8-bit codes in the
//          encoded space are left as they are. Colours of srgb8_alpha8 are decoded for a division by alpha and for
//          files of floats. Otherwise EXR, HDR, NPY and plain numbers hold what was rendered. A value in the middle
//          between two codes has either one, because binary32 arithmetic of other programs may put it on the other
//          side: *at a tie* is a value within two ulps of 1.0 of the middle.
// Tests    tests/tools/oracle/picture/stored_like_test.cpp
#pragma once
#include <cstddef>
#include <optional>

#include "pipeline/vertices/draw_list.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

// `space`: of the rendered colours. Empty if `file` holds what was rendered.
[[nodiscard]] std::optional<TargetImage> stored_like(const TargetImage& rendered, const TargetImage& file,
                                                     pipeline::ColorSpace space);

// The number of the file's pixels that have the other code of a value at a tie; empty if a pixel differs otherwise, or
// if the file holds what was rendered.
[[nodiscard]] std::optional<std::size_t> differing_at_ties(const TargetImage& rendered, const TargetImage& file,
                                                           pipeline::ColorSpace space);

// Of pictures in binary32: the pixels that differ, and by how much, if no value differs by more than a sum of some tens
// of layers in another order or in binary64 may (2^-20 where values are at most 1); empty otherwise.
struct RoundedOtherwise {
    std::size_t pixels = 0;
    double greatest = 0;
};
[[nodiscard]] std::optional<RoundedOtherwise> rounded_otherwise(const TargetImage& rendered, const TargetImage& file,
                                                                pipeline::ColorSpace space);

// The picture with its colours stored as those of the candidate.
[[nodiscard]] Picture stored_like(Picture rendered, const Picture& candidate, pipeline::ColorSpace space);

}  // namespace strata::oracle
