// scenes/packs/plain_triangles.h - loads triangles from a .npy or .json file, for users who have buffers and no glTF
// file.
//
// Rule     .npy: binary32 of shape (triangles, 3, 3), x y z of every corner, or (triangles, 3, 7), followed by r g b a;
//          or 4 and 8 numbers, with w after z: clip coordinates, which are drawn without a transform unless a view is
//          given. .json: an object with "positions" [[x, y, z], ...] or [[x, y, z, w], ...] and, optionally, "colors"
//          [[r, g, b, a], ...], one per position, "indices" [[a, b, c], ...] (else every three positions are a
//          triangle; rows of two are lines, of one points) and "view" and "projection", 16 numbers each in column-major
//          order. Without colours all are (1, 1, 1, 0.5). Colours are sRGB values, not premultiplied. All triangles are
//          BLEND, unlit and two-sided.
// Tests    tests/scenes/packs/plain_triangles_test.cpp
#pragma once
#include <string>

#include "scenes/scene.h"

namespace strata::scenes {

// By the name's ending: .npy or .json.
[[nodiscard]] bool is_plain_triangles(const std::string& path);
// True for a .npy file of corners: 32-bit floats in one of the shapes that are loaded. Other arrays are pictures.
[[nodiscard]] bool is_array_of_triangles(const std::string& path);

// InputError names the file and the JSON pointer or element.
[[nodiscard]] Scene load_plain_triangles(const std::string& path, const SceneOptions& options);

}  // namespace strata::scenes
