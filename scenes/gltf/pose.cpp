// scenes/gltf/pose.cpp - adds morph targets and moves vertices by the joints of a skin (pose.h).
#include "scenes/gltf/pose.h"

#include <algorithm>
#include <cmath>

#include "pipeline/vertices/matrix.h"
#include "rasterizer/base/vector_arithmetic.h"

namespace strata::scenes {
namespace {

using pipeline::Matrix;
using pipeline::Vec3;

Vec3d wide(const Vec3& v) { return {double{v.x}, double{v.y}, double{v.z}}; }
Vec3 rounded(const Vec3d& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

double determinant_of(const Matrix& m) noexcept {
    return dot_product(column(m, 0), cross_product(column(m, 1), column(m, 2)));
}

const AccessorReader& reader_of(const JsonAt& owner, const std::string& name, Accessors& accessors) {
    return accessors[owner.member(name).json().get<int>()];
}

// A weight of a joint: finite and not negative.
double joint_weight(float weight, const JsonAt& primitive, std::uint32_t vertex) {
    if (std::isfinite(weight) && weight >= 0) return double{weight};
    primitive.location().fail(std::isfinite(weight) ? "ACCESSOR_WEIGHTS_NEGATIVE" : "ACCESSOR_INVALID_FLOAT",
                              "weights of joints that are finite and not negative",
                              std::to_string(weight) + " at vertex " + std::to_string(vertex));
}

// A weighted sum of matrices, and the sum of the weights.
struct JointSum {
    std::array<Vec3d, 4> sum{};  // columns
    double weights = 0;
    void add(const Matrix& m, double weight) {
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t r = 0; r < 3; ++r) sum[c][r] += weight * m[c][r];
        weights += weight;
    }
    [[nodiscard]] Matrix mean() const {
        Matrix m;
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t r = 0; r < 3; ++r) m[c][r] = sum[c][r] / weights;
        m[3][3] = 1;
        return m;
    }
};

}  // namespace

Pose pose_of(const JsonAt& node, const JsonAt& mesh, const Matrix& world) {
    Pose pose;
    const auto weights = node.has("weights") ? node.find("weights") : mesh.find("weights");
    if (weights) pose.weights = weights->json().get<std::vector<double>>();
    if (std::ranges::all_of(pose.weights, [](double w) { return w == 0; })) pose.weights.clear();
    if (const auto skin = node.find("skin")) {
        pose.skin = skin->json().get<int>();
        pose.is_mirrored = determinant_of(world) < 0;
    }
    return pose;
}

MorphedAttribute::MorphedAttribute(const JsonAt& primitive, const std::string& name, std::span<const double> weights,
                                   Accessors& accessors, Budget& budget)
    : base_{reader_of(primitive.member("attributes"), name, accessors)} {
    if (weights.empty()) return;
    std::size_t index = 0;
    for (const JsonAt& target : primitive.elements("targets")) {
        const double weight = weights[index++];
        if (weight == 0 || !target.has(name)) continue;
        targets_.push_back({reader_of(target, name, accessors), weight});
        budget.pay_elements(base_.count(), 0, target.location());
    }
}

std::array<float, 4> MorphedAttribute::element(std::size_t vertex) const {
    std::array<float, 4> value = base_.element(vertex);
    if (targets_.empty()) return value;
    std::array<double, 4> sum{value[0], value[1], value[2], value[3]};
    for (const Target& target : targets_) {
        const std::array<float, 4> delta = target.reader.element(vertex);
        for (std::size_t c = 0; c < target.reader.components(); ++c) sum[c] += target.weight * double{delta[c]};
    }
    std::ranges::transform(sum, value.begin(), [](double v) { return static_cast<float>(v); });
    return value;
}

std::span<const Matrix> Skins::joints(int skin) {
    const auto found = skins_.find(skin);
    return found != skins_.end() ? found->second
                                 : skins_.emplace(skin, read(static_cast<std::size_t>(skin))).first->second;
}

