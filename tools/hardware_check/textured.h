// tools/hardware_check/textured.h - quads whose corners bring coordinates of texture units, and combiners that show a
// register.
//
// Rule     Corners are listed as in shapes.h. The tests give all corners of a quad one w, so none is needed here: w
//          is 1.
// Source   chip-depth.md 6 and 7, chip-geometry.md 4.
#pragma once
#include "pipeline/region/fragment_path.h"
#include "tools/hardware_check/shapes.h"

namespace strata::hardware_check {

using Coordinate = std::array<float, 4>;  // s t r q
struct TexturedCorner {
    float x, y;
    std::array<Coordinate, rasterizer::texture_units> unit{};
};
[[nodiscard]] TriangleSoup textured_quad(const std::array<TexturedCorner, 4>& corner, Argb color = 0xffffffff);

// No general stage; the final one gives `color` as it is, and as alpha the register's own or, from `zero`, 1.
[[nodiscard]] pipeline::Combiners show(pipeline::CombinerRegister color, pipeline::CombinerRegister alpha);

// A square checker of `texels` a side, nearest lookups; its cells have `cell` texels a side, and the one at texel (0,
// 0) is `first`.
[[nodiscard]] pipeline::Texture checker(int texels, int cell, Argb first, Argb second);

// A lookup at s/q, t/q in texels.
[[nodiscard]] pipeline::ShaderStage rectangle_lookup(const pipeline::BoundTexture& texture);

}  // namespace strata::hardware_check
