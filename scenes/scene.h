// scenes/scene.h - a scene as it comes from a file or a formula: a draw list, its bounds, its cameras and what was
// noticed on the way.
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
    // Unique in a scene: --camera NAME chooses by it.
    std::string name{};
    pipeline::Matrix view = pipeline::identity;
    // False: orthographic. Then xmag and ymag hold half the extents of the view, and yfov and aspect are not
    // used; with perspective it is the other way round.
    bool perspective = true;
    // yfov is the whole vertical angle in radians. Distances are in units of eye space.
    double yfov = 0, aspect = 0, xmag = 0, ymag = 0, znear = 0, zfar = 0;  // zfar 0: infinite (perspective)
};

struct Scene {
    std::string name;
    pipeline::DrawList list;
    Bounds bounds;
    // The view that the scene is made for, where it is made for one: taken unless the user names another.
    std::optional<pipeline::View> own_view{};
    // In the order in which the walk over the nodes meets them; a name that was met before gets #2, #3 behind
    // it.
    std::vector<SceneCamera> cameras;
    std::vector<std::string> extensions;  // used by the file
    std::vector<std::string> warnings;    // one sentence each: features ignored, with their JSON pointer
    // Which of the file's scenes this is, and how many it has. A procedural scene is the only one of its kind:
    // 0 of 1.
    int scene_index = 0, scene_count = 1;
};

// A material that is to be drawn as transparent, its own alpha times `alpha`.
struct MaterialAlpha {
    std::string material;
    float alpha = 1;
    friend bool operator==(const MaterialAlpha&, const MaterialAlpha&) = default;
};

struct SceneOptions {
    std::optional<int> scene{};  // --scene N; default: the file's own, else 0
    // The frame's: materials and vertex colours are converted to it once, when the scene is made.
    pipeline::ColorSpace color_space = pipeline::ColorSpace::encoded;
    bool light = true;                   // false: every material unlit (--no-light)
    std::vector<MaterialAlpha> alpha{};  // --alpha NAME=A; every material of that name
};

// `spec` is a path to a .gltf, .glb, .obj, .ply, .stl or .off file or to a pack, "-" for a glTF file from standard
// input (which is read once), or a procedural scene: "teapot", "volume-beam:slices=N[,order=far|near]",
// "random:seed=S,triangles=N", "shadow-demo", "showroom", "hard:case=NAME". Throws InputError for everything that is
// not one of them or is malformed.
[[nodiscard]] Scene load_scene(const std::string& spec, const SceneOptions& options);

// The two halves of load_scene.
// load_gltf takes every path for a glTF file, whatever its ending. make_procedural throws InputError for an
// unknown name or a wrong parameter. is_procedural looks at the name alone, not at the parameters behind it.
[[nodiscard]] Scene load_gltf(const std::string& path, const SceneOptions& options);
[[nodiscard]] Scene make_procedural(const std::string& spec, const SceneOptions& options);
[[nodiscard]] bool is_procedural(const std::string& spec);

// A procedural scene as the help and `strata list scenes` describe it.
struct ProceduralScene {
    std::string name, parameters, description;  // parameters as in "slices=N[,order=far|near]", empty if none
};
// All of them, in the order in which they are listed.
[[nodiscard]] const std::vector<ProceduralScene>& procedural_scenes();

}  // namespace strata::scenes
