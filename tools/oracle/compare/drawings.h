// tools/oracle/compare/drawings.h - renders a comparison as images: a heat map of differences, a map of difference
// kinds, and a side-by-side sheet.
#pragma once
#include "pipeline/formats/image.h"
#include "tools/oracle/compare/compare.h"
#include "tools/oracle/compare/heat_scale.h"

namespace strata::oracle {

// Per pixel, the difference to the reference in codes: black if equal, else heat_scale(comparison).color(distance).
[[nodiscard]] pipeline::Image heat_map(const Comparison& comparison);
// The scale of that map.
[[nodiscard]] HeatScale heat_scale(const Comparison& comparison);
// The heat map with the legend below it, padded to least_legend_width_px.
[[nodiscard]] pipeline::Image heat_map_with_legend(const Comparison& comparison);

// Per pixel color_of(kind of difference) (Kind: compare.h); black where the images are equal.
[[nodiscard]] pipeline::Image kind_map(const Comparison& comparison);
// 8-bit red, green, blue of a kind.
[[nodiscard]] std::array<std::uint8_t, 3> color_of(Kind kind) noexcept;

// The target of that name, else the image's first colour target, or the depth if it has none, converted for viewing:
// one channel as grey, depth inverted (near is bright).
[[nodiscard]] pipeline::Image as_shown(const Picture& picture, const std::string& name = "");

// Pictures of any sizes next to each other, separated by grey lines.
[[nodiscard]] pipeline::Image beside(const std::vector<pipeline::Image>& images);

// Reference, candidate, heat map and map of kinds, separated by grey lines; below the maps the heat map's legend in
// codes and the legend of the kinds that occur.
[[nodiscard]] pipeline::Image side_by_side(const Picture& reference, const Picture& candidate,
                                           const Comparison& comparison);

}  // namespace strata::oracle
