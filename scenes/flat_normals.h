// scenes/flat_normals.h - the normals of a lit mesh that has none: each triangle's own.
//
// Rule     The cross product of two sides in binary64, over its length; (0, 0, 1) where that is 0 or not finite.
// Source   glTF 2.0, 3.7.2.1.
// Tests    tests/scenes/gltf/gltf_mesh_test.cpp
#pragma once
#include "pipeline/vertices/draw_list.h"

namespace strata::scenes {

// Three positions a triangle, which share no corner: three normals a triangle.
[[nodiscard]] std::vector<Vec3> flat_normals(const std::vector<Vec3>& positions);

// Gives every corner a vertex of its own, and each triangle its flat normal.
void make_flat(pipeline::Mesh& mesh);

}  // namespace strata::scenes
