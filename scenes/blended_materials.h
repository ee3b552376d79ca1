// scenes/blended_materials.h - draws single materials as transparent, for --alpha NAME=A.
//
// Rule     Each material of that name becomes BLEND, its colours' alpha times A. A material with an alpha test (MASK)
//          is rejected: blended, it would show the discarded parts.
// Tests    tests/scenes/blended_materials_test.cpp
#pragma once
#include <span>
#include <string>

#include "scenes/scene.h"

namespace strata::scenes {

// Throws InputError, which names the scene `spec`, for a name that no material has.
void blend_materials(pipeline::DrawList& list, std::span<const MaterialAlpha> wanted, const std::string& spec);

}  // namespace strata::scenes
