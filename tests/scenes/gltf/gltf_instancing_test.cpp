// Tests EXT_mesh_gpu_instancing against transforms worked out by hand, and against nodes with the same translation,
// rotation and scale.
#include <catch2/catch.hpp>

#include "tests/scenes/gltf/gltf_file.h"

using namespace strata::scenes::test;
using strata::pipeline::Matrix;

namespace {

const double sqrt_half = 0.7071067811865476;  // sine and cosine of half a right angle

// One node with a triangle, repeated by these attributes.
GltfFile instanced(GltfFile file, const Json& attributes, const Json& node = Json::object()) {
    const int mesh = file.add(
        "meshes",
        {{"primitives", Json::array({{{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}})}});
    Json shown = node;
    shown["mesh"] = mesh;
    shown["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    file.show_node(shown);
    file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    return file;
}

// The world matrix of a node with these properties, below a parent moved by (0, 0, 7).
Matrix of_node(const Json& node) {
    GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    file.json["nodes"][0].update(node);
    file.add("nodes", {{"children", {0}}, {"translation", {0, 0, 7}}});
    file.json["scenes"][0]["nodes"] = {1};
    return file.load().list.instances.at(0).model;
}

}  // namespace

TEST_CASE("a mesh is drawn at each instance's translation and rotation and scale below the node's own transform") {
    GltfFile file;
    const int moved = file.accessor("VEC3", f32, 2, std::vector<float>{1, 2, 3, -4, 5, 6});
    const int turned = file.accessor(
        "VEC4", f32, 2,
        std::vector<float>{0, 0, 0, 1, 0, 0, static_cast<float>(sqrt_half), static_cast<float>(sqrt_half)});
    const int scaled = file.accessor("VEC3", f32, 2, std::vector<float>{2, 2, 2, 1, -1, 1});
    const auto scene =
        instanced(file, {{"TRANSLATION", moved}, {"ROTATION", turned}, {"SCALE", scaled}, {"_ID", moved}},
                  {{"translation", {0, 0, 7}}})
            .load();
    CHECK(scene.warnings.empty());
    REQUIRE(scene.list.instances.size() == 2);
    CHECK(scene.list.meshes.size() == 1);
    CHECK(scene.list.instances[0].model == of_node({{"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}}));
    const double h = double{static_cast<float>(sqrt_half)};
    CHECK(scene.list.instances[1].model ==
          of_node({{"translation", {-4, 5, 6}}, {"rotation", {0, 0, h, h}}, {"scale", {1, -1, 1}}}));
    CHECK(scene.bounds.lo[2] == 10);
    CHECK(scene.bounds.hi[2] == 13);
}

TEST_CASE("attributes missing in an instancing are the identity's and rotations may be normalised integers") {
    GltfFile file;
    const int turned = file.accessor("VEC4", i16, 1, std::vector<std::int16_t>{0, 0, 0, 32767}, {{"normalized", true}});
    const auto scene = instanced(file, {{"ROTATION", turned}}).load();
    REQUIRE(scene.list.instances.size() == 1);
    CHECK(scene.list.instances[0].model == strata::pipeline::identity);
}

TEST_CASE("an instancing with inconsistent accessors is rejected with its JSON pointer") {
    const auto says = [](const std::string& words, const std::string& type, Component component, std::size_t count,
                         const char* name) {
        GltfFile file;
        const int moved = file.accessor("VEC3", f32, 2, std::vector<float>(6, 1.0f));
        const int other = file.accessor(type.c_str(), component, count, std::vector<float>(4 * count, 1.0f));
        const GltfFile whole = instanced(file, {{"TRANSLATION", moved}, {name, other}});
        INFO(refusal(whole.as_glb()));
        CHECK(refusal(whole.as_glb()).find(words) != std::string::npos);
    };
    says("/attributes/SCALE: expected an accessor whose type and componentType SCALE allows", "VEC4", f32, 2, "SCALE");
    says("/attributes/ROTATION: expected an accessor whose type and componentType ROTATION allows", "VEC4", u8, 2,
         "ROTATION");
    says("/attributes/SCALE: expected as many elements as the other attributes: 2, found 3", "VEC3", f32, 3, "SCALE");
    GltfFile none;
    const int moved = none.accessor("VEC3", f32, 1, std::vector<float>{1, 2, 3});
    CHECK(refusal(instanced(none, {{"_ID", moved}}).as_glb()).find("expected TRANSLATION, ROTATION or SCALE") !=
          std::string::npos);
    GltfFile infinite;
    const int far = infinite.accessor("VEC3", f32, 1, std::vector<float>{1, 2, INFINITY});
    CHECK(refusal(instanced(infinite, {{"TRANSLATION", far}}).as_glb()).find("NaN or infinity at instance 0") !=
          std::string::npos);
    GltfFile missing;
    CHECK(refusal(instanced(missing, {{"TRANSLATION", 9}}).as_glb()).find("UNRESOLVED_REFERENCE") != std::string::npos);
}
