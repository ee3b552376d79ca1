// scenes/gltf/instancing.h - EXT_mesh_gpu_instancing: a node's mesh at many places.
//
// Rule     Instance i has the transform of its node times TRANSLATION_i ROTATION_i SCALE_i; what an attribute leaves
//          out is the identity's. Attributes of the application's own (_NAME) are passed over. A camera and children of
//          the node are not repeated.
// Source   glTF, EXT_mesh_gpu_instancing.
// Tests    tests/scenes/gltf/gltf_instancing_test.cpp
#pragma once
#include <vector>

#include "scenes/gltf/accessor.h"
#include "scenes/gltf/check.h"
#include "scenes/gltf/nodes.h"

namespace strata::scenes {

// The extension of a node, if it has one.
[[nodiscard]] std::optional<JsonAt> instancing_of(const JsonAt& node);

// InputError for an instancing whose accessors do not fit together. Of accessors that check_accessors has passed.
void check_instancing(const JsonAt& instancing, const JsonAt& root);

// The transforms of the instances, to be put behind the node's own. Pays an element for each.
[[nodiscard]] std::vector<pipeline::Matrix> instance_transforms(const JsonAt& instancing, Accessors& accessors,
                                                                Budget& budget);

}  // namespace strata::scenes
