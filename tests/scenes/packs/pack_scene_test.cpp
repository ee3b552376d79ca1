// Tests scenes in packs: the scene that is read must equal the one that was written, NaN by its bits.
#include "scenes/packs/pack_scene.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "tests/support/own_folder.h"

using namespace strata;
using namespace strata::scenes;

namespace {

// Writes a folder with only the scene's part of a pack.
void write_scene(const Scene& scene, pipeline::ColorSpace space, const std::string& folder) {
    const auto put = [&](const std::string& name, const std::string& bytes) {
        const std::filesystem::path path = std::filesystem::path(folder) / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream{path, std::ios::binary} << bytes;
    };
    PackFiles files{put};
    nlohmann::ordered_json manifest{{"format", "strata-pack"}, {"version", 1}};
    manifest["scene"] = scene_json(scene, space, files);
    manifest["view"] = view_json(*scene.own_view);
    put("manifest.json", manifest.dump());
}

template <class T>
bool same_floats(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool is_same(const pipeline::Mesh& a, const pipeline::Mesh& b) {
    return a.name == b.name && same_floats(a.positions, b.positions) && same_floats(a.normals, b.normals) &&
           same_floats(a.colors, b.colors) && same_floats(a.texcoords, b.texcoords) && a.indices == b.indices &&
           a.primitive == b.primitive;
}

void check_same(const Scene& a, const Scene& b) {
    REQUIRE(a.list.meshes.size() == b.list.meshes.size());
    for (std::size_t i = 0; i < a.list.meshes.size(); ++i) CHECK(is_same(a.list.meshes[i], b.list.meshes[i]));
    CHECK(a.list.materials == b.list.materials);
    CHECK(a.list.textures == b.list.textures);
    CHECK(a.list.instances == b.list.instances);
    CHECK(a.list.light == b.list.light);
    CHECK(a.own_view->view == b.own_view->view);
    CHECK(a.own_view->projection == b.own_view->projection);
    CHECK(a.own_view->vertex_path == b.own_view->vertex_path);
}

}  // namespace

TEST_CASE("every built-in scene is unchanged in every bit after a pack round trip") {
    std::vector<std::string> names{"teapot:tessellation=2", "volume-beam:slices=3", "random:triangles=40,seed=9",
                                   "planes:count=2,cells=2", "shadow-demo"};
    for (const HardCase& hard : hard_cases())
        if (hard.name != "million-in-a-pixel") names.push_back("hard:case=" + std::string{hard.name});
    for (const std::string& name : names) {
        INFO(name);
        const strata::test::OwnFolder folder;
        Scene scene = load_scene(name, {.color_space = pipeline::ColorSpace::linear});
        if (!scene.own_view) scene.own_view = orbit_view(scene.bounds, 33, 21, 1.25);
        write_scene(scene, pipeline::ColorSpace::linear, folder.path());
        REQUIRE(is_pack(folder.path()));
        const Scene back = load_scene(folder.path() + "/manifest.json", {.color_space = pipeline::ColorSpace::linear});
        check_same(scene, back);
        if (!scene.bounds.is_empty()) CHECK((back.bounds.lo == scene.bounds.lo && back.bounds.hi == scene.bounds.hi));
    }
}

TEST_CASE("a pack keeps lines and points and has no key for triangles") {
    using enum pipeline::Primitive;
    for (const pipeline::Primitive primitive : {triangles, lines, points, polygon_lines, polygon_points}) {
        const strata::test::OwnFolder folder;
        Scene scene = load_scene("random:triangles=2,seed=1", {});
        scene.list.meshes[0].primitive = primitive;
        scene.list.meshes[0].indices = {0, 0, 0};
        scene.own_view = orbit_view(scene.bounds, 33, 21, 1.25);
        write_scene(scene, pipeline::ColorSpace::encoded, folder.path());
        check_same(scene, load_scene(folder.path(), {}));
        const auto mesh = read_manifest(folder.path()).at("scene").at("meshes").at(0);
        CHECK(mesh.contains("primitive") == (primitive != triangles));
    }
}

TEST_CASE("a pack keeps a file's lights, and has no key for them without any") {
    using pipeline::LightType;
    const strata::test::OwnFolder folder;
    Scene scene = load_scene("random:triangles=2,seed=1", {});
    scene.own_view = orbit_view(scene.bounds, 33, 21, 1.25);
    scene.list.lights = {{.ambient = {0.1f, 0, 0.3f}, .direction = {1, -2, 0.5f}},
                         {.type = LightType::point, .position = {1, 2, 3}, .attenuation = {0, 0.5f, 1}, .range = 7},
                         {.type = LightType::spot, .diffuse = {2, 1, 0}, .cutoff = 30, .exponent = 4.5f}};
    write_scene(scene, pipeline::ColorSpace::encoded, folder.path());
    CHECK(load_scene(folder.path(), {}).list.lights == scene.list.lights);
    CHECK_FALSE(read_manifest(folder.path()).at("scene").at("lights").at(0).contains("range"));
    const strata::test::OwnFolder unlit;
    scene.list.lights.clear();
    write_scene(scene, pipeline::ColorSpace::encoded, unlit.path());
    CHECK_FALSE(read_manifest(unlit.path()).at("scene").contains("lights"));
}

TEST_CASE("a pack is rejected where it is damaged or where something missing is requested") {
    const strata::test::OwnFolder folder;
    Scene scene = load_scene("planes:count=1,cells=1", {});
    scene.own_view = orbit_view(scene.bounds, 33, 21, 1);
    write_scene(scene, pipeline::ColorSpace::encoded, folder.path());
    CHECK_NOTHROW(load_scene(folder.path(), {}));
    CHECK_THROWS_WITH(load_scene(folder.path(), {.scene = 1}), Catch::Contains("--scene"));
    CHECK_THROWS_WITH(load_scene(folder.path(), {.color_space = pipeline::ColorSpace::linear}),
                      Catch::Contains("--color-space"));
    const std::string manifest = folder.path() + "/manifest.json";
    std::ifstream in{manifest};
    const std::string text{std::istreambuf_iterator<char>{in}, {}};
    const auto fails = [&](const std::string& what, const std::string& by, const std::string& message) {
        std::string changed = text;
        REQUIRE(changed.find(what) != std::string::npos);
        changed.replace(changed.find(what), what.size(), by);
        std::ofstream{manifest} << changed;
        CHECK_THROWS_WITH(load_scene(folder.path(), {}), Catch::Contains(message));
    };
    fails("\"version\":1", "\"version\":2", "manifest.json: /version: expected 1");
    fails("strata-pack", "strata-park", "/format");
    fails("scene/mesh.000.positions.npy", "../positions.npy",
          "/scene/meshes/0/positions: expected a file in the folder ");
    fails("scene/mesh.000.positions.npy", "scene/mesh.000.indices.npy",
          "positions: expected an array of f4 of shape (n, 3)");
    fails("\"texture\":-1", "\"texture\":3", "texture");
    fails("\"mesh\":0", "\"mesh\":5", "mesh");
}
