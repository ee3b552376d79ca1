// pipeline/vertices/other_splits.h - submits the same surfaces in a different form. The depths should not change, but
// do if the device's interpolation depends on that form.
//
// Rule     Rotating: corners (0, 1, 2) of every triangle become (k, k + 1, k + 2) modulo 3. Flipping: two consecutive
//          triangles of a mesh form a quad if they share a side in opposite directions and are in one plane; (a, b, c)
//          and (c, d, a) become (b, c, d) and (d, a, b). In one plane means: the distance of d from the plane of the
//          first triangle is at most 2^-20 of their longest side, and the quad is convex; both limits are assumed.
//          Lines and points stay as they are. Moving: every window position moves by whole pixels, exactly, and so does
//          the viewport.
// Tests    tests/pipeline/vertices/other_splits_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/vertices/draw_list.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// k may be any integer; it is used modulo 3.
[[nodiscard]] DrawList rotate_vertices(DrawList list, int k);

struct Flipped {
    DrawList list;
    std::uint64_t quads = 0;  // number of quads whose diagonal changed
};
// A triangle belongs to at most one quad: the second of a pair is not considered again.
[[nodiscard]] Flipped flip_diagonals(DrawList list);

// The viewport must stay within 0 .. 32768, and every position within +-65536 pixels.
void move_window(rasterizer::Geometry& geometry, int x_px, int y_px);

}  // namespace strata::pipeline
