// Tests what a file of other programs' habits gets: the colour of specular-glossiness, the default variant, and a way
// out of textures, uris and letter case that are refused.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/scenes/gltf/gltf_file.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes::test;
using Catch::Contains;

namespace {

// The file with everything, whose material has its colour in the older extension alone.
GltfFile glossy() {
    GltfFile file = everything();
    file.json["materials"][0] = {
        {"alphaMode", "BLEND"},
        {"extensions",
         {{"KHR_materials_pbrSpecularGlossiness",
           {{"diffuseFactor", {1, 0, 0, 0.375}}, {"diffuseTexture", {{"index", 0}, {"texCoord", 0}}}}}}}};
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    return file;
}

std::string refusal_of(const GltfFile& file) { return refusal(to_bytes(file.document().dump())); }

std::string refusal_of_uri(const std::string& folder, const std::string& uri) {
    GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    Json document = file.json;
    document["buffers"] = Json::array({{{"byteLength", file.bin.size()}, {"uri", uri}}});
    const std::string path = folder + "/scene.gltf";
    std::ofstream{path} << document.dump();
    try {
        (void)strata::scenes::load_gltf(path, {});
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("specular-glossiness gives the colour and alpha and texture of a material in place of metallic-roughness") {
    GltfFile file = glossy();
    const auto scene = file.load();
    CHECK(scene.warnings.empty());
    CHECK(scene.list.materials.at(0).front == strata::Rgba{1, 0, 0, 0.375f});
    CHECK(scene.list.materials[0].texture == 0);
    CHECK(scene.list.meshes.at(0).texcoords.at(3) == strata::Vec2{1, 1});
    file.json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {0, 1, 0, 1}}, {"metallicFactor", 0}};
    CHECK(file.load().list.materials.at(0).front == strata::Rgba{1, 0, 0, 0.375f});
    Json& old = file.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"];
    old["glossinessFactor"] = 0.5;
    CHECK(file.load().warnings ==
          std::vector<std::string>{"/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/"
                                   "glossinessFactor: specular and glossiness are ignored: "
                                   "lighting is diffuse"});
    old["diffuseTexture"]["texCoord"] = 5;
    CHECK_THAT(refusal_of(file), Contains("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS"));
    old["diffuseTexture"] = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    CHECK(file.load().list.meshes.at(0).texcoords.at(0) == strata::Vec2{0.5f, 0});
    old["diffuseFactor"] = {1, 0, 0};
    CHECK_THAT(refusal_of(file), Contains("/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor"));
    file.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = 3;
    CHECK_THAT(refusal_of(file), Contains("TYPE_MISMATCH"));
}

TEST_CASE("the default variant is drawn and a warning says that there are others") {
    GltfFile file = everything();
    const auto plain = file.load();
    file.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}});
    file.json["extensionsRequired"] = {"KHR_materials_variants"};
    file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
    file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}};
    const auto scene = file.load();
    CHECK(scene.list.materials == plain.list.materials);
    CHECK(scene.warnings == std::vector<std::string>{
                                "/extensions/KHR_materials_variants: the default materials are drawn, not a variant"});
}

TEST_CASE("a texture in a format that is not read names the command that converts it") {
    for (const auto& [extension, command] : {std::pair{"EXT_texture_webp", "gltf-transform png"},
                                             {"EXT_texture_avif", "gltf-transform png"},
                                             {"KHR_texture_basisu", "gltf-transform ktxdecompress"}}) {
        GltfFile file = everything();
        file.json["textures"][0] = {{"extensions", {{extension, {{"source", 0}}}}}};
        CHECK_THAT(refusal_of(file), Contains(std::string("found an image by ") + extension + " alone (" + command));
        file.json["textures"][0]["source"] = 0;
        CHECK(refusal_of(file).empty());
        file.json["extensionsRequired"] = {extension};
        CHECK_THAT(refusal_of(file), Contains(command));
    }
}

TEST_CASE("a uri with a backslash or in another letter case is refused with what is wrong") {
    const strata::test::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "Textures");
    std::ofstream{folder / "Textures/Wall.bin"} << std::string(36, '\0');
    CHECK(refusal_of_uri(folder / "", "Textures/Wall.bin").empty());
    CHECK_THAT(refusal_of_uri(folder / "", "textures/wall.BIN"),
               Contains("found 'textures/wall.BIN', which is 'Textures/Wall.bin' there: letter case differs"));
    CHECK_THAT(refusal_of_uri(folder / "", "textures/wood.bin"),
               Contains("found 'textures/wood.bin' [FILE_NOT_FOUND]"));
    CHECK_THAT(refusal_of_uri(folder / "", "Textures\\Wall.bin"),
               Contains("expected a uri with / between folders and file") && Contains("which has a backslash"));
    CHECK_THAT(refusal_of_uri(folder / "", "Textures%5cWall.bin"), Contains("which has a backslash"));
    // A name that differs in case and leads out of the folder is not shown.
    std::filesystem::create_symlink("/etc/passwd", folder / "Secret");
    CHECK_THAT(refusal_of_uri(folder / "", "secret"), Contains("found 'secret' [FILE_NOT_FOUND]"));
}
