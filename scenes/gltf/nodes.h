// scenes/gltf/nodes.h - the transforms of a scene's nodes, and the views of its cameras.
//
// Rule     Binary64. local = matrix, or translation * rotation * scale; world = parent * local, each element
//          ((a0 b0 + a1 b1) + a2 b2) + a3 b3. A mirrored matrix is unchanged: the pipeline uses the determinant's sign.
//          A camera looks along -z of its world frame; scale, shear and mirroring of that frame are ignored.
//          KHR_node_visibility: a hidden node hides all below it, but not their cameras.
// Source   glTF 2.0, 3.5.3 (transformations), 3.10 (cameras); KHR_node_visibility.
// Tests    tests/scenes/gltf/gltf_node_test.cpp
#pragma once
#include <array>
#include <optional>
#include <span>

#include "scenes/gltf/model.h"
#include "scenes/scene.h"

namespace strata::scenes {

// An axis of a transform, or its origin (3).
[[nodiscard]] inline Vec3d column(const pipeline::Matrix& m, std::size_t c) noexcept {
    return {m[c].x, m[c].y, m[c].z};
}

struct PlacedNode {
    int node = 0;
    pipeline::Matrix world = pipeline::identity;
    bool is_hidden = false;  // by itself or a parent (KHR_node_visibility)
};

// Depth first, parents before children, in the file's order. Iterative, so any depth is possible.
[[nodiscard]] std::vector<PlacedNode> place_nodes(const Document& document, const tinygltf::Model& model,
                                                  std::span<const int> roots);

// The nodes that have no parent.
[[nodiscard]] std::vector<int> root_nodes(const tinygltf::Model& model);
// Of every node of the file, in its order.
[[nodiscard]] std::vector<pipeline::Matrix> world_transforms(const Document& document, const tinygltf::Model& model);

// The value of KHR_node_visibility; empty if a node does not have it.
[[nodiscard]] std::optional<JsonAt> visibility_of(const JsonAt& node);

// translation * rotation * scale, the rotation a quaternion x y z w.
[[nodiscard]] pipeline::Matrix transform_of(const std::array<double, 3>& translation,
                                            const std::array<double, 4>& rotation,
                                            const std::array<double, 3>& scale) noexcept;
[[nodiscard]] pipeline::Matrix local_transform(const tinygltf::Node& node) noexcept;

// The rigid inverse of a camera node's world transform; InputError if its axes are degenerate.
[[nodiscard]] pipeline::Matrix view_of(const pipeline::Matrix& world, const FileLocation& location);

// The number of a node's light, if it has one, and that light of the document `root` (lights.cpp), which has been
// checked.
[[nodiscard]] std::optional<std::size_t> light_of(const JsonAt& node);
[[nodiscard]] pipeline::Light to_light(const JsonAt& root, std::size_t number, const PlacedNode& placed,
                                       const FileLocation& location, pipeline::ColorSpace space);

}  // namespace strata::scenes
