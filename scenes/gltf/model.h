// scenes/gltf/model.h - a checked document as tinygltf's structs, with glTF's default values filled in.
//
// Rule     tinygltf sees what the scene needs and nothing else: buffers, images, extras, extensions and ignored
//          features are taken out first, so it opens no file, decodes nothing and meets no shape that check.h has not
//          passed.
// Source   tinygltf 2.7 checks little itself: a uri that is a folder, or deep nesting, ends the process.
#pragma once
#include <tiny_gltf.h>

#include "scenes/gltf/document/buffers.h"

namespace strata::scenes {

[[nodiscard]] tinygltf::Model to_model(const Document& document);

}  // namespace strata::scenes
