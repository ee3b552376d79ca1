// scenes/models/model_module.h - the interface of the module that wraps Assimp.
//
// Rule     Assimp is in a separate shared library that is loaded when the first OBJ, PLY, STL or OFF file is read. The
//          interface uses only standard types. Only files in the model's folder are opened, and only through `read`.
// Tests    tests/scenes/models/models_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace strata::scenes {

struct ModelMesh {
    std::string name{};
    std::size_t material = 0;
    // One per vertex; all except positions may be empty. Texture coordinates have v up.
    std::vector<std::array<float, 3>> positions{}, normals{};
    std::vector<std::array<float, 4>> colors{};
    std::vector<std::array<float, 2>> texcoords{};
    unsigned corners = 3;                  // of a face: 1 point, 2 line, 3 triangle
    std::vector<std::uint32_t> indices{};  // as many per face
};

struct ModelMaterial {
    std::string name{};
    std::array<float, 4> color{1, 1, 1, 1};  // diffuse colour and opacity
    bool is_lit = true;
    std::string texture{};  // of the diffuse colour, as named in the file
};

struct LoadedModel {
    std::vector<ModelMesh> meshes{};
    std::vector<ModelMaterial> materials{};
    bool has_library = false;  // whether a material file was read
    std::string failure{};     // the library's message; then all other members are empty
};

// Returns the bytes of a file in the model's folder, by its relative name; empty if there is none.
using ReadRelativeFile = std::function<std::vector<std::byte>(const std::string& name)>;

struct ModelModule {
    const char* version;
    // `name` is the model's file name, whose ending selects the reader.
    LoadedModel (*load)(const std::string& name, const ReadRelativeFile& read);
};

// The module's only exported symbol, and the type of the function behind it.
inline constexpr const char* model_module_symbol = "strata_model_module";
using ModelModuleEntry = const ModelModule* (*)();

}  // namespace strata::scenes
