// scenes/procedural/procedural.cpp - procedural scenes: names, parameters, and the choice between them and files.
#include <fmt/format.h>

#include <algorithm>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/blended_materials.h"
#include "scenes/far_places.h"
#include "scenes/memory_limit.h"
#include "scenes/models/models.h"
#include "scenes/nearest_name.h"
#include "scenes/packs/pack_scene.h"
#include "scenes/packs/plain_triangles.h"
#include "scenes/procedural/hair.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "scenes/procedural/parameters.h"
#include "scenes/procedural/plane_stack.h"
#include "scenes/procedural/random_soup.h"
#include "scenes/procedural/shadow_demo.h"
#include "scenes/procedural/showroom.h"
#include "scenes/procedural/splats.h"
#include "scenes/procedural/teapot.h"
#include "scenes/procedural/volume_beam.h"
#include "scenes/procedural/wireframe.h"

namespace strata::scenes {
namespace {

using Keys = std::vector<std::string_view>;

// A typing error must not exhaust the memory: 10 million triangles of `random` take 960 MB of positions, colours and
// indices.
void check_triangles(const std::string& spec, std::uint64_t triangles) {
    constexpr std::uint64_t bytes_of_a_triangle = 96;
    check_memory_need(spec, "scene",
                      {.kind = "triangles that take",
                       .amount = std::to_string(triangles) + " triangles, which take",
                       .bytes = triangles * bytes_of_a_triangle});
}

// The functions below give each parameter its range and default, as described in procedural_scenes(). A cell is two
// triangles: 256 makes 4.2 million of them over the 32 patches.
Scene teapot(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"tessellation"}};
    const std::uint64_t cells = parameters.integer("tessellation", 1, 256, 16);
    check_triangles(spec, 32 * 2 * cells * cells);
    return make_teapot(options, static_cast<int>(cells));
}

Scene volume_beam(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"slices", "order"}};
    const auto slices = static_cast<int>(parameters.integer("slices", 1, 65536, 32));
    // The first choice is the default, hence `far` first.
    const bool from_near = parameters.choice("order", Keys{"far", "near"}) == 1;
    return make_volume_beam(options, slices, from_near ? BeamOrder::near : BeamOrder::far);
}

Scene random_soup(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"seed", "triangles"}};
    const auto triangles = static_cast<std::uint32_t>(parameters.integer("triangles", 0, 10'000'000, 1000));
    check_triangles(spec, triangles);
    return make_random_soup(options, parameters.integer("seed", 0, UINT64_MAX, 1), triangles);
}

Scene plane_stack(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"count", "gap", "cells"}};
    const PlaneStack stack{.count = static_cast<int>(parameters.integer("count", 1, 64, 6)),
                           .cells = static_cast<int>(parameters.integer("cells", 1, 256, 8)),
                           .gap = static_cast<double>(parameters.integer("gap", 0, 1u << 20, 1u << 16))};
    // Plane i has i cells more on each side.
    const auto most_cells = static_cast<std::uint64_t>(stack.cells + stack.count);
    check_triangles(spec, 2 * static_cast<std::uint64_t>(stack.count) * most_cells * most_cells);
    return make_plane_stack(options, stack);
}

// The list of keys is empty: every parameter is rejected.
Scene shadow_demo(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{}};
    return make_shadow_demo(options);
}

Scene showroom(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{}};
    return make_showroom(options);
}

Scene wireframe(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"tessellation"}};
    return make_wireframe(options, static_cast<int>(parameters.integer("tessellation", 1, 64, 4)));
}

// A segment has three indices and a vertex, which is about a triangle.
Scene hair(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"strands", "segments", "seed"}};
    const Hair hair{.seed = parameters.integer("seed", 0, UINT64_MAX, 1),
                    .strands = static_cast<int>(parameters.integer("strands", 1, 1'000'000, 1000)),
                    .segments = static_cast<int>(parameters.integer("segments", 1, 64, 8))};
    check_triangles(spec, static_cast<std::uint64_t>(hair.strands) * static_cast<std::uint64_t>(hair.segments));
    return make_hair(options, hair);
}

