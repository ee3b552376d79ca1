// tools/oracle/drawings.h - a comparison as pictures: where which kind of difference is, and the three side by side.
#pragma once
#include "pipeline/formats/image.h"
#include "tools/oracle/compare.h"

namespace strata::oracle {

// Black where the pictures are equal; else the colour of the kind, the brighter the greater the distance (by its logarithm).
[[nodiscard]] pipeline::Image heat_map(const Comparison& comparison);

// 8-bit red, green, blue of a kind, as heat maps have it at its brightest.
[[nodiscard]] std::array<std::uint8_t, 3> color_of(Kind kind) noexcept;

// The target that people look at first: colours before depths; grey for one channel, nearer brighter for depths.
[[nodiscard]] pipeline::Image as_shown(const Picture& picture);

// Reference, candidate and heat map with a grey line between them.
[[nodiscard]] pipeline::Image side_by_side(const Picture& reference, const Picture& candidate,
                                           const Comparison& comparison);

}  // namespace strata::oracle
