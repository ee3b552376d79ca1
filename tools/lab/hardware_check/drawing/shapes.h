// tools/lab/hardware_check/drawing/shapes.h - window-space shapes in the chip's vertex order.
//
// Rule     QUADS are the triangles (0,1,2) and (0,2,3); rectangles start at their upper left corner, clockwise in the
//          window. A packed colour is AARRGGBB.
// Source   rasterizer/reference/chip-geometry.md 2.1; pipeline/reference/chip-fragment.md 1.1.
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/region/surface.h"

namespace strata::hardware_check {

using Argb = std::uint32_t;
using rasterizer::ClipVertex;
using rasterizer::TriangleSoup;

[[nodiscard]] pipeline::PixelCode unpack(Argb color);
// r g b a, each code / 255 rounded to binary32.
[[nodiscard]] std::array<float, 4> to_float(Argb color);

// A vertex at window x, y, z.
[[nodiscard]] ClipVertex at(float x, float y, float z, const std::array<float, 4>& color, float w = 1.0f);
[[nodiscard]] inline ClipVertex at(float x, float y, Argb color) { return at(x, y, 0.0f, to_float(color)); }

// Both append to the soup in submission order. Triangles do not share vertices.
void add_triangle(TriangleSoup& soup, const ClipVertex& a, const ClipVertex& b, const ClipVertex& c);
void add_quad(TriangleSoup& soup, const std::array<ClipVertex, 4>& corner);

// A rectangle in window pixels, y down.
struct Box {
    float left, top, right, bottom;
};
void add_box(TriangleSoup& soup, const Box& box, Argb color, float z = 0.0f);
[[nodiscard]] TriangleSoup box(const Box& where, Argb color, float z = 0.0f);

// Copies `image` to (x, y) texel by texel, blended with `state`.
void place(pipeline::Surface& surface, const pipeline::Texture& image, float x, float y, pipeline::DrawState state);
// rgba8 codes as a rectangle texture with nearest filtering.
[[nodiscard]] pipeline::Texture as_texture(const pipeline::Image& image);

// Sets the depth range from `least` to `greatest` in buffer units, where depth 1 is `units`. Both limits are inside,
// although DrawState stores fractions of 1 in binary32.
void limit_depth(pipeline::DrawState& state, double least, double greatest, double units);

[[nodiscard]] float next_below(float positive);  // the next smaller binary32

}  // namespace strata::hardware_check