Scene splats(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"points", "seed"}};
    const auto points = static_cast<std::uint32_t>(parameters.integer("points", 1, 10'000'000, 10'000));
    check_triangles(spec, points);
    return make_splats(options, parameters.integer("seed", 0, UINT64_MAX, 1), points);
}

// The first case is the default.
Scene hard_case(const std::string& spec, const SceneOptions& options) {
    const Parameters parameters{spec, Keys{"case"}};
    Keys cases;
    for (const HardCase& hard : hard_cases()) cases.push_back(hard.name);
    return make_hard_case(options, hard_cases()[parameters.choice("case", cases)]);
}

// The table of names and functions. A new scene is a line here and one in procedural_scenes().
struct SceneMaker {
    std::string_view name;
    Scene (*make)(const std::string& spec, const SceneOptions& options);
};
constexpr SceneMaker makers[] = {
    {"teapot", teapot},           {"volume-beam", volume_beam}, {"random", random_soup},  {"planes", plane_stack},
    {"shadow-demo", shadow_demo}, {"showroom", showroom},       {"wireframe", wireframe}, {"hair", hair},
    {"splats", splats},           {"hard", hard_case}};

Keys names() {
    Keys result;
    for (const SceneMaker& maker : makers) result.push_back(maker.name);
    return result;
}

// Endings are compared in either case, for ASCII letters, independently of the locale.
bool is_gltf_path(const std::string& spec) {
    std::string tail = spec.substr(spec.size() - std::min<std::size_t>(spec.size(), 5));
    std::ranges::transform(tail, tail.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return tail == ".gltf" || tail.ends_with(".glb");
}

}  // namespace

const std::vector<ProceduralScene>& procedural_scenes() {
    static const std::vector<ProceduralScene> scenes{
        {"teapot", "tessellation=N",
         "Utah teapot on a ground plane: outside red, inside green, plane blue; N x N cells a patch (1 to 256, default "
         "16)"},
        {"volume-beam", "slices=N,order=far|near",
         "N alpha-modulated planes crossed by a conical shell (1 to 65536, default 32), drawn from the far or the near "
         "end"},
        {"random", "seed=S,triangles=N",
         "triangle soup with exact ties for tests (0 to 10000000, default 1000; seed default 1)"},
        {"planes", "count=N,gap=G,cells=C",
         "N parallel planes, G / 2^20 apart, each cut into a grid of its own (1 to 64, default 6; 0 to 1048576, "
         "default "
         "65536; 1 to 256, default 8)"},
        {"shadow-demo", "",
         "a teapot on a plane behind a pane of glass, with a light whose shadow map every pass looks at"},
        {"showroom", "",
         "one of everything that a renderer can get wrong, made for 64x64 pixels: strata diagnose looks at it"},
        {"wireframe", "tessellation=N",
         "a teapot of glass with the sides of its cells as lines; N x N cells a patch (1 to 64, default 4)"},
        {"hair", "strands=N,segments=K,seed=S",
         "N strands of K lines each on a head, tens of layers deep (1 to 1000000, default 1000; 1 to 64, default 8; "
         "seed default 1)"},
        {"splats", "points=N,seed=S",
         "a teapot as N points with a soft round texture, for --point-sprites and --point-size (1 to 10000000, default "
         "10000; seed default 1)"},
        {"hard", "case=NAME",
         "a small scene on which rasterizers and peels go wrong, seen as it is meant to be unless a camera is named "
         "(strata hard-cases --list names them)"},
    };
    return scenes;
}

bool is_procedural(const std::string& spec) {
    return std::ranges::find(makers, scene_name(spec), &SceneMaker::name) != std::end(makers);
}

Scene make_procedural(const std::string& spec, const SceneOptions& options) {
    const FloatEnvironment environment;
    const auto maker = std::ranges::find(makers, scene_name(spec), &SceneMaker::name);
    if (maker == std::end(makers)) {
        throw InputError(spec, "scene", fmt::format("one of {}", fmt::join(names(), ", ")),
                         quoted_with_suggestion(scene_name(spec), names()));
    }
    // --scene N selects one of the scenes of a file; a procedural scene has only one.
    if (options.scene.value_or(0) != 0)
        throw InputError(spec, "--scene", "0, the only one", std::to_string(*options.scene));
    // The function runs in the floating-point environment set above, so that a caller's rounding mode affects no
    // vertex.
    return maker->make(spec, options);
}

namespace {

Scene loaded(const std::string& spec, const SceneOptions& options) {
    // The name decides first: "teapot:x.gltf" is the teapot with a wrong parameter, "./teapot:x.gltf" is a file.
    if (is_procedural(spec)) return make_procedural(spec, options);
    if (spec == "-" || is_gltf_path(spec)) return load_gltf(spec, options);
    if (is_pack(spec)) return load_pack(spec, options);
    if (is_plain_triangles(spec)) return load_plain_triangles(spec, options);
    if (is_model(spec)) return load_model(spec, options);
    if (is_foreign_model(spec))
        throw InputError(spec, "scene", "a .gltf, .glb, .obj, .ply, .stl or .off file",
                         "another format; `assimp export MODEL MODEL.glb` or Blender makes one of it");
    throw InputError(
        spec, "scene",
        fmt::format(
            "a .gltf, .glb, .obj, .ply, .stl or .off file, a pack's folder, triangles in .npy or .json, or one of {}",
            fmt::join(names(), ", ")),
        quoted_with_suggestion(scene_name(spec), names()));
}

// True if the matrix maps every triangle to a line or a point: two axes at least are scaled to 0 or fall on one line.
bool has_no_area(const pipeline::Matrix& m) noexcept {
    for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i) {
            const int b = (a + 1) % 3, j = (i + 1) % 3;
            if (m[a][i] * m[b][j] != m[a][j] * m[b][i]) return false;
        }
    return true;
}

void warn_of_scale_0(const std::string& spec, Scene& scene) {
    std::size_t count = 0, first = 0;
    const auto& instances = scene.list.instances;
    for (std::size_t i = instances.size(); i-- > 0;)
        if (has_no_area(instances[i].model)) {
            ++count;
            first = i;
        }
    if (count == 0) return;
    scene.warnings.push_back(spec + ": " + std::to_string(count) + " of " + std::to_string(instances.size()) +
                             " instances have a scale of 0 and are not drawn; the first is instance " +
                             std::to_string(first) + ", mesh '" + scene.list.meshes[instances[first].mesh].name + "'");
}

}  // namespace

Scene load_scene(const std::string& spec, const SceneOptions& options) {
    Scene scene = loaded(spec, options);
    blend_materials(scene.list, options.alpha, spec);
    scene.list = with_polygon_mode(std::move(scene.list), options.polygon_mode);
    warn_of_scale_0(spec, scene);
    warn_of_far_places(scene);
    if (options.recentre) recentre(scene);
    return scene;
}

}  // namespace strata::scenes
