// scenes/scene.h - a scene loaded from a file or generated procedurally: a draw list, its bounds, its cameras and
// warnings.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/polygon_mode.h"

namespace strata::scenes {

struct Bounds {  // world space, axis-aligned; empty if lo > hi
    Vec3d lo{1, 1, 1}, hi{0, 0, 0};
    [[nodiscard]] bool is_empty() const noexcept { return lo[0] > hi[0]; }
};

// A camera of the scene (glTF). Aspect 0: the image's is used.
struct SceneCamera {
    // Unique in a scene: --camera NAME selects by it.
    std::string name{};
    pipeline::Matrix view = pipeline::identity;
    // False: orthographic. Then xmag and ymag are half the extents of the view, and yfov and aspect are not used; a
    // perspective camera does not use xmag and ymag.
    bool perspective = true;
    // yfov is the whole vertical angle in radians. Distances are in units of eye space.
    double yfov = 0, aspect = 0, xmag = 0, ymag = 0, znear = 0, zfar = 0;  // zfar 0: infinite (perspective)
};

// A material that is OPAQUE although something of it has an alpha below 1, which is then not drawn.
struct OpaqueWithAlpha {
    std::string material;
    std::string of;  // "factor", "texture" or "vertex colours"
    friend bool operator==(const OpaqueWithAlpha&, const OpaqueWithAlpha&) = default;
};

struct Scene {
    std::string name;
    pipeline::DrawList list;
    Bounds bounds;
    // The view that the scene is made for, if any: used unless the user gives another.
    std::optional<pipeline::View> own_view{};
    // In the order of the traversal of the nodes; a repeated name gets the suffix #2, #3.
    std::vector<SceneCamera> cameras;
    std::vector<std::string> extensions;  // used by the file
    std::vector<std::string> warnings;    // one message each: ignored features, with their JSON pointer
    std::vector<OpaqueWithAlpha> opaque_with_alpha{};
    // Added to every place of the file (SceneOptions::recentre).
    Vec3d moved_by{0, 0, 0};
    // The index of this scene in the file, and the number of scenes. A procedural scene is 0 of 1.
    int scene_index = 0, scene_count = 1;
};

// A material to draw as transparent, with its own alpha times `alpha`.
struct MaterialAlpha {
    std::string material;
    float alpha = 1;
    friend bool operator==(const MaterialAlpha&, const MaterialAlpha&) = default;
};

struct SceneOptions {
    std::optional<int> scene{};  // --scene N; default: the file's own, else 0
    // The frame's: materials and vertex colours are converted to it when the scene is loaded.
    pipeline::ColorSpace color_space = pipeline::ColorSpace::encoded;
    bool light = true;                   // false: all materials are unlit (--no-light)
    std::vector<MaterialAlpha> alpha{};  // --alpha NAME=A; applies to every material of that name
    bool recentre = false;               // moves the middle of the bounds to the origin (far_places.h)
    pipeline::PolygonMode polygon_mode = pipeline::PolygonMode::fill;
};

// `spec` is a path to a .gltf, .glb, .obj, .ply, .stl or .off file or to a pack, "-" for a glTF file from standard
// input (which is read once), or a procedural scene: "teapot", "volume-beam:slices=N[,order=far|near]",
// "random:seed=S,triangles=N", "shadow-demo", "showroom", "wireframe:tessellation=N", "hair:strands=N",
// "splats:points=N", "hard:case=NAME". Throws InputError for any other or malformed text.
[[nodiscard]] Scene load_scene(const std::string& spec, const SceneOptions& options);

// The two parts of load_scene, and the test that selects one. load_gltf reads every path as a glTF file, whatever its
// ending. make_procedural throws InputError for an unknown name or a wrong parameter. is_procedural checks the name
// only, not the parameters.
[[nodiscard]] Scene load_gltf(const std::string& path, const SceneOptions& options);
[[nodiscard]] Scene make_procedural(const std::string& spec, const SceneOptions& options);
[[nodiscard]] bool is_procedural(const std::string& spec);

// A procedural scene as described by the help and `strata list scenes`.
struct ProceduralScene {
    std::string name, parameters, description;  // parameters as in "slices=N[,order=far|near]"; may be empty
};
// All of them, in the order of the list.
[[nodiscard]] const std::vector<ProceduralScene>& procedural_scenes();

}  // namespace strata::scenes
