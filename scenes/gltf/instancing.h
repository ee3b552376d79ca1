// scenes/gltf/instancing.h - EXT_mesh_gpu_instancing: many instances of a node's mesh.
//
// Rule     Instance i has the transform of its node times TRANSLATION_i ROTATION_i SCALE_i; an absent attribute is the
//          identity's. Application-specific attributes (_NAME) are ignored. The node's camera and children are not
//          repeated.
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

// InputError for an instancing whose accessors are inconsistent; check_accessors must have accepted them.
void check_instancing(const JsonAt& instancing, const JsonAt& root);

// The transforms of the instances, to be multiplied on the right of the node's own. Charges one element per instance.
[[nodiscard]] std::vector<pipeline::Matrix> instance_transforms(const JsonAt& instancing, Accessors& accessors,
                                                                Budget& budget);

}  // namespace strata::scenes
