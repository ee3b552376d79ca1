// Tests glTF materials against glTF 2.0, 3.8 and 3.9, IEC 61966-2-1 with numbers worked out by hand, and the worked
// example of KHR_texture_transform.
#include <catch2/catch.hpp>

#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
using strata::pipeline::AlphaMode;
using strata::pipeline::ColorSpace;
using strata::pipeline::Rgba;
using strata::pipeline::TextureFilter;
using strata::pipeline::TextureWrap;
using strata::pipeline::Vec2;

constexpr const char* base_texture = "/materials/0/pbrMetallicRoughness/baseColorTexture";

std::vector<Vec2> texcoords_with(const Json& transform) {
    GltfFile file = everything();
    file.json[Json::json_pointer(base_texture)]["extensions"]["KHR_texture_transform"] = transform;
    return file.load().list.meshes.at(0).texcoords;
}

void check_near(const std::vector<Vec2>& found, const std::vector<Vec2>& expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t c = 0; c < 2; ++c) CHECK(found[i][c] == Approx(expected[i][c]).margin(1e-7));
}

}  // namespace

TEST_CASE("a linear base colour factor is encoded once for an encoded frame and alpha never is") {
    GltfFile file = everything();
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.2140411404715882, 0, 0.5};
    const Rgba encoded = file.load().list.materials.at(0).front;
    CHECK(encoded[0] == Approx(0.7353569830524495).margin(1e-7));
    CHECK(encoded[1] == Approx(0.5).margin(1e-6));
    CHECK(encoded[2] == 0);
    CHECK(encoded[3] == 0.5f);
    const auto linear = file.load({.color_space = ColorSpace::linear});
    CHECK(linear.list.materials.at(0).front == Rgba{0.5f, 0.2140411404715882f, 0, 0.5f});
    CHECK(linear.list.materials[0].front == linear.list.materials[0].back);
    CHECK(linear.list.textures.at(0).decode_srgb);
    CHECK_FALSE(file.load().list.textures.at(0).decode_srgb);
    CHECK(file.load().list.textures[0].texels == linear.list.textures[0].texels);
}

TEST_CASE("alpha mode and cutoff and sidedness are the material's and opaque means alpha 1 everywhere") {
    GltfFile file = everything();
    Json& material = file.json["materials"][0];
    const auto loaded = [&] { return file.load().list; };
    CHECK(loaded().materials.at(0).alpha_mode == AlphaMode::blend);
    CHECK(loaded().textures.at(0).texels == std::vector<std::uint8_t>{10, 20, 30, 40});
    material["alphaMode"] = "MASK";
    CHECK(loaded().materials.at(0).alpha_mode == AlphaMode::mask);
    CHECK(loaded().materials.at(0).alpha_cutoff == 0.5f);
    material["alphaCutoff"] = 0.3;
    material["doubleSided"] = true;
    CHECK(loaded().materials.at(0).alpha_cutoff == 0.3f);
    CHECK(loaded().materials.at(0).double_sided);
    material["alphaMode"] = "OPAQUE";
    CHECK(loaded().materials.at(0).front == Rgba{1, 1, 1, 1});
    CHECK(loaded().textures.at(0).texels == std::vector<std::uint8_t>{10, 20, 30, 255});
    CHECK(loaded().meshes.at(0).colors.at(2)[3] == 1);
}

TEST_CASE("a material that can never be visible is loaded as written with a warning") {
    GltfFile file = everything();
    file.json["materials"][0]["alphaMode"] = "MASK";
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 0;
    const auto scene = file.load();
    CHECK(scene.list.materials.at(0).front[3] == 0);
    CHECK(scene.warnings ==
          std::vector<std::string>{"/materials/0: its alpha is below its cutoff: nothing of it is drawn"});
    file.json["materials"][0]["alphaCutoff"] = 0;  // alpha 0 passes this cutoff
    CHECK(file.load().warnings.empty());
    file.json["materials"][0]["alphaMode"] = "BLEND";
    CHECK(file.load().warnings ==
          std::vector<std::string>{
              "/materials/0: its alpha is 0: nothing of it is seen, but its fragments are peeled as layers"});
}

TEST_CASE("a material that transmits light is reported with its factor and the way to draw it blended") {
    GltfFile file = everything();
    file.json["materials"][0]["name"] = "pane";
    file.json["extensionsUsed"] = {"KHR_materials_transmission"};
    Json& transmission = file.json["materials"][0]["extensions"]["KHR_materials_transmission"];
    transmission["transmissionFactor"] = 0.9;
    file.json["materials"][0]["alphaMode"] = "OPAQUE";
    const auto scene = file.load();
    CHECK(scene.warnings ==
          std::vector<std::string>{
              "/materials/0/extensions/KHR_materials_transmission: 'pane' transmits 0.9 of the light "
              "(KHR_materials_transmission), which is not drawn; --alpha pane=0.1 draws that material alone blended"});
    CHECK(scene.list.materials.at(0).alpha_mode == AlphaMode::opaque);
    transmission["transmissionFactor"] = 1;
    file.json["materials"][0]["name"] = "a pane";
    CHECK(file.load().warnings.at(0).find("--alpha 'a pane=0.05' draws") != std::string::npos);
    // No warning where nothing is transmitted.
    transmission["transmissionFactor"] = 0;
    CHECK(file.load().warnings.empty());
    transmission.erase("transmissionFactor");
    CHECK(file.load().warnings.empty());
}

