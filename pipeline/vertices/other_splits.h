// pipeline/vertices/other_splits.h - the same surfaces, handed to the machine in another way: what must not change a
// depth, and does where a device's interpolation depends on it.
//
// Rule     Rotating: corners (0, 1, 2) of every triangle become (k, k + 1, k + 2) modulo 3. Flipping: two triangles of
//          a mesh, one after the other, that share a side which they walk in opposite directions and lie in one plane
//          are a quad; (a, b, c) and (c, d, a) become (b, c, d) and (d, a, b). In one plane: d is off the plane of the
//          first by at most 2^-20 of their longest side, and the quad is convex [A]. Moving: every position in the
//          window moves by whole pixels, exactly, and the viewport with it.
// Tests    tests/pipeline/vertices/other_splits_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/vertices/draw_list.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// k may be any integer: it counts modulo 3.
[[nodiscard]] DrawList rotate_vertices(DrawList list, int k);

struct Flipped {
    DrawList list;
    std::uint64_t quads = 0;  // whose diagonal changed
};
// A triangle belongs to one quad at most: the second of a pair is not looked at again.
[[nodiscard]] Flipped flip_diagonals(DrawList list);

// The viewport must stay within 0 .. 32768, every position within +-65536 pixels.
void move_window(rasterizer::Geometry& geometry, int x_px, int y_px);

}  // namespace strata::pipeline
