// Tests poses (morph targets, skins, hidden nodes) on 240 generated files: every corner of every triangle, point and
// line is compared with its place as computed here from the description, point by point and without matrices.
#include <catch2/catch.hpp>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
using strata::scenes::Scene;
using Point = std::array<long double, 3>;

Point scaled(const Point& p, long double f) { return {p[0] * f, p[1] * f, p[2] * f}; }
Point sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Numbers that are exact in binary32 and in decimal.
class Numbers {
  public:
    explicit Numbers(std::uint32_t seed) : state_{seed * 2654435761u + 12345u} {}
    double next(int low, int high) {
        state_ = state_ * 1664525u + 1013904223u;
        return (low * 64 + static_cast<int>(state_ >> 8) % ((high - low) * 64 + 1)) / 64.0;
    }

  private:
    std::uint32_t state_;
};

// A node that turns by `angle` round an axis of the frame, scales and moves; parent -1: a root.
struct TestNode {
    int parent = -1;
    Point translation{}, scale{1, 1, 1};
    int axis = 0;
    double angle = 0;
    bool is_hidden = false;

    [[nodiscard]] Point unit() const {
        Point u{};
        u[static_cast<std::size_t>(axis)] = 1;
        return u;
    }
    // The rotation by Rodrigues' formula.
    [[nodiscard]] Point turned(const Point& p) const {
        const Point u = unit();
        const long double along = p[static_cast<std::size_t>(axis)], c = std::cos(static_cast<long double>(angle)),
                          s = std::sin(static_cast<long double>(angle));
        return sum(sum(scaled(p, c), scaled(cross(u, p), s)), scaled(u, along * (1 - c)));
    }
    [[nodiscard]] Point placed(const Point& p) const {
        return sum(turned({p[0] * scale[0], p[1] * scale[1], p[2] * scale[2]}), translation);
    }
    [[nodiscard]] Json json() const {
        Json rotation{0.0, 0.0, 0.0, std::cos(angle / 2)};
        rotation[static_cast<std::size_t>(axis)] = std::sin(angle / 2);
        Json node{{"rotation", rotation}};
        for (std::size_t i = 0; i < 3; ++i) {
            node["translation"].push_back(static_cast<double>(translation[i]));
            node["scale"].push_back(static_cast<double>(scale[i]));
        }
        if (is_hidden) node["extensions"]["KHR_node_visibility"]["visible"] = false;
        return node;
    }
};

enum class Morph { none, of_mesh, of_node, of_both };
enum class SkinKind { none, one_joint, two_joints, two_sets };
enum class Hidden { nothing, node, parent };

constexpr int corners = 6;  // two triangles

// A file and what it means. Nodes: 0 the parent of 1, the mesh; 2 to 6 joints, each below the previous one; 7 a root
// outside the scene, whose mesh is not shown.
struct Described {
    std::vector<TestNode> nodes{8};
    std::vector<Point> positions;
    std::vector<std::vector<Point>> targets;
    std::vector<double> mesh_weights, node_weights;
    std::vector<Point> binds;                    // translations of the inverse bind matrices
    std::vector<std::array<double, 8>> weights;  // of each corner, for joints 2, 3, 4, 5, 6, 6, 6, 6
    std::size_t joint_count = 0;

    [[nodiscard]] Point world(int node, Point p) const {
        for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent)
            p = nodes[static_cast<std::size_t>(node)].placed(p);
        return p;
    }
    [[nodiscard]] Point place(std::size_t corner) const {
        Point p = positions[corner];
        const std::vector<double>& w = node_weights.empty() ? mesh_weights : node_weights;
        for (std::size_t t = 0; t < w.size(); ++t) p = sum(p, scaled(targets[t][corner], w[t]));
        if (joint_count == 0) return world(1, p);
        Point skinned{};
        for (std::size_t j = 0; j < 8; ++j) {
            const std::size_t joint = std::min(j, joint_count - 1);
            skinned =
                sum(skinned, scaled(world(static_cast<int>(joint) + 2, sum(p, binds[joint])), weights[corner][j]));
        }
        return skinned;
    }
};

