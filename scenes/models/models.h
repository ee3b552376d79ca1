// scenes/models/models.h - loads an OBJ, PLY, STL or OFF file as a scene.
//
// Rule     Positions, normals, colours and texture coordinates are the file's, polygons are split into triangles. There
//          is one mesh per group, drawn once. Colours are sRGB values, not premultiplied: the material's diffuse one
//          (OBJ; white in the other formats) times the vertex's. A material whose opacity is below 1, or a mesh with an
//          alpha below 1, is BLEND, everything else OPAQUE; `--alpha MATERIAL=A` blends one material. All materials are
//          two-sided, and lit unless the material is `illum 0`; without normals shading is flat. Textures are PNG or
//          JPEG files of the model's folder; v is up, as in these formats.
// Source   Assimp reads the files (model_module.h).
// Tests    tests/scenes/models/models_test.cpp
#pragma once
#include <string>

#include "scenes/scene.h"

namespace strata::scenes {

// By the name's ending: .obj, .ply, .stl or .off.
[[nodiscard]] bool is_model(const std::string& path);
// True if the ending is that of a model format that a converter can turn into .glb: .fbx, .dae, .3ds, .blend, .usd,
// .wrl, .x3d ...
[[nodiscard]] bool is_foreign_model(const std::string& path);

// InputError names the file and what is wrong with it.
[[nodiscard]] Scene load_model(const std::string& path, const SceneOptions& options);

}  // namespace strata::scenes
