// scenes/models/models.cpp - converts the meshes, materials and textures that Assimp has read to a scene (models.h).
#include "scenes/models/models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include "pipeline/vertices/check_list.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/rules/primitive.h"
#include "scenes/bounds.h"
#include "scenes/file_ending.h"
#include "scenes/files/image_decode.h"
#include "scenes/files/text_file.h"
#include "scenes/flat_normals.h"
#include "scenes/inside_folder.h"
#include "scenes/memory_limit.h"
#include "scenes/models/load_model_module.h"
#include "scenes/models/model_counts.h"
#include "scenes/models/obj_centre.h"
#include "scenes/numbers/srgb_encode.h"

namespace strata::scenes {

namespace {

namespace fs = std::filesystem;
using pipeline::AlphaMode;

constexpr std::size_t max_bytes = std::size_t{1} << 32;

// The model's folder, and the files in it that the model may open: those whose names do not lead out of it.
class ModelFolder {
  public:
    explicit ModelFolder(const std::string& path) : path_{path}, folder_{fs::path(path).parent_path()} {}

    // Errors in the model itself throw; for another file that is missing or no regular file the result is empty.
    [[nodiscard]] std::vector<std::byte> read(const std::string& name) {
        const fs::path relative = fs::path(name).lexically_normal();
        if (relative == fs::path(path_).filename()) {
            check_model_memory();
            std::vector<std::byte> bytes = bytes_of(path_);
            if (bytes.empty()) throw InputError(path_, "size", "a model", "an empty file");
            const std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
            if (has_ending(path_, ".ply")) edges_ = models::check_ply_counts(text, path_);
            if (has_ending(path_, ".off")) models::check_off_counts(text, path_);
            return bytes;
        }
        const auto file = inside(name);
        return file ? bytes_of(*file) : std::vector<std::byte>{};
    }
    // The edges of a PLY file that has been read.
    [[nodiscard]] std::uint64_t edges() const noexcept { return edges_; }
    [[nodiscard]] std::optional<std::string> inside(std::string name) const {
        std::ranges::replace(name, '\\', '/');
        const InsideFolder found = inside_folder(folder_, name);
        std::error_code ignored;
        return fs::is_regular_file(found.path, ignored) ? std::optional(found.path.string()) : std::nullopt;
    }
    // The name of a file that differs from `name` in letter case alone, or "".
    [[nodiscard]] std::string in_other_case(std::string name) const {
        std::ranges::replace(name, '\\', '/');
        return name_in_other_case(folder_, name);
    }

  private:
    // Assimp's meshes, next to ours and to the file's text, take up to 10 bytes for a byte of the file (STL).
    void check_model_memory() const {
        const std::uint64_t bytes = size_of_file(path_, max_bytes);
        check_memory_need(path_, "size",
                          {.kind = "a model that takes",
                           .amount = std::to_string(bytes) + " bytes, which take",
                           .bytes = 10 * bytes});
    }
    [[nodiscard]] static std::vector<std::byte> bytes_of(const std::string& file) {
        const std::string text = read_text_file(file, max_bytes);
        const auto bytes = std::as_bytes(std::span{text});
        return {bytes.begin(), bytes.end()};
    }
    std::string path_;
    fs::path folder_;
    std::uint64_t edges_ = 0;
};

class ModelScene {
  public:
    ModelScene(const std::string& path, const SceneOptions& options) : path_{path}, options_{options}, folder_{path} {}

    Scene build() {
        const std::string name = fs::path(path_).filename().string();
        LoadedModel model = loaded(name);
        // Assimp reports a failed allocation, which large counts in a file cause, by the name of its exception.
        if (model.failure == "std::bad_alloc")
            throw InputError(path_, "size", "a model that fits into memory", "an allocation that failed in Assimp");
        if (!model.failure.empty())
            throw InputError(path_, "content", "a model that Assimp can read", in_quotes(model.failure));
        scene_.name = name;
        for (const ModelMaterial& material : model.materials) add_material(material);
        for (ModelMesh& mesh : model.meshes) add_mesh(std::move(mesh));
        pipeline::check(scene_.list);
        scene_.bounds = bounds_of(scene_.list);
        return std::move(scene_);
    }

  private:
    [[nodiscard]] bool has_materials() const { return has_ending(path_, ".obj"); }

    // Read errors bypass the library, which would discard them.
    LoadedModel loaded(const std::string& name) {
        std::exception_ptr failure;
        std::set<std::string> missing;
        const auto read = [&](const std::string& file) -> std::vector<std::byte> {
            try {
                std::vector<std::byte> bytes = folder_.read(file);
                if (has_materials() && fs::path(file).lexically_normal() == fs::path(path_).filename())
                    move_to_origin(bytes);
                if (bytes.empty()) missing.insert(in_quotes(file));
                return bytes;
            } catch (const std::exception&) {
                failure = std::current_exception();
                return {};
            }
        };
        LoadedModel model = model_module().load(name, read);
        if (failure) std::rethrow_exception(failure);
        if (folder_.edges() > 0)
            scene_.warnings.push_back(fmt::format(
                "its {} edges are not drawn: of a PLY file only vertices and faces are read", folder_.edges()));
        if (!missing.empty() && !model.has_library)
            scene_.warnings.push_back(fmt::format(
                "its materials are drawn white: found none of the material libraries {} in the model's folder",
                fmt::join(missing, ", ")));
        return model;
    }

    void move_to_origin(std::vector<std::byte>& obj) {
        std::string text{reinterpret_cast<const char*>(obj.data()), obj.size()};
        place_ = move_obj_to_origin(text);
        if (place_ == Vec3d{0, 0, 0}) return;
        const auto bytes = std::as_bytes(std::span{text});
        obj.assign(bytes.begin(), bytes.end());
    }

