// scenes/blended_materials.h - single materials drawn as transparent, as --alpha NAME=A asks.
//
// Rule     Each material of that name becomes BLEND, its colours' alpha times A. A material whose alpha is cut (MASK)
//          is refused: blended, it would show what is cut.
// Tests    tests/scenes/blended_materials_test.cpp
#pragma once
#include <span>
#include <string>

#include "scenes/scene.h"

namespace strata::scenes {

// InputError names `spec`, the scene, for a name that no material has.
void blend_materials(pipeline::DrawList& list, std::span<const MaterialAlpha> wanted, const std::string& spec);

}  // namespace strata::scenes
