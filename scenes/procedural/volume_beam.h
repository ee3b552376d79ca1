// scenes/procedural/volume_beam.h - a stack of alpha-modulated planes crossed by a conical shell, after Carr et al.,
// Figure 1.
//
// Rule     scenes/reference/scenes.md 3, in binary64, each vertex rounded once to binary32. Mesh 0 is the planes in
//          drawing order, mesh 1 the cone. Both are two-sided and BLEND (the cone's alpha is 1; `--alpha` makes it
//          transparent).
// Tests    tests/scenes/procedural/volume_beam_test.cpp
#pragma once
#include "scenes/scene.h"

namespace strata::scenes {

enum class BeamOrder { far, near };  // the end of the stack that is drawn first, seen from +z

[[nodiscard]] Scene make_volume_beam(const SceneOptions& options, int slices, BeamOrder order);

}  // namespace strata::scenes
