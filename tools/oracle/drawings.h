// tools/oracle/drawings.h - a comparison as pictures: how far apart, which kind where, and all side by side.
#pragma once
#include "pipeline/formats/image.h"
#include "tools/oracle/compare.h"
#include "tools/oracle/heat_scale.h"

namespace strata::oracle {

// How far each pixel is from the reference's, in codes: black where they are equal, else the colour of a HeatScale up
// to the greatest distance (heat_scale.h).
[[nodiscard]] pipeline::Image heat_map(const Comparison& comparison);
// The scale of that map.
[[nodiscard]] HeatScale heat_scale(const Comparison& comparison);
// The map with its legend below; at least as wide as the legend.
[[nodiscard]] pipeline::Image heat_map_with_legend(const Comparison& comparison);

// Black where the pictures are equal; else the colour of the kind.
[[nodiscard]] pipeline::Image kind_map(const Comparison& comparison);
// 8-bit red, green, blue of a kind.
[[nodiscard]] std::array<std::uint8_t, 3> color_of(Kind kind) noexcept;

// The target that people look at first: colours before depths; grey for one channel, nearer brighter for depths.
[[nodiscard]] pipeline::Image as_shown(const Picture& picture);

// Reference, candidate, heat map and map of kinds with a grey line between them; below the maps the scale in codes, and
// the kinds that there are.
[[nodiscard]] pipeline::Image side_by_side(const Picture& reference, const Picture& candidate,
                                           const Comparison& comparison);

}  // namespace strata::oracle