std::vector<Matrix> Skins::read(std::size_t skin) {
    if (worlds_.empty()) worlds_ = world_transforms(document_, model_);
    const JsonAt at = document_.at("skins", skin);
    const auto inverse_bind = at.find("inverseBindMatrices");
    const AccessorReader* reader = inverse_bind ? &accessors_[inverse_bind->json().get<int>()] : nullptr;
    budget_.pay_elements(at.size("joints"), sizeof(Matrix), at.location());
    std::vector<Matrix> joints;
    for (const JsonAt& joint : at.elements("joints")) {
        Matrix bind = pipeline::identity;
        for (std::size_t i = 0; reader != nullptr && i < 16; ++i)
            bind[i / 4][i % 4] = reader->component(joints.size(), i);
        bind[0][3] = bind[1][3] = bind[2][3] = 0, bind[3][3] = 1;  // 0 0 0 1 by 3.7.3.1, but for rounding
        joints.push_back(pipeline::product(worlds_[joint.json().get<std::size_t>()], bind));
        if (!std::ranges::all_of(entries_of(joints.back()), [](double v) { return std::isfinite(v); }))
            at.location().fail("ACCESSOR_INVALID_FLOAT", "finite joint matrices",
                               "NaN or infinity at joint " + std::to_string(joints.size() - 1));
    }
    return joints;
}

bool has_joints(const JsonAt& primitive) {
    const JsonAt attributes = primitive.member("attributes");
    return attributes.has("JOINTS_0") && attributes.has("WEIGHTS_0");
}

std::vector<Matrix> skin_matrices(const JsonAt& primitive, std::span<const Matrix> joints,
                                  std::span<const std::uint32_t> vertices, Accessors& accessors, Warnings& warnings) {
    std::vector<std::pair<const AccessorReader*, const AccessorReader*>> sets;  // joints and weights
    const JsonAt attributes = primitive.member("attributes");
    for (int n = 0; attributes.has("JOINTS_" + std::to_string(n)); ++n)
        if (attributes.has("WEIGHTS_" + std::to_string(n)))
            sets.emplace_back(&reader_of(attributes, "JOINTS_" + std::to_string(n), accessors),
                              &reader_of(attributes, "WEIGHTS_" + std::to_string(n), accessors));
    std::vector<Matrix> matrices;
    matrices.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) {
        JointSum blend;
        for (const auto& [joint_reader, weight_reader] : sets) {
            const std::array<float, 4> indices = joint_reader->element(vertex),
                                       weights = weight_reader->element(vertex);
            for (std::size_t c = 0; c < 4; ++c) {
                const double weight = joint_weight(weights[c], primitive, vertex);
                if (weight == 0) continue;
                const auto joint = static_cast<std::size_t>(indices[c]);
                if (joint >= joints.size())
                    primitive.location().fail("ACCESSOR_JOINTS_INDEX_OOB",
                                              "joints below " + std::to_string(joints.size()),
                                              std::to_string(joint) + " at vertex " + std::to_string(vertex));
                blend.add(joints[joint], weight);
            }
        }
        if (std::abs(blend.weights - 1) > 0.01)
            warnings.add(primitive.location().pointer,
                         "weights of joints do not add up to 1: they are divided by their sum");
        if (blend.weights == 0) blend.add(joints[0], 1);
        matrices.push_back(blend.mean());
    }
    return matrices;
}

Vec3 skinned_position(const Matrix& m, const Vec3& position) noexcept {
    const Vec3d p = wide(position);
    return rounded(
        plus(plus(plus(times(column(m, 0), p.x), times(column(m, 1), p.y)), times(column(m, 2), p.z)), column(m, 3)));
}

// The matrix of cofactors is the inverse transpose times the determinant.
Vec3 skinned_normal(const Matrix& m, const Vec3& normal) noexcept {
    const Vec3d n = wide(normal), x = column(m, 0), y = column(m, 1), z = column(m, 2);
    const Vec3d turned =
        plus(plus(times(cross_product(y, z), n.x), times(cross_product(z, x), n.y)), times(cross_product(x, y), n.z));
    const double length = std::sqrt(dot_product(turned, turned));
    if (!(length > 0) || !std::isfinite(length)) return normal;
    return rounded(divided(turned, determinant_of(m) < 0 ? -length : length));
}

}  // namespace strata::scenes
