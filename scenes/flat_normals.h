// scenes/flat_normals.h - flat normals, one per triangle, for a lit mesh without normals.
//
// Rule     The cross product of two sides in binary64, divided by its length; (0, 0, 1) if the length is 0 or not
//          finite.
// Source   glTF 2.0, 3.7.2.1.
// Tests    tests/scenes/gltf/gltf_mesh_test.cpp
#pragma once
#include "pipeline/vertices/draw_list.h"

namespace strata::scenes {

// Takes three positions per triangle, without shared vertices, and returns three normals per triangle.
[[nodiscard]] std::vector<Vec3> flat_normals(const std::vector<Vec3>& positions);

// Gives every corner its own vertex, and each triangle its flat normal.
void make_flat(pipeline::Mesh& mesh);

}  // namespace strata::scenes
