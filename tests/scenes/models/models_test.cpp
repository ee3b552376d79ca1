// Tests model formats on files written here; the expected numbers are those in the files.
#include "scenes/models/models.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/support/own_folder.h"

using namespace strata;
using namespace strata::scenes;
using Catch::Contains;

namespace {

std::string put(const strata::test::OwnFolder& folder, const std::string& name, const std::string& bytes) {
    const std::string path = folder.path() + "/" + name;
    std::ofstream{path, std::ios::binary} << bytes;
    return path;
}

const std::string obj = "v -1 -1 0.1\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
const std::string off = "OFF\n3 1 0\n-1 -1 0.1\n1 -1 0\n0 1 0\n3 0 1 2\n";
const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
    "1\nproperty list "
    "uchar int vertex_indices\nend_header\n-1 -1 0.1\n1 -1 0\n0 1 0\n3 0 1 2\n";
const std::string stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 0.1\nvertex 1 -1 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid a\n";

// A material with a colour, one with opacity, one that is unlit and textured.
const std::string mtl =
    "newmtl wall\nKd 0.2 0.4 0.6\nillum 2\nnewmtl pane\nKd 1 0 0\nd 0.25\nillum 2\nnewmtl sign\nKd 1 1 1\nillum "
    "0\nmap_Kd sign.bmp\n";

// What a model of these bytes is refused with, without the folder; "none" if it is read.
std::string message_of(const strata::test::OwnFolder& folder, const std::string& name, const std::string& bytes) {
    try {
        static_cast<void>(load_scene(put(folder, name, bytes), {}));
        return "none";
    } catch (const InputError& error) {
        return std::string{error.what()}.substr(folder.path().size() + 1);
    }
}

}  // namespace

TEST_CASE("one triangle in any model format has the positions of the file and is opaque and lit and two-sided") {
    const strata::test::OwnFolder folder;
    for (const auto& [name, bytes] :
         {std::pair{"a.obj", obj}, {"a.off", off}, {"a.ply", ply}, {"a.stl", stl}, {"B.OBJ", obj}}) {
        INFO(name);
        const Scene scene = load_scene(put(folder, name, bytes), {});
        CHECK(scene.name == name);
        REQUIRE(scene.list.meshes.size() == 1);
        const pipeline::Mesh& mesh = scene.list.meshes[0];
        REQUIRE(mesh.indices.size() == 3);
        const Vec3 a = mesh.positions.at(mesh.indices[0]), b = mesh.positions.at(mesh.indices[1]),
                   c = mesh.positions.at(mesh.indices[2]);
        CHECK((a == Vec3{-1, -1, 0.1f} && b == Vec3{1, -1, 0} && c == Vec3{0, 1, 0}));
        CHECK(mesh.normals.size() == mesh.positions.size());
        const pipeline::Material& material = scene.list.materials.at(scene.list.instances.at(0).material);
        CHECK(material.front == Rgba{1, 1, 1, 1});
        CHECK(material.alpha_mode == pipeline::AlphaMode::opaque);
        CHECK(material.double_sided);
        CHECK_FALSE(material.unlit);
        CHECK(scene.bounds.hi[2] == Approx(0.1));
    }
}

// The positions of the primitives of one kind, x alone.
std::vector<float> corners_of(const Scene& scene, pipeline::Primitive primitive) {
    std::vector<float> corners;
    for (const pipeline::Mesh& mesh : scene.list.meshes)
        for (const std::uint32_t index : mesh.indices)
            if (mesh.primitive == primitive) corners.push_back(mesh.positions.at(index)[0]);
    return corners;
}

