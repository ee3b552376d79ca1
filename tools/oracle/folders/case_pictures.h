// tools/oracle/folders/case_pictures.h - the small pictures that show a failed case of two folders.
//
// Rule     A picture whose longer side exceeds `thumbnail_px` is shrunk by a whole number: colours to the mean of a
//          square, rounded to the nearest code, the heat map to the greatest distance in it, so that a single pixel
//          stays visible.
// Tests    tests/tools/oracle/folders/case_pictures_test.cpp
#pragma once
#include <vector>

#include "tools/oracle/folders/compare_folders.h"

namespace strata::oracle {

inline constexpr int thumbnail_px = 256;

// Reference, candidate and heat map.
[[nodiscard]] std::vector<CasePicture> case_pictures(const Picture& reference, const Picture& candidate,
                                                     const Comparison& found);
// Reference and candidate, which were not compared.
[[nodiscard]] std::vector<CasePicture> case_pictures(const Picture& reference, const Picture& candidate);

// Of an rgba8 image. `by`: the side of the square that becomes a pixel; those at the right and lower edge may be cut.
[[nodiscard]] pipeline::Image shrunk(const pipeline::Image& image, int by);
// Of the distances of a comparison alone.
[[nodiscard]] Comparison shrunk_distances(const Comparison& found, int by);

}  // namespace strata::oracle
