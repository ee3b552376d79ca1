// Tests scenes at coordinates of maps: the warning, the move to the origin, and OBJ files read in double precision. The
// expected places are the decimal numbers that the test writes.
#include "scenes/far_places.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "scenes/models/obj_centre.h"
#include "tests/scenes/gltf/gltf_file.h"
#include "tests/scenes/scenes_support.h"

using namespace strata;
using namespace strata::scenes;
namespace gltf = strata::scenes::test;
using Catch::Contains;

namespace {

constexpr double east = 12958095.12, north = 4865499.47;

gltf::GltfFile triangle_at(float x, float y, float size, const gltf::Json& node = gltf::Json::object()) {
    gltf::GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({x, y, 0, x + size, y, 0, x, y + size, 0})}}}});
    file.json["nodes"][0].update(node);
    return file;
}

Scene loaded(const std::string& file, const std::string& text, const SceneOptions& options = {}) {
    const strata::test::TemporaryFolder folder;
    std::ofstream{folder / file} << text;
    return load_scene(folder / file, options);
}
Scene loaded(const gltf::GltfFile& file, const SceneOptions& options = {}) {
    return loaded("a.gltf", file.document().dump(), options);
}

// The corners of the first instance in world space.
std::vector<Vec3d> places_of(const Scene& scene) {
    const pipeline::Instance& instance = scene.list.instances.at(0);
    const pipeline::Mesh& mesh = scene.list.meshes.at(instance.mesh);
    std::vector<Vec3d> places;
    for (const std::uint32_t index : mesh.indices) {
        const auto& p = mesh.positions[index];
        Vec3d place;
        for (std::size_t r = 0; r < 3; ++r)
            place[r] = instance.model[0][r] * double{p.x} + instance.model[1][r] * double{p.y} +
                       instance.model[2][r] * double{p.z} + instance.model[3][r];
        places.push_back(place);
    }
    return places;
}

void check_near(const Vec3d& found, const Vec3d& expected, double margin) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(found[i] - expected[i]) <= margin);
}

}  // namespace

TEST_CASE("a mesh whose binary32 step is more than a thousandth of its size is warned of and one at its node is not") {
    CHECK(step_at(8388608) == 1);
    CHECK(step_at(8388607) == 0.5);
    CHECK(loaded(triangle_at(0, 0, 3, {{"translation", {east, north, 0}}})).warnings.empty());
    CHECK(loaded(triangle_at(8192, 0, 1)).warnings.empty());         // a step of 2^-10 or 1 / 1024
    CHECK_FALSE(loaded(triangle_at(16384, 0, 1)).warnings.empty());  // 1 / 512
    const auto warnings = loaded(triangle_at(static_cast<float>(east), static_cast<float>(north), 3)).warnings;
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("mesh 'mesh 0' of size 3 lies at 12958098, where binary32 numbers are 1 apart"));
}

TEST_CASE("recentre moves the middle of the bounds to the origin and cameras with it") {
    auto file = triangle_at(0, 0, 3, {{"translation", {east, north, 0}}});
    file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 10}}}});
    file.show_node({{"camera", 0}, {"translation", {east, north, 5}}});
    const Scene scene = loaded(file, {.recentre = true});
    check_near(scene.moved_by, {-east - 1.5, -north - 1.5, 0}, 1e-8);
    const auto places = places_of(scene);
    check_near(places[0], {-1.5, -1.5, 0}, 1e-8);
    check_near(places[1], {1.5, -1.5, 0}, 1e-8);
    // The camera's eye, (-1.5, -1.5, 5), is where its view has the origin.
    const pipeline::Matrix& view = scene.cameras.at(0).view;
    check_near({view[3][0], view[3][1], view[3][2]}, {1.5, 1.5, -5}, 1e-8);
    CHECK(scene.bounds.hi[0] == Approx(1.5));
    CHECK(loaded(file).moved_by == Vec3d{0, 0, 0});
}

TEST_CASE("recentre takes a far mesh apart into near vertices and a place without moving a vertex") {
    const auto file = triangle_at(static_cast<float>(east), static_cast<float>(north), 3);
    const auto before = places_of(loaded(file));
    const Scene scene = loaded(file, {.recentre = true});
    const auto after = places_of(scene);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) CHECK(after[i][c] == before[i][c] + scene.moved_by[c]);
    CHECK(std::abs(scene.list.meshes[0].positions[0].x) <= 2);
    // A mesh near its origin keeps its vertices.
    const auto near = triangle_at(0.1f, 0, 1);
    CHECK(loaded(near, {.recentre = true}).list.meshes[0] == loaded(near).list.meshes[0]);
}

#ifdef STRATA_HAS_MODELS
TEST_CASE("an OBJ file far from the origin has its vertices where its text puts them to a thousandth of a millimetre") {
    const std::string text =
        "# map\nv 12958095.12 4865499.47 0 0.5 0.25 1\n\tv 12958096.12 +4865499.47 0.0625\nv  1.295809512e7 "
        "4865500.47 0\r\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    const Scene scene = loaded("map.obj", text);
    CHECK(scene.warnings.empty());
    const auto places = places_of(scene);
    check_near(places.at(0), {east, north, 0}, 1e-6);
    check_near(places.at(1), {east + 1, north, 0.0625}, 1e-6);
    check_near(places.at(2), {12958095.12, north + 1, 0}, 1e-6);
    CHECK(scene.list.meshes[0].colors.size() == 3);
}
#endif

TEST_CASE("an OBJ file near the origin is read as it is") {
    std::string text = "v 1 2 3\nv 2 2 3\nv 1 3 3\nf 1 2 3\n";
    const std::string given = text;
    CHECK(move_obj_to_origin(text) == Vec3d{0, 0, 0});
    CHECK(text == given);
    text = "v 300 0 0\nv 301 0 0\nv 300 1 0\nvt 300 300\nf 1 2 3\n";  // a step of 2^-15
    CHECK(move_obj_to_origin(text) == Vec3d{301, 1, 0});
    CHECK(text == "v -1 -1 0\nv 0 -1 0\nv -1 0 0\nvt 300 300\nf 1 2 3\n");
}