TEST_CASE("polygons are split into triangles and lines and points have meshes of their own") {
    using enum pipeline::Primitive;
    const strata::test::OwnFolder folder;
    const Scene scene =
        load_scene(put(folder, "q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nl 1 5 2\np 5\n"), {});
    CHECK(corners_of(scene, triangles).size() == 6);
    CHECK(corners_of(scene, lines) == std::vector<float>{0, 0, 2, 2, 2, 1});
    CHECK(corners_of(scene, points) == std::vector<float>{2, 2, 2});
    const Scene cloud =
        load_scene(put(folder, "c.ply",
                       "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                       "end_header\n3 0 0\n4 1 0\n"),
                   {});
    CHECK(corners_of(cloud, points) == std::vector<float>{3, 3, 3, 4, 4, 4});
}

TEST_CASE("edges of a PLY file are reported and vertices of an OBJ file without a colour are white") {
    const strata::test::OwnFolder folder;
    const Scene edges =
        load_scene(put(folder, "e.ply",
                       "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                       "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n3 0 0\n4 1 0\n0 1\n"),
                   {});
    REQUIRE(edges.warnings.size() == 1);
    CHECK(edges.warnings[0] == "its 1 edges are not drawn: of a PLY file only vertices and faces are read");
    const Scene some =
        load_scene(put(folder, "s.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nv 1 1 0\nl 1 2\nl 3 4\n"), {});
    const pipeline::Mesh& mesh = some.list.meshes.at(0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        CHECK(mesh.colors.at(i) == (mesh.positions[i][1] == 0 ? Rgba{1, 0, 0, 1} : Rgba{1, 1, 1, 1}));
    CHECK(some.list.materials.at(0).alpha_mode == pipeline::AlphaMode::opaque);
}

TEST_CASE("materials of an OBJ file keep their properties and unsupported features are reported") {
    const strata::test::OwnFolder folder;
    put(folder, "room.mtl", mtl);
    const Scene scene =
        load_scene(put(folder, "room.obj",
                       "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 0.25\nusemtl wall\nf 1 2 3\n"
                       "usemtl pane\nf 3 2 1\nusemtl sign\nf 1/1 2/2 3/3\n"),
                   {});
    const auto material = [&](const std::string& name) {
        const auto found = std::ranges::find(scene.list.materials, name, &pipeline::Material::name);
        REQUIRE(found != scene.list.materials.end());
        return *found;
    };
    CHECK(material("wall").front == Rgba{0.2f, 0.4f, 0.6f, 1});
    CHECK(material("pane").front == Rgba{1, 0, 0, 0.25f});
    CHECK(material("pane").alpha_mode == pipeline::AlphaMode::blend);
    CHECK(material("sign").unlit);
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], Contains("sign.bmp") && Contains("no file of that name in the model's folder"));
    put(folder, "sign.bmp", "BM");
    CHECK_THAT(load_scene(folder.path() + "/room.obj", {}).warnings.at(0), Contains("neither PNG nor JPEG"));
    const Scene blended = load_scene(folder.path() + "/room.obj", {.alpha = {{"wall", 0.5f}}});
    const auto wall = std::ranges::find(blended.list.materials, "wall", &pipeline::Material::name);
    CHECK(wall->alpha_mode == pipeline::AlphaMode::blend);
    CHECK(wall->front[3] == 0.5f);
}

TEST_CASE("vertex colours of a PLY file are drawn and a colour with alpha below 1 makes it blended") {
    const strata::test::OwnFolder folder;
    std::string colored = ply;
    colored.replace(colored.find("element face"), 0,
                    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n");
    for (const char* corner : {"-1 -1 0.1\n", "1 -1 0\n", "0 1 0\n"}) {
        const std::size_t at = colored.find(corner) + std::strlen(corner) - 1;
        colored.replace(at, 0, " 255 0 51 102");
    }
    const Scene scene = load_scene(put(folder, "c.ply", colored), {});
    const pipeline::Mesh& mesh = scene.list.meshes.at(0);
    REQUIRE(mesh.colors.size() == mesh.positions.size());
    CHECK(mesh.colors[0] == Rgba{1, 0, 0.2f, 0.4f});
    CHECK(scene.list.materials.at(0).alpha_mode == pipeline::AlphaMode::blend);
}

TEST_CASE("a file that is not a model or of another format is rejected with an error message") {
    const strata::test::OwnFolder folder;
    CHECK_THROWS_WITH(load_scene(put(folder, "a.ply", "ply\nend_header\nnothing"), {}),
                      Contains("a.ply: content: expected a model that Assimp can read"));
    CHECK_THROWS_WITH(load_scene(put(folder, "b.obj",
                                     "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, 'a') +
                                         "\nsize 12\n"),
                                 {}),
                      Contains("b.obj: a Git LFS pointer, run git lfs pull"));
    CHECK_THROWS_WITH(load_scene(folder.path() + "/none.stl", {}), Contains("none.stl"));
    CHECK_THROWS_WITH(load_scene("house.fbx", {}), Contains("assimp export MODEL MODEL.glb"));
    CHECK_THROWS_WITH(load_scene(put(folder, "c.obj", obj), {.scene = 1}),
                      Contains("--scene: expected 0, the only one"));
}

// A model refers to other files: only those in its folder are read.
TEST_CASE("files outside of its folder that a model names are not opened") {
    const strata::test::OwnFolder outside, folder;
    put(outside, "far.mtl", mtl);
    const std::string name = std::filesystem::relative(outside.path(), folder.path()).string() + "/far.mtl";
    const Scene scene = load_scene(put(folder, "a.obj", "mtllib " + name + "\nusemtl wall\n" + obj), {});
    for (const pipeline::Material& material : scene.list.materials) CHECK(material.front == Rgba{1, 1, 1, 1});
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], Contains("its materials are drawn white") && Contains("far.mtl'"));
}