Described described(Morph morph, SkinKind skin, Hidden hidden, std::uint32_t seed) {
    Numbers numbers{seed};
    const auto point = [&](int size) {
        return Point{numbers.next(-size, size), numbers.next(-size, size), numbers.next(-size, size)};
    };
    Described d;
    for (std::size_t i = 0; i < d.nodes.size(); ++i)
        d.nodes[i] = {.parent = i == 1           ? 0
                                : i > 2 && i < 7 ? static_cast<int>(i) - 1
                                                 : -1,
                      .translation = point(4),
                      .scale = {numbers.next(1, 2), numbers.next(1, 2), (seed + i) % 3 == 0 ? -1.5 : 1.5},
                      .axis = static_cast<int>((i + seed) % 3),
                      .angle = numbers.next(-3, 3)};
    d.nodes[1].is_hidden = hidden == Hidden::node;
    d.nodes[0].is_hidden = hidden == Hidden::parent;
    for (int i = 0; i < corners; ++i) d.positions.push_back(point(2));
    for (int t = 0; t < 3; ++t) {
        d.targets.emplace_back();
        for (int i = 0; i < corners; ++i) d.targets.back().push_back(point(1));
    }
    if (morph == Morph::of_mesh || morph == Morph::of_both) d.mesh_weights = {0.5, 0, 1.25};
    if (morph == Morph::of_node || morph == Morph::of_both) d.node_weights = {-0.75, 1, 0};
    d.joint_count = std::array<std::size_t, 4>{0, 1, 2, 5}[static_cast<std::size_t>(skin)];
    for (std::size_t j = 0; j < d.joint_count; ++j) d.binds.push_back(point(2));
    for (int i = 0; i < corners; ++i) {
        std::array<double, 8> w{1};
        // In 255ths, so that normalised bytes hold them.
        if (skin == SkinKind::two_joints) w = {(51.0 + 17 * i) / 255, (204.0 - 17 * i) / 255};
        if (skin == SkinKind::two_sets) w = {0.2, 0.2, 0.2, 0.2, 0.2};
        d.weights.push_back(w);
    }
    return d;
}

std::vector<float> flattened(const std::vector<Point>& points) {
    std::vector<float> values;
    for (const Point& p : points)
        for (const long double c : p) values.push_back(static_cast<float>(c));
    return values;
}

int add_targets_of(GltfFile& file, const std::vector<Point>& target, bool is_sparse) {
    if (!is_sparse) return file.positions(flattened(target));
    // An accessor without a view, whose values are all sparse, as exporters write small targets.
    const int indices = file.view(std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5}), values = file.view(flattened(target));
    return file.add("accessors", {{"componentType", f32},
                                  {"count", corners},
                                  {"type", "VEC3"},
                                  {"sparse",
                                   {{"count", corners},
                                    {"indices", {{"bufferView", indices}, {"componentType", u8}}},
                                    {"values", {{"bufferView", values}}}}}});
}

// JOINTS_n and WEIGHTS_n: floats, normalised bytes where they hold the weights.
void add_joints(GltfFile& file, const Described& d, Json& attributes) {
    for (std::size_t set = 0; set < (d.joint_count > 4 ? 2 : 1); ++set) {
        std::vector<std::uint16_t> joints;
        std::vector<float> weights;
        std::vector<std::uint8_t> bytes;
        for (const auto& w : d.weights)
            for (std::size_t c = 4 * set; c < 4 * set + 4; ++c) {
                joints.push_back(static_cast<std::uint16_t>(std::min(c, d.joint_count - 1)));
                weights.push_back(static_cast<float>(w[c]));
                bytes.push_back(static_cast<std::uint8_t>(std::lround(w[c] * 255)));
            }
        const std::string n = std::to_string(set);
        attributes["JOINTS_" + n] = file.accessor("VEC4", u16, corners, joints);
        attributes["WEIGHTS_" + n] = d.joint_count == 2
                                         ? file.accessor("VEC4", u8, corners, bytes, {{"normalized", true}})
                                         : file.accessor("VEC4", f32, corners, weights);
    }
}

