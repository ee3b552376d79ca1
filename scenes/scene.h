// scenes/scene.h - a scene as it comes from a file or a formula: a draw list, its bounds, its cameras and what was noticed on the way.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipeline/vertices/draw_list.h"

namespace strata::scenes {

struct Bounds {  // world space, axis-aligned; empty while lo > hi
    Vec3d lo{1, 1, 1}, hi{0, 0, 0};
    [[nodiscard]] bool is_empty() const noexcept { return lo[0] > hi[0]; }
};

// A camera that the scene brings along (glTF). Aspect 0: take the image's.
struct SceneCamera {
    std::string name{};
    pipeline::Matrix view = pipeline::identity;
    bool perspective = true;
    double yfov = 0, aspect = 0, xmag = 0, ymag = 0, znear = 0, zfar = 0;  // zfar 0: infinite (perspective)
};

struct Scene {
    std::string name;
    pipeline::DrawList list;
    Bounds bounds;
    std::vector<SceneCamera> cameras;
    std::vector<std::string> extensions;  // used by the file
    std::vector<std::string> warnings;    // one sentence each: features ignored, with their JSON pointer
    int scene_index = 0, scene_count = 1;
};

struct SceneOptions {
    std::optional<int> scene{};  // --scene N; default: the file's own, else 0
    pipeline::ColorSpace color_space = pipeline::ColorSpace::encoded;
    bool light = true;  // false: every material unlit (--no-light)
};

// `spec` is a path to a .gltf or .glb file, or a procedural scene: "teapot", "volume-beam:slices=N[,order=far|near]",
// "random:seed=S,triangles=N", "shadow-demo". Throws InputError for everything that is not one of them or is malformed.
[[nodiscard]] Scene load_scene(const std::string& spec, const SceneOptions& options);

// The two halves of load_scene.
[[nodiscard]] Scene load_gltf(const std::string& path, const SceneOptions& options);
[[nodiscard]] Scene make_procedural(const std::string& spec, const SceneOptions& options);
[[nodiscard]] bool is_procedural(const std::string& spec);

struct ProceduralScene {
    std::string name, parameters, description;  // parameters as in "slices=N[,order=far|near]", empty if none
};
[[nodiscard]] const std::vector<ProceduralScene>& procedural_scenes();

}  // namespace strata::scenes
