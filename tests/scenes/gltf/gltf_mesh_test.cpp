// Tests glTF meshes against glTF 2.0, 3.7.2.1 (which vertices make which triangle). The expected triangles of small
// meshes are written by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
using Indices = std::vector<std::uint32_t>;
using strata::pipeline::ColorSpace;
using strata::pipeline::Mesh;
using Vec3s = std::vector<strata::pipeline::Vec3>;

GltfFile numbered_vertices(std::size_t count, Json primitive) {  // vertex i is at (i, i * i, 0)
    GltfFile file;
    std::vector<float> positions;
    for (std::size_t i = 0; i < count; ++i)
        positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i * i), 0});
    primitive["attributes"]["POSITION"] = file.positions(positions);
    file.show(primitive);
    return file;
}

// The vertex numbers of the corners, recovered from the mesh's positions.
Indices corners(const Mesh& mesh) {
    Indices numbers;
    for (const std::uint32_t index : mesh.indices)
        numbers.push_back(static_cast<std::uint32_t>(mesh.positions.at(index)[0]));
    return numbers;
}

Indices corners_of(std::size_t count, int mode) {
    const auto scene = numbered_vertices(count, {{"mode", mode}}).load();
    return scene.list.meshes.empty() ? Indices{} : corners(scene.list.meshes[0]);
}

}  // namespace

TEST_CASE("triangles and strips and fans take their corners in the specification's order") {
    CHECK(corners_of(6, 4) == Indices{0, 1, 2, 3, 4, 5});
    CHECK(corners_of(6, 5) == Indices{0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4});
    CHECK(corners_of(6, 6) == Indices{1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0});
    CHECK(corners_of(8, 4) == Indices{0, 1, 2, 3, 4, 5});
    CHECK(corners_of(2, 5).empty());
    CHECK(corners_of(2, 6).empty());
}

TEST_CASE("points and lines and loops and strips are the specification's pairs") {
    CHECK(corners_of(2, 0) == Indices{0, 0, 0, 1, 1, 1});
    CHECK(corners_of(4, 1) == Indices{0, 0, 1, 2, 2, 3});
    CHECK(corners_of(5, 1) == Indices{0, 0, 1, 2, 2, 3});
    CHECK(corners_of(3, 2) == Indices{0, 0, 1, 1, 1, 2, 2, 2, 0});
    CHECK(corners_of(3, 3) == Indices{0, 0, 1, 1, 1, 2});
    for (const int mode : {1, 2, 3}) CHECK(corners_of(1, mode).empty());
    using enum strata::pipeline::Primitive;
    for (const auto& [mode, primitive] :
         {std::pair{0, points}, {1, lines}, {2, line_strips}, {3, line_strips}, {4, triangles}}) {
        const auto scene = numbered_vertices(3, {{"mode", mode}}).load();
        CHECK(scene.list.meshes.at(0).primitive == primitive);
        // Lines and points without normals are unlit and share their vertices.
        CHECK(scene.list.meshes[0].normals.empty() == (primitive != triangles));
    }
    GltfFile lit = numbered_vertices(2, {{"mode", 1}});
    lit.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = lit.positions({0, 0, 1, 0, 0, 1});
    CHECK(lit.load().list.meshes.at(0).normals.size() == 2);
    CHECK(numbered_vertices(5, {{"mode", 1}}).load().warnings.size() ==
          numbered_vertices(4, {{"mode", 1}}).load().warnings.size() + 1);
}

TEST_CASE("an indexed strip is the strip of its indices and unused vertices are omitted") {
    GltfFile file = numbered_vertices(9, {{"mode", 5}});
    file.json["meshes"][0]["primitives"][0]["indices"] = file.accessor<std::uint8_t>("SCALAR", u8, 4, {7, 2, 5, 8});
    const auto lit = file.load().list.meshes.at(0), unlit = file.load({.light = false}).list.meshes.at(0);
    CHECK(corners(lit) == Indices{7, 2, 5, 2, 8, 5});
    CHECK(corners(unlit) == Indices{7, 2, 5, 2, 8, 5});
    CHECK(lit.positions.size() == 6);    // flat shading: no vertex is shared
    CHECK(unlit.positions.size() == 4);  // vertices 2 5 7 8
    CHECK(unlit.normals.empty());
}

