// scenes/models/assimp_load.cpp - reads an OBJ, PLY, STL or OFF file with Assimp: triangles and materials, with
// unchanged numbers.
#include "scenes/models/assimp_load.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>

namespace strata::scenes::models {

namespace {

// A file in memory, which Assimp reads like one on disk.
class BytesStream : public Assimp::IOStream {
  public:
    explicit BytesStream(std::vector<std::byte> bytes) : bytes_{std::move(bytes)} {}
    size_t Read(void* to, size_t size, size_t count) override {
        if (size == 0) return 0;
        const size_t items = std::min(count, (bytes_.size() - at_) / size);
        std::memcpy(to, bytes_.data() + at_, items * size);
        at_ += items * size;
        return items;
    }
    size_t Write(const void*, size_t, size_t) override { return 0; }
    aiReturn Seek(size_t offset, aiOrigin origin) override {
        const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
        if (offset > bytes_.size() - from) return aiReturn_FAILURE;
        at_ = from + offset;
        return aiReturn_SUCCESS;
    }
    [[nodiscard]] size_t Tell() const override { return at_; }
    [[nodiscard]] size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

  private:
    std::vector<std::byte> bytes_;
    size_t at_ = 0;
};

// Gives Assimp only the files that `read` returns, and records whether a file other than the model was opened. Assimp
// owns it.
class ModelFolderFiles : public Assimp::IOSystem {
  public:
    ModelFolderFiles(const ReadRelativeFile& read, std::string model, bool& has_library)
        : read_{read}, model_{std::move(model)}, has_library_{has_library} {}
    [[nodiscard]] bool Exists(const char* name) const override { return !read_(name).empty(); }
    [[nodiscard]] char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override {
        if (std::strchr(mode, 'w') != nullptr) return nullptr;
        std::vector<std::byte> bytes = read_(name);
        if (bytes.empty()) return nullptr;
        has_library_ |= name != model_;
        return new BytesStream{std::move(bytes)};
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

  private:
    const ReadRelativeFile& read_;
    std::string model_;
    bool& has_library_;
};

std::array<float, 3> as_array(const aiVector3D& v) { return {v.x, v.y, v.z}; }

ModelMesh mesh_of(const aiMesh& from) {
    ModelMesh mesh{.name = from.mName.C_Str(), .material = from.mMaterialIndex};
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        mesh.positions.push_back(as_array(from.mVertices[i]));
        if (from.HasNormals()) mesh.normals.push_back(as_array(from.mNormals[i]));
        if (from.HasVertexColors(0)) {
            const aiColor4D& c = from.mColors[0][i];
            mesh.colors.push_back({c.r, c.g, c.b, c.a});
        }
        if (from.HasTextureCoords(0))
            mesh.texcoords.push_back({from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y});
    }
    // SortByPType has left faces of one kind in a mesh. A PLY file without faces has vertices alone, which are points.
    const bool is_line = from.mPrimitiveTypes == aiPrimitiveType_LINE;
    mesh.corners = is_line ? 2 : from.mPrimitiveTypes == aiPrimitiveType_POINT || from.mNumFaces == 0 ? 1 : 3;
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
        const aiFace& face = from.mFaces[i];
        if (face.mNumIndices == mesh.corners)
            mesh.indices.insert(mesh.indices.end(), face.mIndices, face.mIndices + face.mNumIndices);
    }
    if (from.mNumFaces == 0)
        for (unsigned i = 0; i < from.mNumVertices; ++i) mesh.indices.push_back(i);
    return mesh;
}

// Assimp creates a grey material if an OBJ file names none, or one that no file defines.
ModelMaterial material_of(const aiMaterial& from, bool has_library) {
    ModelMaterial material;
    aiString text;
    if (from.Get(AI_MATKEY_NAME, text) == aiReturn_SUCCESS) material.name = text.C_Str();
    aiColor3D diffuse{1, 1, 1};
    from.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
    if (!has_library || (material.name == AI_DEFAULT_MATERIAL_NAME && diffuse == aiColor3D{0.6f, 0.6f, 0.6f}))
        diffuse = {1, 1, 1};
    float opacity = 1;
    from.Get(AI_MATKEY_OPACITY, opacity);
    material.color = {diffuse.r, diffuse.g, diffuse.b, opacity};
    int shading = aiShadingMode_Gouraud;
    from.Get(AI_MATKEY_SHADING_MODEL, shading);
    material.is_lit = shading != aiShadingMode_NoShading;
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &text) == aiReturn_SUCCESS) material.texture = text.C_Str();
    return material;
}

// Points and lines become meshes of their own, polygons become triangles.
constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure;

}  // namespace

LoadedModel load(const std::string& name, const ReadRelativeFile& read) {
    LoadedModel model;
    Assimp::Importer importer;
    importer.SetIOHandler(new ModelFolderFiles{read, name, model.has_library});
    const aiScene* scene = importer.ReadFile(name, steps);
    const std::string failure = scene == nullptr ? importer.GetErrorString() : "";
    // A cloud of points is a mesh without faces, which Assimp's validation refuses.
    if (failure.ends_with("contains no faces")) {
        scene = importer.ReadFile(name, 0);
        if (scene != nullptr && (scene->mNumMeshes != 1 || scene->mMeshes[0]->mNumFaces != 0)) scene = nullptr;
    }
    if (scene == nullptr) {
        model.failure = failure;
        return model;
    }
    // Formats without a scene graph have one node, which uses each mesh once, without a transform.
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) model.meshes.push_back(mesh_of(*scene->mMeshes[i]));
    for (unsigned i = 0; i < scene->mNumMaterials; ++i)
        model.materials.push_back(material_of(*scene->mMaterials[i], model.has_library));
    return model;
}

}  // namespace strata::scenes::models