GltfFile written(const Described& d, bool has_targets, bool is_sparse, int mode = 4) {
    GltfFile file;
    Json primitive{{"attributes", {{"POSITION", file.positions(flattened(d.positions))}}}, {"mode", mode}};
    if (d.joint_count > 0) add_joints(file, d, primitive["attributes"]);
    for (std::size_t t = 0; has_targets && t < d.targets.size(); ++t)
        primitive["targets"].push_back({{"POSITION", add_targets_of(file, d.targets[t], is_sparse)}});
    Json mesh{{"primitives", Json::array({primitive})}};
    if (!d.mesh_weights.empty()) mesh["weights"] = d.mesh_weights;
    file.add("meshes", mesh);
    for (const TestNode& node : d.nodes) file.add("nodes", node.json());
    for (std::size_t i = 0; i < d.nodes.size(); ++i)
        if (const int parent = d.nodes[i].parent; parent >= 0)
            file.json["nodes"][static_cast<std::size_t>(parent)]["children"].push_back(i);
    Json& shown = file.json["nodes"][1];
    shown["mesh"] = file.json["nodes"][7]["mesh"] = 0;
    if (!d.node_weights.empty()) shown["weights"] = d.node_weights;
    if (d.joint_count > 0) {
        std::vector<float> binds;
        for (const Point& b : d.binds) {
            std::vector<float> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
            for (const long double c : b) m.push_back(static_cast<float>(c));
            m.push_back(1);
            binds.insert(binds.end(), m.begin(), m.end());
        }
        Json joints = Json::array();
        for (std::size_t j = 0; j < d.joint_count; ++j) joints.push_back(j + 2);
        file.add("skins",
                 {{"joints", joints}, {"inverseBindMatrices", file.accessor("MAT4", f32, d.joint_count, binds)}});
        shown["skin"] = 0;
    }
    file.json["scenes"] = Json::array({{{"nodes", {0, 2}}}});
    file.json["extensionsUsed"] = {"KHR_node_visibility"};
    file.json["extensionsRequired"] = {"KHR_node_visibility"};
    return file;
}

// The corners of triangles (mode 4) in the order of the list, or of points, lines, a loop or a strip (0 to 3): a point
// three times, the first end of a line twice. Exchanged are 1 and 2 of every triangle.
std::vector<std::size_t> corners_of_mode(int mode, bool is_exchanged) {
    std::vector<std::size_t> all;
    const std::size_t step = mode == 1 ? 2 : 1, end = mode == 0 || mode == 2 ? corners : corners - 1;
    for (std::size_t i = 0; mode < 4 && i < end; i += step)
        all.insert(all.end(), {i, i, mode == 0 ? i : (i + 1) % corners});
    for (std::size_t i = 0; mode == 4 && i < corners; ++i)
        all.push_back(is_exchanged && i % 3 != 0 ? i / 3 * 3 + 3 - i % 3 : i);
    return all;
}

// The corners of all primitives in world space.
std::vector<Point> places_of(const Scene& scene) {
    std::vector<Point> places;
    for (const auto& instance : scene.list.instances) {
        const auto& mesh = scene.list.meshes[instance.mesh];
        for (const std::uint32_t index : mesh.indices) {
            const auto& p = mesh.positions[index];
            Point place{};
            for (std::size_t r = 0; r < 3; ++r)
                place[r] = instance.model[0][r] * p.x + instance.model[1][r] * p.y + instance.model[2][r] * p.z +
                           instance.model[3][r];
            places.push_back(place);
        }
    }
    return places;
}

void check_place(const Point& found, const Point& expected) {
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(static_cast<double>(found[i]) == Approx(static_cast<double>(expected[i])).margin(2e-5).epsilon(1e-6));
}

