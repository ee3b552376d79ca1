// scenes/gltf/gltf.cpp - loads a glTF file as a scene: container, JSON, checks, then meshes, materials, instances,
// cameras and lights.
#include "scenes/gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <span>

#include "pipeline/vertices/matrix.h"
#include "rasterizer/base/float_environment.h"
#include "scenes/bounds.h"
#include "scenes/files/text_file.h"
#include "scenes/gltf/check.h"
#include "scenes/gltf/document/uri.h"
#include "scenes/gltf/instancing.h"
#include "scenes/gltf/mesh.h"
#include "scenes/gltf/nodes.h"
#include "scenes/gltf/pose.h"

namespace strata::scenes {
namespace {

// Visits the nodes of one scene and adds their meshes and cameras. The order of the members matters: each is
// constructed from those above it.
class SceneBuilder {
  public:
    SceneBuilder(const Document& document, const SceneOptions& options, const GltfLimits& limits, Warnings& warnings)
        : document_{document},
          options_{options},
          warnings_{warnings},
          model_{to_model(document)},
          budget_{limits.elements, limits.texels},
          instanced_left_{limits.instanced},
          buffers_{document, budget_},
          accessors_{document, model_, buffers_},
          materials_{{document, model_, buffers_, budget_, warnings, options, scene_.list, scene_.opaque_with_alpha}},
          skins_{document, model_, accessors_, budget_} {
        // The file's own bytes count; each buffer adds its bytes when it is read.
        budget_.allow_elements(16 * document.size);
    }

    Scene build() {
        scene_.scene_count = static_cast<int>(model_.scenes.size());
        const std::vector<int> roots = choose_roots();
        for (const PlacedNode& placed : place_nodes(document_, model_, roots)) {
            const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(placed.node)];
            if (node.mesh >= 0 && !placed.is_hidden) add_instances(node.mesh, placed);
            if (node.camera >= 0) add_camera(node, placed);
            if (!placed.is_hidden) add_light(placed);
        }
        scene_.bounds = bounds_of(scene_.list);
        return std::move(scene_);
    }

  private:
    // The scene of --scene N, else the file's default, else 0; for a file without scenes, all root nodes.
    std::vector<int> choose_roots() {
        const int count = scene_.scene_count;
        scene_.scene_index = options_.scene.value_or(std::max(model_.defaultScene, 0));
        if (count > 0 && scene_.scene_index >= 0 && scene_.scene_index < count)
            return model_.scenes[static_cast<std::size_t>(scene_.scene_index)].nodes;
        if (options_.scene)
            FileLocation{document_.file, "/scenes"}.fail("UNRESOLVED_REFERENCE",
                                                         "a scene number below " + std::to_string(count),
                                                         std::to_string(*options_.scene));
        warnings_.add("/scenes", "the file has no scene: all its nodes are shown");
        return root_nodes(model_);
    }

    // A primitive with triangles, as indices into the draw list.
    struct Drawable {
        std::uint32_t mesh, material;
        bool is_skinned;  // in world space
    };

    // A mesh is loaded for the first node that shows it in this pose; further nodes only add instances. Instances
    // multiply work without enlarging the file, so their corners have a separate limit.
    void add_instances(int mesh, const PlacedNode& placed) {
        const JsonAt node = document_.at("nodes", static_cast<std::size_t>(placed.node));
        const auto instancing = instancing_of(node);
        Pose pose = pose_of(node, document_.at("meshes", static_cast<std::size_t>(mesh)), placed.world);
        if (instancing && pose.skin >= 0) {
            warnings_.add(node.location().pointer, "the skin of an instanced mesh is ignored");
            pose.skin = -1, pose.is_mirrored = false;
        }
        const auto found = drawables_.find({mesh, pose});
        const std::vector<Drawable>& drawables =
            found != drawables_.end() ? found->second : (drawables_[{mesh, pose}] = load_mesh(mesh, pose));
        if (!instancing) return add_instances(drawables, placed);
        for (const pipeline::Matrix& own : instance_transforms(*instancing, accessors_, budget_))
            add_instances(drawables, {placed.node, finite_product(placed, own)});
    }

    pipeline::Matrix finite_product(const PlacedNode& placed, const pipeline::Matrix& own) const {
        const pipeline::Matrix world = pipeline::product(placed.world, own);
        if (!std::ranges::all_of(entries_of(world), [](double v) { return std::isfinite(v); }))
            location_of(placed).fail("VALUE_NOT_IN_RANGE", "a finite world transform", "an overflow");
        return world;
    }

    FileLocation location_of(const PlacedNode& placed) const {
        return {document_.file, "/nodes/" + std::to_string(placed.node)};
    }

    void add_instances(const std::vector<Drawable>& drawables, const PlacedNode& placed) {
        for (const Drawable& drawable : drawables) {
            const std::uint64_t corners = scene_.list.meshes[drawable.mesh].indices.size();
            if (corners > instanced_left_)
                location_of(placed).fail("VALUE_NOT_IN_RANGE", "at most 2^31 indices in all instances together",
                                         "more indices with this node");
            instanced_left_ -= corners;
            scene_.list.instances.push_back(
                {drawable.mesh, drawable.material, drawable.is_skinned ? pipeline::identity : placed.world});
        }
    }