TEST_CASE("without normals each triangle is flat and one without area still has a normal of length 1") {
    GltfFile file;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int accessor = file.positions({0, 0, 0, 2, 0, 0, 0, 3, 0,      0,   0, 0, 0, 4, 3, 0, 8, 6,
                                         0, 0, 0, 0, 5, 0, 0, 0, 1e-30f, nan, 0, 0, 1, 0, 0, 0, 1, 0});
    file.show({{"attributes", {{"POSITION", accessor}}}});
    const auto scene = file.load();
    const Vec3s& normals = scene.list.meshes.at(0).normals;
    REQUIRE(normals.size() == 12);
    const Vec3s expected{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}};
    for (std::size_t i = 0; i < 12; ++i) CHECK(normals[i] == expected[i / 3]);
    CHECK(std::isnan(scene.list.meshes[0].positions[9][0]));  // dropped and counted by the rasterizer
    CHECK(scene.bounds.hi == strata::Vec3d{2, 8, 6});
}

TEST_CASE("vertex colours are linear and clamped and encoded once") {
    GltfFile file = numbered_vertices(3, Json::object());
    Json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["COLOR_0"] =
        file.accessor<float>("VEC3", f32, 3, {0.5f, 0, 1, 0.001f, -1, 2, 0.25f, 0.75f, 0.1f});
    const auto linear = file.load({.color_space = ColorSpace::linear}).list.meshes.at(0).colors;
    CHECK(linear.at(0) == strata::pipeline::Rgba{0.5f, 0, 1, 1});
    CHECK(linear.at(1) == strata::pipeline::Rgba{0.001f, 0, 1, 1});
    const auto scene = file.load();
    const auto encoded = scene.list.meshes.at(0).colors;
    CHECK(encoded.at(0)[0] == Approx(0.7353569830524495).margin(1e-7));  // IEC 61966-2-1 of 0.5
    CHECK(encoded.at(0)[1] == 0);
    CHECK(encoded.at(0)[2] == Approx(1).margin(1e-7));
    CHECK(encoded.at(1)[0] == Approx(0.01292).margin(1e-8));  // the linear part
    CHECK(encoded.at(2)[1] == Approx(0.8808250210903).margin(1e-7));
    CHECK(scene.warnings ==
          std::vector<std::string>{"/meshes/0/primitives/0: vertex colours outside 0 to 1 are clamped"});
}

TEST_CASE("vertex alpha counts unless the material is opaque and in every format") {
    for (const char* mode : {"OPAQUE", "BLEND", "MASK"}) {
        GltfFile file = numbered_vertices(3, {{"material", 0}});
        file.add("materials", {{"alphaMode", mode}});
        Json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
        const bool is_opaque = std::string(mode) == "OPAQUE";
        attributes["COLOR_0"] = file.accessor<std::uint8_t>("VEC4", u8, 3, {255, 0, 255, 51, 0, 0, 0, 0, 0, 0, 0, 255},
                                                            {{"normalized", true}});
        CHECK(file.load().list.meshes.at(0).colors.at(0) == strata::pipeline::Rgba{1, 0, 1, is_opaque ? 1 : 0.2f});
        attributes["COLOR_0"] = file.accessor<std::uint16_t>(
            "VEC4", u16, 3, {65535, 0, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 0}, {{"normalized", true}});
        CHECK(file.load().list.meshes.at(0).colors.at(0) == strata::pipeline::Rgba{1, 0, 0, is_opaque ? 1 : 0.2f});
    }
}

TEST_CASE("NaN and infinity are rejected in every attribute except POSITION") {
    for (const char* name : {"NORMAL", "TEXCOORD_0", "COLOR_0"})
        for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
            GltfFile file = everything();
            const bool is_texcoord = std::string(name) == "TEXCOORD_0";
            std::vector<float> values(is_texcoord ? 8 : 12, 0.0f);
            values[7] = bad;
            const int accessor = file.accessor(is_texcoord ? "VEC2" : "VEC3", f32, 4, values);
            file.json["meshes"][0]["primitives"][0]["attributes"][name] = accessor;
            const std::string message = refusal(to_bytes(file.document().dump()));
            CHECK(message.starts_with("test.gltf: /accessors/5: expected finite numbers for " + std::string(name)));
            CHECK(message.ends_with("[ACCESSOR_INVALID_FLOAT]"));
        }
}
