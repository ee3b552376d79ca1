// scenes/procedural/shadow_demo.h - a teapot on a plane, behind a pane of glass, with a light that casts shadows.
//
// Rule     The pot of teapot.h, opaque and in one colour, on a square of 9 x 9; a pane of alpha 0.4 is next to it. The
//          light looks from (-5.5, 6.5, 3) at (0.2, 0.8, 0), 75 degrees wide, near 2 and far 18; a map of 1024 x 1024
//          texels; shadowed surfaces keep 0.4 of their colour. Polygon offset (1.5, 8) keeps lit surfaces from
//          shadowing themselves.
// Source   Everitt 2001, "Shadow Mapping".
// Tests    tests/scenes/procedural/procedural_test.cpp, tests/peeling/frame/shadow_light_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

[[nodiscard]] Scene make_shadow_demo(const SceneOptions& options);

}  // namespace strata::scenes