// A triangle whose one joint, node 1, has this transform.
GltfFile one_joint(const Json& node, Json primitive_more = Json::object()) {
    GltfFile file;
    Json primitive{
        {"attributes",
         {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})},
          {"NORMAL", file.positions({0, 0, 1, 0, 0, 1, 0.6f, 0, 0.8f})},
          {"JOINTS_0", file.accessor("VEC4", u8, 3, std::vector<std::uint8_t>(12, 0))},
          {"WEIGHTS_0", file.accessor("VEC4", f32, 3, std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0})}}}};
    primitive.update(primitive_more);
    file.show(primitive);
    file.json["nodes"][0]["skin"] = 0;
    file.show_node(node);
    file.add("skins", {{"joints", {1}}});
    return file;
}

}  // namespace

TEST_CASE("240 files of five modes with morph targets and skins and hidden nodes have every corner where computed") {
    std::uint32_t seed = 0;
    for (const int mode : {4, 0, 1, 2, 3})
        for (const Morph morph : {Morph::none, Morph::of_mesh, Morph::of_node, Morph::of_both})
            for (const SkinKind skin : {SkinKind::none, SkinKind::one_joint, SkinKind::two_joints, SkinKind::two_sets})
                for (const Hidden hidden : {Hidden::nothing, Hidden::node, Hidden::parent}) {
                    const Described d = described(morph, skin, hidden, ++seed);
                    const Scene scene = written(d, morph != Morph::none || seed % 2 == 0, seed % 3 == 0, mode).load();
                    INFO("file " << seed);
                    const std::vector<Point> places = places_of(scene);
                    if (hidden != Hidden::nothing) {
                        CHECK(places.empty());
                        CHECK(scene.warnings.size() == 1);
                        continue;
                    }
                    CHECK(scene.warnings.empty());
                    // A skin below a mirroring node.
                    const bool is_exchanged = skin != SkinKind::none && d.nodes[0].scale[2] * d.nodes[1].scale[2] < 0;
                    const auto expected = corners_of_mode(mode, is_exchanged);
                    REQUIRE(places.size() == expected.size());
                    for (std::size_t i = 0; i < expected.size(); ++i) check_place(places[i], d.place(expected[i]));
                }
    CHECK(seed == 240);
}

TEST_CASE("a mesh is stored once for each pose and a node without weights shows the mesh's") {
    Described d = described(Morph::of_mesh, SkinKind::none, Hidden::nothing, 7);
    GltfFile file = written(d, true, false);
    file.json["scenes"][0]["nodes"] = {0, 2, 7};
    CHECK(file.load().list.meshes.size() == 1);
    file.json["nodes"][7]["weights"] = {0, 0, 0};
    const Scene scene = file.load();
    REQUIRE(scene.list.meshes.size() == 2);
    CHECK(scene.list.meshes[1].positions[0].x == static_cast<float>(d.positions[0][0]));
}

TEST_CASE("morph targets change normals and colours and texture coordinates too") {
    GltfFile file;
    const int up = file.positions({0, 0, 1, 0, 0, 1, 0, 0, 1}), turn = file.positions({1, 0, -1, 1, 0, -1, 1, 0, -1});
    const int uv = file.accessor<float>("VEC2", f32, 3, {0, 0, 1, 0, 0, 1}),
              shift = file.accessor<float>("VEC2", f32, 3, std::vector<float>(6, 0.5f));
    const int grey = file.positions(std::vector<float>(9, 0.25f));
    file.add("images", {{"uri", data_uri(png(1, 1, 8, 4, {10, 20, 30, 40}), "image/png")}});
    file.add("textures", {{"source", 0}});
    file.add("materials", {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    file.show({{"attributes",
                {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})},
                 {"NORMAL", up},
                 {"COLOR_0", grey},
                 {"TEXCOORD_0", uv}}},
               {"material", 0},
               {"targets", Json::array({{{"NORMAL", turn}, {"COLOR_0", grey}, {"TEXCOORD_0", shift}}})}});
    file.json["meshes"][0]["weights"] = {1};
    const auto mesh = file.load({.color_space = strata::pipeline::ColorSpace::linear}).list.meshes.at(0);
    for (const auto& n : mesh.normals) CHECK((n.x == 1 && n.y == 0 && n.z == 0));
    for (const auto& c : mesh.colors) CHECK((c[0] == 0.5f && c[3] == 1));
    CHECK((mesh.texcoords[1][0] == 1.5f && mesh.texcoords[1][1] == 0.5f));
}