    void add_material(const ModelMaterial& from) {
        pipeline::Material made{
            .name = from.name.empty() ? "material " + std::to_string(scene_.list.materials.size()) : from.name,
            .double_sided = true,
            .unlit = !options_.light || !from.is_lit};
        if (has_materials()) {
            for (std::size_t c = 0; c < 4; ++c)
                made.front[static_cast<Rgba::length_type>(c)] = std::clamp(from.color[c], 0.0f, 1.0f);
            made.front = from_encoded(made.front, options_.color_space);
            if (!from.texture.empty()) made.texture = texture(from.texture);
        }
        made.back = made.front;
        if (made.front[3] < 1) made.alpha_mode = AlphaMode::blend;
        scene_.list.materials.push_back(made);
    }

    // -1, with a warning, for a texture that cannot be read.
    int texture(const std::string& name) {
        if (const auto known = textures_.find(name); known != textures_.end()) return known->second;
        int& number = textures_[name] = -1;
        const auto file = folder_.inside(name);
        if (!file) {
            const std::string other = folder_.in_other_case(name);
            scene_.warnings.push_back("texture " + in_quotes(name) +
                                      " is not drawn: no file of that name in the model's folder" +
                                      (other.empty() ? "" : ", but " + in_quotes(other) + ": letter case differs"));
            return number;
        }
        const std::vector<std::byte> bytes = folder_.read(name);
        if (!has_ending(*file, ".png") && !has_ending(*file, ".jpg") && !has_ending(*file, ".jpeg")) {
            scene_.warnings.push_back("texture " + in_quotes(name) + " is not drawn: it is neither PNG nor JPEG");
            return number;
        }
        const FileLocation location{*file, ""};
        const ImageHeader header = read_image_header(bytes, location);
        pipeline::Texture made{.name = name,
                               .width = static_cast<int>(header.width),
                               .height = static_cast<int>(header.height),
                               .decode_srgb = options_.color_space == pipeline::ColorSpace::linear,
                               .texels = decode_image(bytes, header, location)};
        number = static_cast<int>(scene_.list.textures.size());
        scene_.list.textures.push_back(std::move(made));
        return number;
    }

    // Lines and points without normals are unlit.
    static void set_indices(pipeline::Mesh& mesh, const ModelMesh& from) {
        mesh.primitive = rasterizer::primitive_of(from.corners);
        for (std::size_t i = 0; i < from.indices.size(); i += from.corners)
            rasterizer::append_primitive(mesh.indices, {&from.indices[i], from.corners});
    }

    // A mesh with an alpha below 1 makes its material blended for all meshes that share it.
    void add_mesh(ModelMesh&& from) {
        if (from.indices.empty()) return;
        pipeline::Material& material = scene_.list.materials.at(from.material);
        pipeline::Mesh mesh;
        mesh.name = from.name.empty() ? "mesh " + std::to_string(scene_.list.meshes.size()) : from.name;
        for (const auto& p : from.positions) mesh.positions.push_back({p[0], p[1], p[2]});
        for (const auto& n : from.normals) mesh.normals.push_back({n[0], n[1], n[2]});
        for (const auto& given : from.colors) {
            // Colours of OBJ have no alpha: Assimp gives 0 to vertices without a colour in a mesh that has some.
            const auto c = has_materials() && given[3] == 0 ? std::array<float, 4>{1, 1, 1, 1} : given;
            if (c[3] < 1) material.alpha_mode = AlphaMode::blend;
            mesh.colors.push_back(from_encoded({c[0], c[1], c[2], c[3]}, options_.color_space));
        }
        if (material.texture >= 0) {
            for (const auto& t : from.texcoords) mesh.texcoords.push_back({t[0], 1.0f - t[1]});
            mesh.texcoords.resize(mesh.positions.size(), {0, 1});  // without coordinates: the texture's first texel
        }
        set_indices(mesh, from);
        if (material.unlit)
            mesh.normals.clear();
        else if (mesh.normals.empty() && mesh.primitive == pipeline::Primitive::triangles)
            make_flat(mesh);
        scene_.list.instances.push_back({.mesh = static_cast<std::uint32_t>(scene_.list.meshes.size()),
                                         .material = static_cast<std::uint32_t>(from.material)});
        for (std::size_t i = 0; i < 3; ++i) scene_.list.instances.back().model[3][i] = place_[i];
        scene_.list.meshes.push_back(std::move(mesh));
    }

    const std::string& path_;
    const SceneOptions& options_;
    ModelFolder folder_;
    Scene scene_;
    std::map<std::string, int> textures_;
    Vec3d place_{0, 0, 0};  // of an OBJ that was moved to the origin
};

bool has_one_of(const std::string& path, std::initializer_list<std::string_view> endings) {
    return std::ranges::any_of(endings, [&](std::string_view ending) { return has_ending(path, ending); });
}

}  // namespace

bool is_model(const std::string& path) { return has_one_of(path, {".obj", ".ply", ".stl", ".off"}); }

bool is_foreign_model(const std::string& path) {
    return has_one_of(path,
                      {".fbx", ".dae", ".3ds",  ".blend", ".usd", ".usda", ".usdc", ".usdz", ".wrl", ".x3d", ".vrml",
                       ".3mf", ".lwo", ".ms3d", ".iges",  ".igs", ".step", ".stp",  ".vtk",  ".vtp", ".vtu", ".abc"});
}

Scene load_model(const std::string& path, const SceneOptions& options) {
    const FloatEnvironment environment;
    if (options.scene.value_or(0) != 0)
        throw InputError(path, "--scene", "0, the only one", std::to_string(*options.scene));
    return ModelScene{path, options}.build();
}

}  // namespace strata::scenes
