// tests/fuzz/make_corpus.cpp - writes seeds for load_render_fuzz: one small file of each kind that the loader reads.
// Run: make_corpus FOLDER
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;

GltfFile triangle(int mode) {
    GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})}}}, {"mode", mode}});
    return file;
}

GltfFile quantised() {
    GltfFile file;
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int positions =
        file.accessor<std::int8_t>("VEC3", i8, 3, {0, 0, 0, 0, 127, 0, 0, 0, 0, 127, 0, 0}, {{"normalized", true}});
    file.json["bufferViews"][0]["byteStride"] = 4;
    file.show({{"attributes", {{"POSITION", positions}}}});
    return file;
}

GltfFile transformed() {
    GltfFile file = everything();
    file.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_unlit"};
    file.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0}}, {"rotation", 1}, {"scale", {2, -1}}, {"texCoord", 0}};
    return file;
}

GltfFile with_image(const ByteVector& image, const char* type) {
    GltfFile file = everything();
    file.json["images"][0] = {{"bufferView", file.view(image)}, {"mimeType", type}};
    return file;
}

void write(const std::filesystem::path& path, const ByteVector& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "make_corpus FOLDER\n";
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const std::pair<const char*, GltfFile> seeds[]{
        {"everything", everything()},
        {"triangles", triangle(4)},
        {"strip", triangle(5)},
        {"fan", triangle(6)},
        {"quantised", quantised()},
        {"transform", transformed()},
        {"jpeg", with_image(grey_jpeg(), "image/jpeg")},
        {"png", with_image(png(2, 2, 16, 2, std::vector<std::uint8_t>(16, 77)), "image/png")},
    };
    for (const auto& [name, file] : seeds) {
        write(folder / (std::string(name) + ".gltf"), to_bytes(file.document().dump()));
        write(folder / (std::string(name) + ".glb"), file.as_glb());
    }
}
