// scenes/models/obj_centre.h - an OBJ file is text in double precision, which Assimp reads as binary32: a model far
// from the origin is moved there before, so that its shape is kept.
//
// Rule     If the step of binary32 at the largest coordinate is more than 2^-16 of the model's size, the middle of the
//          bounds, rounded to whole numbers, is subtracted from every line "v", and is the place of the instances.
// Tests    tests/scenes/far_places_test.cpp
#pragma once
#include <string>

#include "rasterizer/base/vector.h"

namespace strata::scenes {

// Returns what was subtracted; 0 if the text is unchanged.
[[nodiscard]] Vec3d move_obj_to_origin(std::string& text);

}  // namespace strata::scenes
