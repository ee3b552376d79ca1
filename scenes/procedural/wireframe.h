// scenes/procedural/wireframe.h - the teapot of teapot.h as glass, with the sides of its cells as lines just outside.
//
// Rule     The lines are the sides of the tessellation's cells without their diagonals, each side once where patches
//          meet, moved outwards by 1/64 along the normals, so that no line has the depth of the glass below it. The
//          glass is lit with alpha 0.25, the lines are unlit with alpha 0.75, the ground is as in teapot.h.
// Source   scenes/reference/scenes.md 13
// Tests    tests/scenes/procedural/wireframe_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

[[nodiscard]] Scene make_wireframe(const SceneOptions& options, int tessellation);

}  // namespace strata::scenes
