// scenes/models/model_module.h - the border to Assimp: what the rest of the project asks of it, and what it answers.
//
// Rule     Assimp stands in a shared library of its own that is loaded when the first OBJ, PLY, STL or OFF file is
//          read. Standard types alone cross the border. Nothing is opened but files in the model's folder, and those
//          through `read`.
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
    // One a vertex; all but positions may be empty. Texture coordinates with v up.
    std::vector<std::array<float, 3>> positions{}, normals{};
    std::vector<std::array<float, 4>> colors{};
    std::vector<std::array<float, 2>> texcoords{};
    std::vector<std::uint32_t> indices{};  // three a triangle
};

struct ModelMaterial {
    std::string name{};
    std::array<float, 4> color{1, 1, 1, 1};  // diffuse, and opacity
    bool is_lit = true;
    std::string texture{};  // of the diffuse colour, as the file names it
};

struct LoadedModel {
    std::vector<ModelMesh> meshes{};
    std::vector<ModelMaterial> materials{};
    bool has_library = false;  // whether a file of materials was read
    std::string failure{};     // the library's words; then there is nothing else
};

// The bytes of a file beside the model, by its name there; nothing where there is none.
using ReadBeside = std::function<std::vector<std::byte>(const std::string& name)>;

struct ModelModule {
    const char* version;
    // `name` is the model's file name, whose ending chooses the reader.
    LoadedModel (*load)(const std::string& name, const ReadBeside& read);
};

// The module's only exported symbol, and the type of the function behind it.
inline constexpr const char* model_module_symbol = "strata_model_module";
using ModelModuleEntry = const ModelModule* (*)();

}  // namespace strata::scenes