    // One mesh of the draw list per primitive that has a triangle; if there are several, the name includes the
    // primitive's index.
    std::vector<Drawable> load_mesh(int index, const Pose& pose) {
        const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(index)];
        const std::vector<JsonAt> primitives =
            document_.at("meshes", static_cast<std::size_t>(index)).elements("primitives");
        const std::string name = mesh.name.empty() ? "mesh " + std::to_string(index) : mesh.name;
        std::vector<Drawable> drawables;
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            const LoadedMaterial& material = materials_[primitive.material];
            const auto joints = joints_of(pose, primitives[p]);
            bool ignores_alpha = false;
            auto loaded = load_primitive({primitive, primitives[p].location(), material, accessors_, budget_, warnings_,
                                          options_.color_space, primitives[p], pose, joints, ignores_alpha});
            if (ignores_alpha) materials_.note_alpha(material, "vertex colours");
            if (!loaded) continue;
            loaded->name = mesh.primitives.size() == 1 ? name : name + "/" + std::to_string(p);
            drawables.push_back(
                {static_cast<std::uint32_t>(scene_.list.meshes.size()), material.index, !joints.empty()});
            scene_.list.meshes.push_back(*std::move(loaded));
        }
        return drawables;
    }

    // Empty for a primitive that is not skinned.
    std::span<const pipeline::Matrix> joints_of(const Pose& pose, const JsonAt& primitive) {
        if (pose.skin < 0) return {};
        if (has_joints(primitive)) return skins_.joints(pose.skin);
        warnings_.add(primitive.location().pointer, "a skin moves nothing of it: it has no JOINTS_0 and WEIGHTS_0");
        return {};
    }

    // `base`, or the first of base#2, base#3 ... that no previous camera has, so that --camera NAME can select each.
    std::string unique_name(const std::string& base) {
        int& number = camera_names_[base];  // the last number tried: keeps many equal names cheap
        std::string name;
        do {
            ++number;
            name = number == 1 ? base : base + "#" + std::to_string(number);
        } while (!taken_names_.insert(name).second);
        return name;
    }

    void add_camera(const tinygltf::Node& node, const PlacedNode& placed) {
        const tinygltf::Camera& c = model_.cameras[static_cast<std::size_t>(node.camera)];
        SceneCamera camera;
        const std::string written = c.name.empty() ? node.name : c.name;
        const std::string base = written.empty() ? "camera" : written;
        camera.name = unique_name(base);
        camera.view = view_of(placed.world, FileLocation{document_.file, "/nodes/" + std::to_string(placed.node)});
        camera.perspective = c.type == "perspective";
        if (camera.perspective) {
            camera.yfov = c.perspective.yfov, camera.aspect = c.perspective.aspectRatio;
            camera.znear = c.perspective.znear, camera.zfar = c.perspective.zfar;
        } else {
            camera.xmag = c.orthographic.xmag, camera.ymag = c.orthographic.ymag;
            camera.znear = c.orthographic.znear, camera.zfar = c.orthographic.zfar;
        }
        scene_.cameras.push_back(std::move(camera));
    }

    // The light of a node, if it has one.
    void add_light(const PlacedNode& placed) {
        const auto light = light_of(document_.at("nodes", static_cast<std::size_t>(placed.node)));
        if (!light) return;
        if (scene_.list.lights.size() == pipeline::most_lights)
            return warnings_.add(location_of(placed).pointer,
                                 "more than 8 lights, which is what the fixed function has: it is off");
        scene_.list.lights.push_back(
            to_light(document_.root(), *light, placed, location_of(placed), options_.color_space));
    }

    const Document& document_;
    const SceneOptions& options_;
    Warnings& warnings_;
    Scene scene_;
    tinygltf::Model model_;
    Budget budget_;
    std::uint64_t instanced_left_;
    Buffers buffers_;
    Accessors accessors_;
    Materials materials_;
    Skins skins_;
    std::map<std::pair<int, Pose>, std::vector<Drawable>> drawables_;
    std::map<std::string, int> camera_names_;
    std::set<std::string> taken_names_;
};

// `file` names the source in errors, `name` is the scene's; without a folder only data: uris are allowed.
struct GltfInput {
    Bytes bytes;
    std::string file, name;
    std::optional<std::filesystem::path> folder;
};

// No buffer or image is read before check_document() has accepted the whole document.
Scene load(const GltfInput& source, const SceneOptions& options, const GltfLimits& limits) {
    const FloatEnvironment environment;
    const Container container = split_container(source.bytes, source.file);
    const Document document{source.file, parse_json(container.json, source.file), container.bin, source.folder,
                            source.bytes.size()};
    Warnings warnings;
    check_document(document.root(), warnings);
    Scene scene = SceneBuilder{document, options, limits, warnings}.build();
    scene.name = source.name;
    for (const JsonAt& used : document.root().elements("extensionsUsed")) scene.extensions.push_back(used.string());
    scene.warnings = container.warnings;
    for (std::string& message : warnings.messages()) scene.warnings.push_back(std::move(message));
    return scene;
}

}  // namespace

Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name, const SceneOptions& options,
                      const GltfLimits& limits) {
    return load({bytes, name, name, std::nullopt}, options, limits);
}

Scene load_gltf(const std::string& path, const SceneOptions& options) {
    if (path == "-") {
        const std::string bytes = read_standard_input();
        return load_gltf_bytes(std::as_bytes(std::span{bytes}), "standard input", options);
    }
    const std::filesystem::path file{path};
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) throw InputError(path, "no such file");
    if (std::filesystem::is_directory(status)) throw InputError(path, "is a folder, not a file");
    const std::vector<std::byte> bytes = read_file(file, {path, "the file"});
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    return load({bytes, path, file.filename().string(), folder}, options, {});
}

}  // namespace strata::scenes
