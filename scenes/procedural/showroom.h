// scenes/procedural/showroom.h - one of everything that a renderer can get wrong, in a frame of 64 x 64 pixels.
//
// Rule     Places are given in pixels of that frame and by w, the distance from the eye, which looks along -z: depth is
//          1 - 1 / w. Opaque: a wall, a tilted post, a masked and textured sign. Transparent: a pane in strong
//          perspective with its own colour and alpha at each corner, panes that face the eye and that do not, of one
//          and of two colours, lit and unlit, exact ties, near-coincident and crossing planes, a pane that is cut by
//          the near plane and one that lies in it, edges through pixel centres, slivers, a textured pane, one without
//          any transparency and one that the wall hides.
// Tests    tests/scenes/procedural/showroom_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

[[nodiscard]] Scene make_showroom(const SceneOptions& options);

}  // namespace strata::scenes
