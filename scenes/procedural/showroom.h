// scenes/procedural/showroom.h - a scene with one example of everything that a renderer can get wrong, in a frame of 64
// x 64 pixels.
//
// Rule     Positions are given in pixels of that frame and by w, the distance from the eye, which looks along -z: depth
//          is 1 - 1 / w. Opaque: a wall, a tilted post, a masked and textured sign. Transparent: a pane in strong
//          perspective with different colours and alphas at its corners, panes that face the eye and that face away, of
//          one and of two colours, lit and unlit, exact ties, near-coincident and crossing planes, a pane that is
//          clipped by the near plane and one that is in it, edges through pixel centres, slivers, a textured pane, one
//          with alpha 1 and one that the wall hides.
// Tests    tests/scenes/procedural/showroom_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

[[nodiscard]] Scene make_showroom(const SceneOptions& options);

}  // namespace strata::scenes