TEST_CASE("unlit comes from the material or from the options and then there are no normals") {
    GltfFile file = everything();
    CHECK_FALSE(file.load().list.materials.at(0).unlit);
    CHECK(file.load().list.meshes.at(0).normals.size() == 4);
    CHECK(file.load({.light = false}).list.materials.at(0).unlit);
    file.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
    file.json["extensionsUsed"] = {"KHR_materials_unlit"};
    const auto scene = file.load();
    CHECK(scene.list.materials.at(0).unlit);
    CHECK(scene.list.meshes.at(0).normals.empty());
    CHECK(scene.extensions == std::vector<std::string>{"KHR_materials_unlit"});
    CHECK(scene.warnings.empty());
}

TEST_CASE("a primitive without material is opaque white and lit and one-sided") {
    GltfFile file = everything();
    file.json["meshes"][0]["primitives"][0].erase("material");
    const auto scene = file.load();
    CHECK(scene.list.materials.size() == 1);
    CHECK(scene.list.materials[0] == strata::pipeline::Material{.name = "default"});
    CHECK(scene.list.meshes.at(0).texcoords.empty());
}

TEST_CASE("the wrap and magnification of a sampler are used and its mip levels give a warning") {
    GltfFile file = everything();
    const auto texture = [&] { return file.load().list.textures.at(0); };
    CHECK(texture().filter == TextureFilter::nearest);
    CHECK(texture().wrap_s == TextureWrap::clamp_to_edge);
    CHECK(texture().wrap_t == TextureWrap::repeat);
    file.json["samplers"][0] = {{"minFilter", 9987}, {"wrapT", 33648}};
    CHECK(texture().filter == TextureFilter::linear);
    CHECK(texture().wrap_t == TextureWrap::mirrored_repeat);
    CHECK(file.load().warnings ==
          std::vector<std::string>{"/samplers/0/minFilter: mip levels are not emulated: magFilter is used"});
    file.json["textures"][0].erase("sampler");
    CHECK(texture().filter == TextureFilter::linear);
    CHECK(texture().wrap_s == TextureWrap::repeat);
}

TEST_CASE("a texture transform scales and then rotates counterclockwise as seen with v down and then translates") {
    const std::vector<Vec2> plain{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    CHECK(texcoords_with(Json::object()) == plain);
    check_near(texcoords_with({{"offset", {0.25, 3000000000.0}}}),
               {{0.25f, 3e9f}, {1.25f, 3e9f}, {0.25f, 3e9f}, {1.25f, 3e9f}});
    check_near(texcoords_with({{"offset", {0, 1}}, {"scale", {1, -1}}}), {{0, 1}, {1, 1}, {0, 0}, {1, 0}});
    // The extension's example: the lower left quadrant of the image (v down: 0 to 0.5, 0.5 to 1), rotated.
    check_near(texcoords_with({{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}}),
               {{0, 1}, {0, 0.5f}, {0.5f, 1}, {0.5f, 0.5f}});
    check_near(texcoords_with({{"rotation", 0.5235987755982988}, {"scale", {2, 4}}}),
               {{0, 0}, {1.7320508f, -1}, {2, 3.4641016f}, {3.7320508f, 2.4641016f}});
}

TEST_CASE("texCoord names the set and the transform's own texCoord takes precedence") {
    GltfFile file = everything();
    Json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_1"] = file.accessor<float>("VEC2", f32, 4, {9, 9, 9, 9, 9, 9, 9, 9});
    const auto first = [&] { return file.load().list.meshes.at(0).texcoords.at(0); };
    CHECK(first() == Vec2{0, 0});
    file.json[Json::json_pointer(base_texture)]["texCoord"] = 1;
    CHECK(first() == Vec2{9, 9});
    file.json[Json::json_pointer(base_texture)]["extensions"]["KHR_texture_transform"] = {{"texCoord", 0}};
    CHECK(first() == Vec2{0, 0});
}

TEST_CASE("each ignored feature is reported once with its first JSON pointer and the number of others") {
    GltfFile file = everything();
    file.json["extensionsUsed"] = {"KHR_materials_clearcoat"};
    file.json["animations"] = Json::array({Json::object()});
    file.json["materials"][0]["normalTexture"] = {{"index", 0}};
    file.add("materials", {{"normalTexture", {{"index", 0}}}, {"emissiveFactor", {1, 1, 1}}});
    CHECK(file.load().warnings ==
          std::vector<std::string>{
              "/extensionsUsed/0: extension KHR_materials_clearcoat is ignored: highlights differ, alpha does not",
              "/materials/0/normalTexture (and 1 more): normal maps are ignored: surfaces are lit by the normals of "
              "their vertices",
              "/materials/1/emissiveFactor: emission is ignored: what glows is darker",
              "/animations: animations are ignored: nodes, joints and morph weights stay as written",
          });
}
