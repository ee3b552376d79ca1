// scenes/procedural/plane_stack.h - parallel planes at a chosen distance: far apart, or nearly coincident.
//
// Rule     Plane i of `count` is z = 0.4375 x + 0.3125 y + (i - (count - 1) / 2) gap / 2^20 over x, y in [-1, 1],
//          divided into its own grid of cells + i by cells + i squares, each of them two triangles (a,b,d)(a,d,c); so
//          neighbouring planes have the same slope and different triangles. Colour 0.5 + 0.5 cos(2 pi (t, t - 1/3, t -
//          2/3)) with t = i / count, alpha 1. Unlit, two-sided, BLEND; drawn with the far plane (seen from +z) first.
// Numbers  The slopes and grid steps are not all binary fractions: positions are rounded once to binary32.
// Tests    tests/scenes/procedural/plane_stack_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

struct PlaneStack {
    int count = 6, cells = 8;
    double gap = 65536;  // in 2^-20
};

[[nodiscard]] Scene make_plane_stack(const SceneOptions& options, const PlaneStack& stack);

}  // namespace strata::scenes
