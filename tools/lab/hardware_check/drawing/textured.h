// tools/lab/hardware_check/drawing/textured.h - helpers for capture comparisons: quads with per-vertex texture
// coordinates, and combiner setups that output a register.
//
// Rule     Corners are listed as in shapes.h. w is 1: the captured tests use the same w for all corners of a quad.
// Source   rasterizer/reference/chip-depth.md 6 and 7, rasterizer/reference/chip-geometry.md 4.
#pragma once
#include "pipeline/region/fragment_path.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"

namespace strata::hardware_check {

using Coordinate = std::array<float, 4>;  // s t r q
struct TexturedCorner {
    float x, y;
    std::array<Coordinate, rasterizer::texture_units> unit{};
};
[[nodiscard]] TriangleSoup textured_quad(const std::array<TexturedCorner, 4>& corner, Argb color = 0xffffffff);

// Register combiners without general stages: final RGB = color, final alpha = alpha, or 1 if alpha is
// CombinerRegister::zero.
[[nodiscard]] pipeline::Combiners show(pipeline::CombinerRegister color, pipeline::CombinerRegister alpha);

// A checkerboard of texels x texels, with square cells of cell x cell texels; the top left cell is `first`. Nearest
// filtering.
[[nodiscard]] pipeline::Texture checker(int texels, int cell, Argb first, Argb second);

// Draws a checkerboard of 256 x 256 texels over the whole window, moved by an offset: 0 for a vertex program.
void draw_checkerboard(pipeline::Surface& surface, int cell, Argb first, Argb second, float offset = viewport_offset);

// A rectangle-texture stage: samples at (s/q, t/q) in unnormalized texel coordinates.
[[nodiscard]] pipeline::ShaderStage rectangle_lookup(const pipeline::BoundTexture& texture);

}  // namespace strata::hardware_check
