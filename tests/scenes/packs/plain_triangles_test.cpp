// Tests triangles from plain files; the expected numbers are those written.
#include "scenes/packs/plain_triangles.h"

#include <bit>
#include <catch2/catch.hpp>
#include <fstream>

#include "scenes/packs/npy.h"
#include "tests/support/own_folder.h"

using namespace strata;
using namespace strata::scenes;

namespace {

std::string written(const strata::test::OwnFolder& folder, const std::string& name, const std::string& bytes) {
    const std::string path = folder.path() + "/" + name;
    std::ofstream{path, std::ios::binary} << bytes;
    return path;
}

std::string triangles_npy(std::vector<std::size_t> shape) {
    NumberArray array{.element = Element::f4, .shape = std::move(shape)};
    for (std::size_t i = 0; i < array.count(); ++i)
        array.append(std::bit_cast<std::uint32_t>(static_cast<float>(i) / 32.0f));
    return to_npy(array);
}

}  // namespace

TEST_CASE("an array of corners is told from a picture by its shape and its element") {
    const strata::test::OwnFolder folder;
    CHECK(is_array_of_triangles(written(folder, "a.npy", triangles_npy({2, 3, 7}))));
    CHECK(is_array_of_triangles(written(folder, "b.npy", triangles_npy({1, 3, 4}))));
    CHECK_FALSE(is_array_of_triangles(written(folder, "c.npy", triangles_npy({48, 64, 4}))));
    CHECK_FALSE(is_array_of_triangles(written(folder, "d.npy", triangles_npy({2, 3, 5}))));
    CHECK_FALSE(is_array_of_triangles(written(folder, "e.npy", "no array")));
    CHECK_FALSE(is_array_of_triangles(folder.path() + "/missing.npy"));
    CHECK_FALSE(is_array_of_triangles(folder.path()));
}

TEST_CASE("triangles are read from a .npy file with their numbers unchanged") {
    const strata::test::OwnFolder folder;
    const Scene plain = load_scene(written(folder, "a.npy", triangles_npy({2, 3, 3})), {});
    const pipeline::Mesh& mesh = plain.list.meshes.at(0);
    REQUIRE(mesh.positions.size() == 6);
    CHECK((mesh.positions[5][0] == 15 / 32.0f && mesh.positions[5][2] == 17 / 32.0f));
    CHECK((mesh.colors[3] == Rgba{1, 1, 1, 0.5f}));
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
    CHECK(plain.name == "a");
    CHECK_FALSE(plain.own_view);
    const Scene colored = load_scene(written(folder, "b.npy", triangles_npy({1, 3, 7})), {});
    CHECK((colored.list.meshes[0].colors[1] == Rgba{10 / 32.0f, 11 / 32.0f, 12 / 32.0f, 13 / 32.0f}));
    CHECK(load_scene(written(folder, "c.npy", triangles_npy({0, 3, 3})), {}).bounds.is_empty());
    for (const std::vector<std::size_t>& shape : {std::vector<std::size_t>{3, 3}, {1, 3, 5}, {1, 3, 6}, {1, 4, 3}, {9}})
        CHECK_THROWS_WITH(load_scene(written(folder, "d.npy", triangles_npy(shape)), {}),
                          Catch::Contains("d.npy: array: expected f4 of shape (triangles, 3, N): N = 3 is x y z"));
}

TEST_CASE("triangles with w are in clip space and drawn unchanged unless a view is named") {
    const strata::test::OwnFolder folder;
    const Scene plain = load_scene(written(folder, "a.npy", triangles_npy({1, 3, 4})), {});
    const pipeline::Mesh& mesh = plain.list.meshes.at(0);
    CHECK((mesh.positions[1] == Vec3{4 / 32.0f, 5 / 32.0f, 6 / 32.0f}));
    CHECK(mesh.w == std::vector<float>{3 / 32.0f, 7 / 32.0f, 11 / 32.0f});
    REQUIRE(plain.own_view);
    CHECK(plain.own_view->projection == pipeline::View{}.projection);
    const Scene colored = load_scene(written(folder, "b.npy", triangles_npy({1, 3, 8})), {});
    CHECK(colored.list.meshes[0].w[1] == 11 / 32.0f);
    CHECK((colored.list.meshes[0].colors[1] == Rgba{12 / 32.0f, 13 / 32.0f, 14 / 32.0f, 15 / 32.0f}));
    const Scene typed =
        load_scene(written(folder, "c.json", R"({"positions": [[0, 1, 2, 3], [4, 5, 6, 7], [8, 9, 10, 11]]})"), {});
    CHECK(typed.list.meshes.at(0).w == std::vector<float>{3, 7, 11});
    CHECK(typed.own_view);
    CHECK_THROWS_WITH(
        load_scene(written(folder, "d.json", R"({"positions": [[0, 0, 0, 1], [1, 0, 0], [0, 1, 0, 1]]})"), {}),
        Catch::Contains("/positions/1: expected an array of 4 numbers"));
}

