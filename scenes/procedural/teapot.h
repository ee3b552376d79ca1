// scenes/procedural/teapot.h - the Utah teapot on a ground plane, as in Everitt 2001, Figure 3.
//
// Rule     Every patch is evaluated on a grid of (tessellation + 1)^2 points in binary64, y up, units of the table
//          (3.15 high). The outside is red, the inside green, the plane blue; everything is two-sided and BLEND with
//          alpha 0.5. Front faces are counterclockwise seen from outside.
// Source   teapot_patches.h; scenes/reference/scenes.md 2; pipeline/reference/vertices.md 5 and 6 (lighting and
//          facing).
// Tests    tests/scenes/procedural/teapot_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

[[nodiscard]] Scene make_teapot(const SceneOptions& options, int tessellation);

}  // namespace strata::scenes
