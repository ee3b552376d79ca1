// Tests complete models: one scene in three containers must give one draw list, and the shared models must have the
// counts that their README states.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/scenes/gltf/gltf_file.h"
#include "tests/support/skip.h"

#ifndef STRATA_MODELS_DIR
#define STRATA_MODELS_DIR ""
#endif

namespace {

using namespace strata::scenes::test;
namespace fs = std::filesystem;
using strata::pipeline::AlphaMode;
using strata::scenes::Scene;

bool is_same(const Scene& a, const Scene& b) {
    return a.list.meshes == b.list.meshes && a.list.materials == b.list.materials &&
           a.list.textures == b.list.textures && a.list.instances == b.list.instances && a.bounds.lo == b.bounds.lo &&
           a.bounds.hi == b.bounds.hi;
}

void write(const fs::path& path, const ByteVector& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// The folder of the shared models, or an empty path if it does not exist.
fs::path models() {
    const char* const named = std::getenv("STRATA_MODELS_DIR");
    const fs::path folder = named != nullptr ? named : STRATA_MODELS_DIR;
    if (fs::is_directory(folder)) return folder;
    strata::test::skip("no models in '" + folder.string() + "'; set STRATA_MODELS_DIR to their folder");
    return {};
}

std::size_t triangles(const Scene& scene) {
    std::size_t corners = 0;
    for (const auto& instance : scene.list.instances) corners += scene.list.meshes[instance.mesh].indices.size();
    return corners / 3;
}

}  // namespace

TEST_CASE("a scene is the same as .glb and with data uris and with separate files") {
    const GltfFile file = everything();
    const fs::path folder = fs::temp_directory_path() / ("strata_gltf_model_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    Json document = file.json;
    document["buffers"] = Json::array({{{"byteLength", file.bin.size()}, {"uri", "all%2Ebin"}}});
    document["images"][0]["uri"] = "image.png";
    write(folder / "all.bin", file.bin);
    write(folder / "image.png", png(1, 1, 8, 4, {10, 20, 30, 40}));
    write(folder / "scene.gltf", to_bytes(document.dump()));
    const Scene external = strata::scenes::load_gltf((folder / "scene.gltf").string(), {});
    fs::remove_all(folder);
    GltfFile embedded = file;
    const ByteVector image = png(1, 1, 8, 4, {10, 20, 30, 40});
    embedded.json["images"][0] = {{"bufferView", embedded.view(image)}, {"mimeType", "image/png"}};
    const Scene binary = strata::scenes::load_gltf_bytes(embedded.as_glb(), "test.glb", {}), data = file.load();
    CHECK(is_same(external, data));
    CHECK(is_same(binary, data));
    CHECK(external.name == "scene.gltf");
    CHECK(data.list.meshes.at(0).colors.at(1) == strata::pipeline::Rgba{0, 0, 1, 1});  // sparse
    CHECK(data.bounds.lo == strata::Vec3d{0, 0, -5});
    CHECK(data.warnings.empty());
}

TEST_CASE("the shared models have the numbers of triangles in their README") {
    const fs::path folder = models();
    if (folder.empty()) return;
    const std::pair<const char*, std::size_t> expected[]{
        {"bunny.glb", 69666}, {"dragon.glb", 202520}, {"sponza.glb", 262267}, {"AlphaBlendModeTest.glb", 61}};
    for (const auto& [name, count] : expected) {
        INFO(name);
        CHECK(triangles(strata::scenes::load_gltf((folder / name).string(), {})) == count);
    }
}

TEST_CASE("the Khronos alpha models keep their modes and cutoffs") {
    const fs::path folder = models();
    if (folder.empty()) return;
    const Scene scene = strata::scenes::load_gltf((folder / "AlphaBlendModeTest.glb").string(), {});
    std::map<std::string, float> cutoffs;
    for (const auto& material : scene.list.materials)
        if (material.alpha_mode == AlphaMode::mask) cutoffs[material.name] = material.alpha_cutoff;
    CHECK(cutoffs ==
          std::map<std::string, float>{{"MatCutoff25", 0.25f}, {"MatCutoffDefault", 0.5f}, {"MatCutoff75", 0.75f}});
    const float asked[]{0.5f, 0.4f, 0.7f, 1.1f, 0.0f, 0.4f, 0.6f};
    for (int i = 0; i < 7; ++i) {
        const std::string name = "Material_AlphaMask_0" + std::to_string(i) + ".gltf";
        const Scene quad = strata::scenes::load_gltf((folder / "Material_AlphaMask" / name).string(), {});
        INFO(name);
        CHECK(triangles(quad) == 2);
        CHECK(quad.list.materials.at(0).alpha_cutoff == asked[i]);
        CHECK(quad.list.materials[0].front[3] == (i < 5 ? 1.0f : 0.7f));
        CHECK(quad.list.textures.size() == 1);
    }
}

TEST_CASE("Sponza's three masked materials are found and two of them can never be visible") {
    const fs::path folder = models();
    if (folder.empty()) return;
    const Scene scene = strata::scenes::load_gltf((folder / "sponza.glb").string(), {});
    CHECK(std::count_if(scene.list.materials.begin(), scene.list.materials.end(),
                        [](const auto& m) { return m.alpha_mode == AlphaMode::mask; }) == 3);
    CHECK(scene.list.textures.size() == 24);
    CHECK(std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const std::string& w) {
        return w.find("(and 1 more): its alpha is below its cutoff") != w.npos;
    }));
}
