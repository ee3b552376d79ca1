// tools/oracle/fragments/edge_lists.h - combines the renderings of one pixel by other tie rules and other positions
// into the lists of fragments that a right rasterizer may have there (rule: coverages.h).
//
// Tests    tests/tools/oracle/fragments/coverages_test.cpp
#pragma once
#include <span>

#include "tools/oracle/fragments/coverages.h"

namespace strata::oracle::verdict {

// The renderings of a pixel, the given one first: by the four tie rules, then moved by a fraction of a pixel in the
// four diagonal directions.
using Drawings = std::span<const OtherList* const>;
inline constexpr std::size_t tie_drawings = 4;
inline constexpr std::size_t most_others = 48;  // lists of a pixel

[[nodiscard]] EdgePixel edge_pixel_of(Drawings drawings);
// Sets the spreads of the given rendering to the largest colour changes in the moved ones.
void find_spreads(OtherList& given, Drawings moved);
// The fragment of the same triangle in another rendering; null if the triangle does not cover the pixel there.
[[nodiscard]] const Fragment* same_triangle(const Fragment& f, const OtherList& drawing);

}  // namespace strata::oracle::verdict
