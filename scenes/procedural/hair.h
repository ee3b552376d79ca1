// scenes/procedural/hair.h - strands of hair as lines, on an opaque head.
//
// Rule     Strands begin at random points of the unit sphere above y = -1/4 and go on along the normal; each further
//          segment is turned by gravity and by a little chance. Alpha falls from 0.75 at the root to 0.15 at the tip,
//          so that a pixel has tens of layers. Unlit, a material and a mesh for all strands.
// Source   scenes/reference/scenes.md 14
// Tests    tests/scenes/procedural/hair_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

struct Hair {
    std::uint64_t seed = 1;
    int strands = 1000, segments = 8;
};
[[nodiscard]] Scene make_hair(const SceneOptions& options, const Hair& hair);

}  // namespace strata::scenes
