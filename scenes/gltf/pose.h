// scenes/gltf/pose.h - the shape in which a file shows a mesh without animation: morph targets and a skin.
//
// Rule     Morph targets: value = f32(base + w0 d0 + w1 d1 ...) in binary64, in the order of the targets, for each
//          attribute; the weights are the node's, else the mesh's, else 0.
//          Skin: the matrix of a vertex is the sum of w (world of the joint * inverse bind matrix), divided by the sum
//          of w; weights that are all 0 count as 1 for the first joint. Positions become world space and the node's
//          transform is not used; normals are multiplied by the inverse transpose. Below a node whose determinant is
//          negative the triangles keep their front: their second and third corner are exchanged.
// Source   glTF 2.0, 3.7.2.2 (morph targets), 3.7.3 (skins), 3.7.4 (weights and determinants).
// Tests    tests/scenes/gltf/gltf_pose_test.cpp
#pragma once
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "scenes/gltf/accessor.h"
#include "scenes/gltf/document/warnings.h"
#include "scenes/gltf/nodes.h"

namespace strata::scenes {

// A mesh is stored once for each pose in which it is shown.
struct Pose {
    std::vector<double> weights{};  // of the morph targets; empty if all are 0
    int skin = -1;
    bool is_mirrored = false;  // false without a skin
    // The libraries of browsers compare no vectors in three ways.
    friend bool operator<(const Pose& a, const Pose& b) {
        return std::tie(a.weights, a.skin, a.is_mirrored) < std::tie(b.weights, b.skin, b.is_mirrored);
    }
};
[[nodiscard]] Pose pose_of(const JsonAt& node, const JsonAt& mesh, const pipeline::Matrix& world);

// An attribute of a primitive with its morph targets added. Targets whose weight is 0 are not read.
class MorphedAttribute {
  public:
    MorphedAttribute(const JsonAt& primitive, const std::string& name, std::span<const double> weights,
                     Accessors& accessors, Budget& budget);

    [[nodiscard]] std::array<float, 4> element(std::size_t vertex) const;
    [[nodiscard]] std::size_t components() const { return base_.components(); }

  private:
    struct Target {
        const AccessorReader& reader;
        double weight;
    };
    const AccessorReader& base_;
    std::vector<Target> targets_;
};

// The matrices of the joints of every skin that is used, in world space.
class Skins {
  public:
    Skins(const Document& document, const tinygltf::Model& model, Accessors& accessors, Budget& budget)
        : document_{document}, model_{model}, accessors_{accessors}, budget_{budget} {}

    // World transform of each joint times its inverse bind matrix.
    [[nodiscard]] std::span<const pipeline::Matrix> joints(int skin);

  private:
    [[nodiscard]] std::vector<pipeline::Matrix> read(std::size_t skin);

    const Document& document_;
    const tinygltf::Model& model_;
    Accessors& accessors_;
    Budget& budget_;
    std::map<int, std::vector<pipeline::Matrix>> skins_;
    std::vector<pipeline::Matrix> worlds_;  // of all nodes of the file, also of those outside the scene
};

// True if the primitive has joints and weights.
[[nodiscard]] bool has_joints(const JsonAt& primitive);

// One matrix for each of the vertices.
[[nodiscard]] std::vector<pipeline::Matrix> skin_matrices(const JsonAt& primitive,
                                                          std::span<const pipeline::Matrix> joints,
                                                          std::span<const std::uint32_t> vertices, Accessors& accessors,
                                                          Warnings& warnings);
[[nodiscard]] pipeline::Vec3 skinned_position(const pipeline::Matrix& m, const pipeline::Vec3& position) noexcept;
[[nodiscard]] pipeline::Vec3 skinned_normal(const pipeline::Matrix& m, const pipeline::Vec3& normal) noexcept;

}  // namespace strata::scenes
