// scenes/gltf/nodes.h - the transforms of a scene's nodes, and the views of its cameras.
//
// Rule     Binary64. local = matrix, or translation * rotation * scale; world = parent * local, each element
//          ((a0 b0 + a1 b1) + a2 b2) + a3 b3. A mirrored matrix is unchanged: the pipeline uses the determinant's sign.
//          A camera looks along -z of its world frame; scale, shear and mirroring of that frame are ignored.
// Source   glTF 2.0, 3.5.3 (transformations), 3.10 (cameras).
// Tests    tests/scenes/gltf/gltf_node_test.cpp
#pragma once
#include <array>
#include <span>

#include "scenes/gltf/model.h"
#include "scenes/scene.h"

namespace strata::scenes {

struct PlacedNode {
    int node = 0;
    pipeline::Matrix world = pipeline::identity;
};

// Depth first, parents before children, in the file's order. Iterative, so any depth is possible.
[[nodiscard]] std::vector<PlacedNode> place_nodes(const tinygltf::Model& model, std::span<const int> roots,
                                                  const std::string& file);

// translation * rotation * scale, the rotation a quaternion x y z w.
[[nodiscard]] pipeline::Matrix transform_of(const std::array<double, 3>& translation,
                                            const std::array<double, 4>& rotation,
                                            const std::array<double, 3>& scale) noexcept;
[[nodiscard]] pipeline::Matrix local_transform(const tinygltf::Node& node) noexcept;

// The rigid inverse of a camera node's world transform; InputError if its axes are degenerate.
[[nodiscard]] pipeline::Matrix view_of(const pipeline::Matrix& world, const FileLocation& location);

}  // namespace strata::scenes
