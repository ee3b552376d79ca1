// scenes/gltf/nodes.cpp - transforms of nodes, and the views of cameras (nodes.h).
#include "scenes/gltf/nodes.h"

#include <algorithm>
#include <cmath>

#include "pipeline/vertices/matrix.h"
#include "rasterizer/base/vector_arithmetic.h"

namespace strata::scenes {
namespace {

using pipeline::Matrix;

// The vector divided by its length; InputError if that is 0 or not finite.
Vec3d unit(const Vec3d& v, const FileLocation& location) {
    const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    const Vec3d scaled = divided(v, largest);  // so that no square overflows or underflows
    const double length = std::sqrt(dot_product(scaled, scaled));
    if (!(largest > 0) || !std::isfinite(length))
        location.fail("VALUE_NOT_IN_RANGE", "a camera transform with three axes of finite length above 0",
                      "an axis of length 0 or infinity");
    return divided(scaled, length);
}

template <std::size_t n>
std::array<double, n> values_or(const std::vector<double>& given, const std::array<double, n>& otherwise) {
    std::array<double, n> values = otherwise;
    if (given.size() == n) std::copy(given.begin(), given.end(), values.begin());
    return values;
}

}  // namespace

// The quaternion x y z w as stored: the check allows a small deviation from unit length.
Matrix transform_of(const std::array<double, 3>& t, const std::array<double, 4>& q,
                    const std::array<double, 3>& s) noexcept {
    const auto [x, y, z, w] = q;
    const Vec3d c0{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
    const Vec3d c1{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
    const Vec3d c2{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    return {c0[0] * s[0], c0[1] * s[0], c0[2] * s[0], 0, c1[0] * s[1], c1[1] * s[1], c1[2] * s[1], 0,
            c2[0] * s[2], c2[1] * s[2], c2[2] * s[2], 0, t[0],         t[1],         t[2],         1};
}

// A node has either a matrix or TRS properties (check_nodes.cpp); absent ones are the identity's.
Matrix local_transform(const tinygltf::Node& node) noexcept {
    if (node.matrix.size() == 16) return matrix_of(values_or<16>(node.matrix, {}));
    return transform_of(values_or<3>(node.translation, {0, 0, 0}), values_or<4>(node.rotation, {0, 0, 0, 1}),
                        values_or<3>(node.scale, {1, 1, 1}));
}

std::optional<JsonAt> visibility_of(const JsonAt& node) {
    const auto extensions = node.find("extensions");
    const auto visibility = extensions ? extensions->find("KHR_node_visibility") : std::nullopt;
    return visibility ? visibility->find("visible") : std::nullopt;
}

std::vector<int> root_nodes(const tinygltf::Model& model) {
    std::vector<char> is_child(model.nodes.size(), 0);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = 1;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (is_child[i] == 0) roots.push_back(static_cast<int>(i));
    return roots;
}

std::vector<Matrix> world_transforms(const Document& document, const tinygltf::Model& model) {
    std::vector<Matrix> worlds(model.nodes.size());
    for (const PlacedNode& placed : place_nodes(document, model, root_nodes(model)))
        worlds[static_cast<std::size_t>(placed.node)] = placed.world;
    return worlds;
}

std::vector<PlacedNode> place_nodes(const Document& document, const tinygltf::Model& model,
                                    std::span<const int> roots) {
    std::vector<PlacedNode> placed, waiting;
    // A stack returns the last element first, so roots and children are pushed in reverse to come out in the file's
    // order.
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) waiting.push_back({.node = *root});
    while (!waiting.empty()) {
        PlacedNode next = waiting.back();  // `world` and `is_hidden` are still the parent's
        waiting.pop_back();
        const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(next.node)];
        next.world = pipeline::product(next.world, local_transform(node));
        if (!std::ranges::all_of(entries_of(next.world), [](double v) { return std::isfinite(v); }))
            FileLocation{document.file, "/nodes/" + std::to_string(next.node)}.fail(
                "VALUE_NOT_IN_RANGE", "a finite world transform", "an overflow");
        const auto visible = visibility_of(document.at("nodes", static_cast<std::size_t>(next.node)));
        next.is_hidden |= visible && !visible->boolean();
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            waiting.push_back({*child, next.world, next.is_hidden});
        placed.push_back(next);
    }
    return placed;
}

// The camera's axes made orthonormal: z is kept, x is made perpendicular to it, y completes a right-handed frame, which
// drops scale, shear and mirroring. The inverse of such a frame is its transpose and the rotated, negated eye.
Matrix view_of(const Matrix& world, const FileLocation& location) {
    const Vec3d z = unit(column(world, 2), location);
    const Vec3d right = unit(column(world, 0), location);
    const double along = dot_product(right, z);
    const Vec3d x = unit(minus(right, times(z, along)), location);
    const Vec3d y = cross_product(z, x), eye = column(world, 3);
    return {x[0],
            y[0],
            z[0],
            0,
            x[1],
            y[1],
            z[1],
            0,
            x[2],
            y[2],
            z[2],
            0,
            -dot_product(x, eye),
            -dot_product(y, eye),
            -dot_product(z, eye),
            1};
}

}  // namespace strata::scenes
