// scenes/gltf/check_nodes.cpp - checks cameras, skins, nodes and scenes, and that the nodes form a forest. See check.h.
#include <cmath>
#include <set>

#include "scenes/gltf/check.h"
#include "scenes/gltf/element.h"
#include "scenes/gltf/instancing.h"
#include "scenes/numbers/elementary.h"

namespace strata::scenes {
namespace {

// Not a valid node index: indices are below 2^31.
constexpr std::size_t no_parent = static_cast<std::size_t>(-1);

// Returns the number after checking that it is above 0.
double positive(const JsonAt& at) {
    if (!(at.number() > 0)) at.fail("VALUE_NOT_IN_RANGE", "a number above 0");
    return at.number();
}

// glTF 2.0, 3.10.3: yfov below pi, znear above 0, zfar, if present, greater than znear.
void check_perspective(const JsonAt& camera) {
    const JsonAt yfov = camera.member("yfov");
    if (positive(yfov) >= pi) yfov.fail("VALUE_NOT_IN_RANGE", "an angle below pi");
    const double near = positive(camera.member("znear"));
    if (const auto aspect = camera.find("aspectRatio")) (void)positive(*aspect);
    if (const auto far = camera.find("zfar"); far && positive(*far) <= near)
        far->fail("CAMERA_ZFAR_LEQUAL_ZNEAR", "more than znear");
}

// The projection divides by xmag, ymag and zfar - znear. Negative magnifications mirror and are allowed; znear
// may be 0.
void check_orthographic(const JsonAt& camera) {
    for (const char* key : {"xmag", "ymag"})
        if (const JsonAt mag = camera.member(key); mag.number() == 0)
            mag.fail("CAMERA_XMAG_YMAG_ZERO", "a number that is not 0");
    const JsonAt near = camera.member("znear"), far = camera.member("zfar");
    if (!(near.number() >= 0)) near.fail("VALUE_NOT_IN_RANGE", "a number not below 0");
    if (!(far.number() > near.number())) far.fail("CAMERA_ZFAR_LEQUAL_ZNEAR", "more than znear");
}

void check_rotation(const JsonAt& rotation) {
    rotation.numbers(4);
    double square = 0;
    for (const JsonAt& part : rotation.elements()) square += part.number() * part.number();
    constexpr double threshold = 0.00769;  // the validator's threshold: the accuracy of four signed normalised bytes
    if (!(std::abs(std::sqrt(square) - 1) <= threshold))
        rotation.fail("NODE_ROTATION_NON_UNIT", "a quaternion of length 1");
}

void check_transform(const JsonAt& node) {
    // Column-major: the elements 3, 7, 11 and 15 are the bottom row of an affine transform.
    if (const auto matrix = node.find("matrix")) {
        matrix->numbers(16);
        for (const char* key : {"translation", "rotation", "scale"})
            if (node.has(key))
                matrix->location().fail("NODE_MATRIX_TRS", "either matrix or translation, rotation and scale", "both");
        for (const int bottom : {3, 7, 11, 15})
            if (matrix->json()[bottom].get<double>() != (bottom == 15 ? 1.0 : 0.0))
                matrix->fail("NODE_MATRIX_NON_TRS", "0 0 0 1 as the bottom row");
    }
    if (const auto translation = node.find("translation")) translation->numbers(3);
    if (const auto scale = node.find("scale")) scale->numbers(3);
    if (const auto rotation = node.find("rotation")) check_rotation(*rotation);
}

// As many weights as the mesh has morph targets.
void check_weights(const JsonAt& node, const JsonAt& weights, const JsonAt& root) {
    const auto mesh = node.find("mesh");
    if (!mesh) weights.location().fail("UNSATISFIED_DEPENDENCY", "a mesh next to weights", "none");
    const std::vector<JsonAt> primitives =
        root.elements("meshes").at(mesh->index(root.size("meshes"))).elements("primitives");
    weights.numbers(primitives.empty() ? 0 : primitives[0].size("targets"));
}

// Each child is listed once and has one parent.
void check_children(const JsonAt& node, std::size_t index, std::vector<std::size_t>& parents) {
    for (const JsonAt& child_at : node.elements("children")) {
        const std::size_t child = child_at.index(parents.size());
        if (parents[child] == index) child_at.fail("DUPLICATE_ELEMENTS", "each child once");
        if (parents[child] != no_parent) child_at.fail("NODE_PARENT_OVERRIDE", "a node without a parent");
        parents[child] = index;
    }
}

// With at most one parent each, the nodes that no root reaches form loops.
void check_loops(const JsonAt& root, const std::vector<std::size_t>& parents) {
    enum : char { unknown, on_the_way, rooted };
    std::vector<char> known(parents.size(), unknown);
    for (std::size_t start = 0; start < parents.size(); ++start) {
        std::size_t node = start;
        // Walks up to a root, a known node, or a node of this walk; the last case is a loop.
        for (; node != no_parent && known[node] == unknown; node = parents[node]) known[node] = on_the_way;
        if (node != no_parent && known[node] == on_the_way)
            root.location().under("nodes").under(node).fail("NODE_LOOP", "a tree of nodes",
                                                            "a node that is its own ancestor");
        // A second walk marks the path as known, so that every node is visited at most twice.
        for (node = start; node != no_parent && known[node] == on_the_way; node = parents[node]) known[node] = rooted;
    }
}

// A scene lists roots, each once; otherwise a node could be drawn twice.
void check_scenes(const JsonAt& root, const std::vector<std::size_t>& parents, Faults& faults) {
    faults.collect_each(root, "scenes", [&](const JsonAt& scene) {
        std::set<std::size_t> seen;
        for (const JsonAt& node : scene.elements("nodes")) {
            const std::size_t index = node.index(parents.size());
            if (parents[index] != no_parent) node.fail("SCENE_NON_ROOT_NODE", "a node without a parent");
            if (!seen.insert(index).second) node.fail("DUPLICATE_ELEMENTS", "each node once");
        }
    });
    faults.collect([&] { check_reference(root, "scene", root, "scenes"); });
}

// glTF 2.0, 3.7.3: joints are nodes, each once; a matrix for each of them, if there are matrices.
void check_skin(const JsonAt& skin, const JsonAt& root) {
    std::set<std::size_t> seen;
    (void)skin.member("joints");
    for (const JsonAt& joint : skin.elements("joints"))
        if (!seen.insert(joint.index(root.size("nodes"))).second) joint.fail("DUPLICATE_ELEMENTS", "each joint once");
    if (seen.empty()) skin.member("joints").fail("EMPTY_ENTITY", "at least one joint");
    const auto matrices = skin.find("inverseBindMatrices");
    if (!matrices) return;
    const Json& accessor = root.json()["accessors"][matrices->index(root.size("accessors"))];
    if (accessor["type"] != "MAT4" || accessor["componentType"] != static_cast<int>(ComponentType::f32))
        matrices->fail("SKIN_IBM_INVALID_FORMAT", "an accessor of MAT4 in binary32");
    if (accessor["count"].get<std::uint64_t>() < seen.size())
        matrices->location().fail("INVALID_IBM_ACCESSOR_COUNT",
                                  "a matrix for each of " + std::to_string(seen.size()) + " joints",
                                  std::to_string(accessor["count"].get<std::uint64_t>()));
}

}  // namespace

void check_skins(const JsonAt& root, Faults& faults) {
    faults.collect_each(root, "skins", [&](const JsonAt& skin) { check_skin(skin, root); });
}

void check_cameras(const JsonAt& root, Faults& faults) {
    faults.collect_each(root, "cameras", [](const JsonAt& camera) {
        const JsonAt type = camera.member("type");
        if (type.string() == "perspective")
            check_perspective(camera.member("perspective"));
        else if (type.string() == "orthographic")
            check_orthographic(camera.member("orthographic"));
        else
            type.fail("VALUE_NOT_IN_LIST", "perspective or orthographic");
    });
}

void check_nodes(const JsonAt& root, Warnings& warnings, Faults& faults) {
    std::vector<std::size_t> parents;
    faults.collect([&] { parents.assign(root.size("nodes"), no_parent); });
    std::size_t next = 0;
    faults.collect_each(root, "nodes", [&](const JsonAt& node) {
        const std::size_t index = next++;
        check_transform(node);
        check_reference(node, "mesh", root, "meshes");
        check_reference(node, "camera", root, "cameras");
        check_reference(node, "skin", root, "skins");
        if (const auto instancing = instancing_of(node)) check_instancing(*instancing, root);
        if (const auto weights = node.find("weights")) check_weights(node, *weights, root);
        const auto visible = visibility_of(node);
        if (visible && !visible->boolean())
            warnings.add(visible->location().pointer, "hidden by the file (KHR_node_visibility): it is not drawn");
        check_children(node, index, parents);
    });
    faults.collect([&] { check_loops(root, parents); });
    check_scenes(root, parents, faults);
}

}  // namespace strata::scenes
