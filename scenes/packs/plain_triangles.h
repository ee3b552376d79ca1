// scenes/packs/plain_triangles.h - triangles for users who have buffers and no glTF: a .npy or a .json file.
//
// Rule     .npy: binary32 of shape (triangles, 3, 3), x y z of every corner, or (triangles, 3, 7), with r g b a behind
//          them; or 4 and 8 of them, with w behind z: clip space, which is drawn as it is unless a view is named.
//          .json: an object with "positions" [[x, y, z], ...] or [[x, y, z, w], ...] and, if they are wanted, "colors"
//          [[r, g, b, a], ...], one a position, "indices" [[a, b, c], ...] (else every three positions are a triangle)
//          and "view" and "projection", 16 numbers each by columns. Without colours everything is (1, 1, 1, 0.5).
//          Colours are straight sRGB values. Everything is BLEND, unlit and two-sided.
// Tests    tests/scenes/packs/plain_triangles_test.cpp
#pragma once
#include <string>

#include "scenes/scene.h"

namespace strata::scenes {

// By the name's ending: .npy or .json.
[[nodiscard]] bool is_plain_triangles(const std::string& path);

// InputError names the file and the place.
[[nodiscard]] Scene load_plain_triangles(const std::string& path, const SceneOptions& options);

}  // namespace strata::scenes