TEST_CASE("a fault of a file that a model names is reported as a fault of the model") {
    const strata::test::OwnFolder folder;
    put(folder, "walls.mtl", "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, 'a') + "\n");
    CHECK_THROWS_WITH(load_scene(put(folder, "a.obj", "mtllib walls.mtl\nusemtl wall\n" + obj), {}),
                      Contains("walls.mtl: a Git LFS pointer, run git lfs pull"));
}

TEST_CASE("a PLY or OFF file that claims more than its bytes hold is refused before memory is reserved") {
    const strata::test::OwnFolder folder;
    const auto message = [&](const std::string& name, const std::string& bytes) {
        return message_of(folder, name, bytes);
    };
    const auto with = [](std::string text, const std::string& before, const std::string& after) {
        return text.replace(text.find(before), before.size(), after);
    };
    const std::string bytes = std::to_string(ply.size() + 9);
    CHECK(message("a.ply", with(ply, "vertex 3", "vertex 2000000000")) ==
          "a.ply: line 3: expected a count of at most " + bytes + ", the file's bytes, found '2000000000'");
    CHECK_THAT(message("b.ply", "ply\nformat ascii 1.0\nelement vertex\n"),
               Contains("line 3: ") && Contains("found none"));
    CHECK(message("c.ply", with(ply, "vertex 3", "vertex 6")) ==
          "c.ply: element vertex: expected 6 elements, found the values of 4");
    CHECK(message("d.ply", with(ply, "\n3 0 1 2", "\n2000000000 0 1 2")) ==
          "d.ply: element face: expected 1 elements, found the values of 0");
    const std::string header = with(ply.substr(0, ply.find("-1 -1")), "ascii", "binary_big_endian");
    const std::string vertices(36, '\0');
    const std::string face = header + vertices + std::string{'\3', 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2};
    CHECK(message("e.ply", face) == "none");
    CHECK(message("f.ply", with(face, "uchar int", "int int")) ==
          "f.ply: element face: expected 1 elements, found the values of 0");
    CHECK(message("g.ply", face.substr(0, face.size() - 1)) ==
          "g.ply: element face: expected 1 elements, found the values of 0");
    CHECK_THAT(message("a.off", with(off, "3 1 0", "3 99999999 0")), Contains("faces: ") && Contains("'99999999'"));
    CHECK_THAT(message("b.off", with(off, "3 1 0", "# 9\n-1 1 0")), Contains("vertices: ") && Contains("'-1'"));
}

TEST_CASE("an empty model, a PLY file cut off in its header and an OFF file with other corners are refused") {
    const strata::test::OwnFolder folder;
    const auto message = [&](const std::string& name, const std::string& bytes) {
        return message_of(folder, name, bytes);
    };
    for (const std::string name : {"e.ply", "e.obj", "e.stl", "e.off"})
        CHECK(message(name, "") == name + ": size: expected a model, found an empty file");
    for (std::size_t length = 1; length < ply.find("end_header"); ++length)
        CHECK(message("cut.ply", ply.substr(0, length)).starts_with("cut.ply: "));
    const auto with_face = [&](const std::string& face) { return off.substr(0, off.find("3 0 1 2")) + face + "\n"; };
    CHECK(message("a.off", with_face("3 0 1 2")) == "none");
    CHECK(message("a.off", with_face("3 0 1 2 0.5 0.5 0.5")) == "none");
    CHECK(message("a.off", with_face("3 0 1 3")) ==
          "a.off: line 6: expected the number of a vertex below 3, found '3'");
    CHECK(message("a.off", with_face("3 0 1 -1")) ==
          "a.off: line 6: expected the number of a vertex below 3, found '-1'");
    CHECK(
        message("a.off", with_face("2000000000 0 1 2")) ==
        "a.off: line 6: expected the number of a face's corners and their vertices, found '2000000000' and 3 numbers");
    CHECK(message("a.off", "OFF # of\n\n3 1\n0 0 0\n1 0 0\n") == "a.off: vertices: expected 3 lines, found 2");
    CHECK(message("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n# up\n0 1 0\n") == "a.off: faces: expected 1 lines, found 0");
}