TEST_CASE("a skin's normals stay perpendicular under a scale that is not uniform") {
    const auto mesh = one_joint({{"scale", {1, 1, 2}}}).load().list.meshes.at(0);
    CHECK(mesh.normals[0].z == Approx(1));
    // (0.6, 0, 0.8) divided by the scale: (0.6, 0, 0.4), of length sqrt 0.52.
    CHECK(mesh.normals[2].x == Approx(0.6 / std::sqrt(0.52)));
    CHECK(mesh.normals[2].z == Approx(0.4 / std::sqrt(0.52)));
}

TEST_CASE("a skin without matrices binds at the origin and its normals follow a mirror") {
    const auto mesh = one_joint({{"translation", {5, 0, 0}}, {"scale", {1, 1, -1}}}).load().list.meshes.at(0);
    CHECK(mesh.positions[1].x == 6);
    CHECK(mesh.normals[0].z == -1);
}

TEST_CASE("faults of skins and morph targets are refused with the validator's code") {
    const auto says = [](const std::string& code, const GltfFile& file) {
        const std::string found = refusal(file.as_glb());
        INFO(found);
        CHECK(found.find(code) != std::string::npos);
    };
    GltfFile file = one_joint(Json::object());
    CHECK(refusal(file.as_glb()).empty());
    file.json["skins"][0]["joints"] = {9};
    says("UNRESOLVED_REFERENCE", file);
    file.json["skins"][0]["joints"] = {1, 1};
    says("DUPLICATE_ELEMENTS", file);
    file.json["skins"][0]["joints"] = Json::array();
    says("EMPTY_ENTITY", file);
    file.json["skins"][0] = {{"joints", {1}}, {"inverseBindMatrices", 0}};
    says("SKIN_IBM_INVALID_FORMAT", file);
    file = one_joint(Json::object());
    file.json["nodes"][0]["skin"] = 3;
    says("UNRESOLVED_REFERENCE", file);
    file = one_joint(Json::object());
    file.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
        file.accessor("VEC4", u8, 3, std::vector<std::uint8_t>(12, 1));
    says("ACCESSOR_JOINTS_INDEX_OOB", file);
    file = one_joint(Json::object());
    file.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
        file.accessor("VEC4", f32, 3, std::vector<float>(12, -1));
    says("ACCESSOR_WEIGHTS_NEGATIVE", file);
    file = one_joint(Json::object(), {{"targets", Json::array({{{"TEXCOORD_0", 0}}})}});
    says("MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", file);
    file = one_joint(Json::object(), {{"targets", Json::array({{{"POSITION", 0}}})}});
    CHECK(refusal(file.as_glb()).empty());
    file.json["meshes"][0]["weights"] = {1, 1};
    says("/meshes/0/weights", file);
    file.json["meshes"][0].erase("weights");
    file.json["nodes"][0]["weights"] = {1, 1};
    says("/nodes/0/weights", file);
    file.json["nodes"][0].erase("weights");
    file.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = 1;
    says("/nodes/0/extensions/KHR_node_visibility/visible", file);
}

TEST_CASE("a skin that moves nothing and weights that do not add up are said") {
    GltfFile file = one_joint({{"translation", {5, 0, 0}}});
    file.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
        file.accessor("VEC4", f32, 3, std::vector<float>{2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
    const Scene scene = file.load();
    CHECK(scene.list.meshes[0].positions[0].x == 5);
    CHECK(scene.list.meshes[0].positions[1].x == 6);
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0] ==
          "/meshes/0/primitives/0 (and 1 more): weights of joints do not add up to 1: they are divided by their sum");
    file.json["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    CHECK(file.load().list.meshes[0].positions[0].x == 0);
    CHECK(file.load().warnings.at(0) ==
          "/meshes/0/primitives/0: a skin moves nothing of it: it has no JOINTS_0 and WEIGHTS_0");
}