TEST_CASE("triangles are read from a .json file with a view if it has one") {
    const strata::test::OwnFolder folder;
    const Scene scene = load_scene(
        written(folder, "t.json",
                R"({"positions": [[0, 0, 0.1], [1, 0, 0], [0, 1, 0], [1, 1, 0]], "indices": [[0, 1, 2], [2, 1, 3]],
                    "colors": [[1, 0, 0, 0.5], [0, 1, 0, 1], [0, 0, 1, 0.25], [0, 0, 0, 0]],
                    "view": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,-3,1], "projection": [1,0,0,0, 0,1,0,0, 0,0,-1,-1, 0,0,-0.5,0]})"),
        {});
    const pipeline::Mesh& mesh = scene.list.meshes.at(0);
    CHECK(mesh.positions[0][2] == 0.1f);
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3});
    CHECK((mesh.colors[2] == Rgba{0, 0, 1, 0.25f}));
    REQUIRE(scene.own_view);
    CHECK((scene.own_view->view[3][2] == -3 && scene.own_view->projection[2][3] == -1));
    const auto fails = [&](const std::string& text, const std::string& message) {
        INFO(text);
        CHECK_THROWS_WITH(load_scene(written(folder, "x.json", text), {}), Catch::Contains(message));
    };
    fails("[]", "x.json: /: expected an object");
    fails("{}", "the key 'positions'");
    fails(R"({"positions": [[0, 0]]})", "x.json: /positions/0: expected an array of 3 numbers, found an array of 2");
    fails(R"({"positions": [[0, 0, 1e39]]})",
          "/positions/0/2: expected a number in the range of binary32, found 1e+39");
    fails(R"({"positions": [[0, 0, "1"]]})", "/positions/0/2: expected a number in the range of binary32, found \"1\"");
    fails(R"({"positions": [[0, 0, 1]], "colors": []})", "/colors: expected 1 colours, one per position, found 0");
    fails(R"({"positions": [[0, 0, 1]], "indices": [[0, 1, 2]]})", "indices");
    fails(R"({"positions": [[0, 0, 1]], "indices": [[0, -1, 2]]})",
          "/indices/0/1: expected a whole number from 0 to 4294967295, found -1");
    fails(R"({"positions": [[0, 0, 1]], "indices": [[0], [1]]})",
          "x.json: /indices/1/0: expected less than 1, the number of positions, found 1");
    fails(R"({"positions": [[0, 0, 1]]})", "/positions: expected three per triangle, as there are no indices, found 1");
    fails(R"({"positions": [], "colours": []})",
          "x.json: /: expected only the keys colors, indices, positions, projection, view, found 'colours'");
    fails(R"({"positions": [], "view": [1]})", "/view: expected an array of 16 numbers, found an array of 1");
}

TEST_CASE("rows of two indices are lines and of one points") {
    const strata::test::OwnFolder folder;
    const std::string positions = R"({"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "indices": )";
    const auto mesh = [&](const std::string& rows) {
        return load_scene(written(folder, "t.json", positions + rows + "}"), {}).list.meshes.at(0);
    };
    CHECK(mesh("[[0, 1], [1, 2]]").primitive == pipeline::Primitive::lines);
    CHECK(mesh("[[0, 1], [1, 2]]").indices == std::vector<std::uint32_t>{0, 0, 1, 1, 1, 2});
    CHECK(mesh("[[2], [0]]").primitive == pipeline::Primitive::points);
    CHECK(mesh("[[2], [0]]").indices == std::vector<std::uint32_t>{2, 2, 2, 0, 0, 0});
    CHECK(mesh("[]").primitive == pipeline::Primitive::triangles);
    CHECK_THROWS_WITH(mesh("[[0, 1], [2]]"), Catch::Contains("/indices/1: expected an array of 2 numbers"));
    CHECK_THROWS_WITH(mesh("[[0, 1, 2, 0]]"),
                      Catch::Contains("/indices/0: expected an array of 1, 2 or 3 numbers, found one of 4"));
}
