// scenes/gltf/model.h - a checked document as tinygltf's structs, with glTF's default values filled in.
//
// Rule     tinygltf parses only what the scene needs: buffers, images, extras, extensions and ignored features are
//          removed first, so it opens no file, decodes nothing and gets no structure that check.h has not accepted.
// Source   tinygltf 2.7 checks little itself: a uri that is a folder, or deep nesting, crashes the process.
#pragma once
#include <tiny_gltf.h>

#include "scenes/gltf/document/buffers.h"

namespace strata::scenes {

[[nodiscard]] tinygltf::Model to_model(const Document& document);

}  // namespace strata::scenes
