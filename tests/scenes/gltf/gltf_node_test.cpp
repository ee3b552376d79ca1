// Tests glTF nodes against transforms worked out by hand. A camera's view is checked by the images of points of its own
// frame.
#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "tests/scenes/gltf/gltf_file.h"
#include "tests/scenes/scenes_support.h"

namespace {

using namespace strata::scenes::test;
using strata::pipeline::Matrix;
using Point = std::array<double, 3>;

Point transformed(const Matrix& m, const Point& p) {
    Point q{};
    for (std::size_t r = 0; r < 3; ++r) q[r] = m[0][r] * p[0] + m[1][r] * p[1] + m[2][r] * p[2] + m[3][r];
    return q;
}

void check_near(const Point& found, const Point& expected) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(found[i] == Approx(expected[i]).margin(1e-14));
}

GltfFile triangle(Json node) {
    GltfFile file;
    const int mesh = file.add(
        "meshes",
        {{"primitives", Json::array({{{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}})}});
    node["mesh"] = mesh;
    file.show_node(node);
    return file;
}

double determinant_of(const Matrix& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[1][0] * (m[0][1] * m[2][2] - m[0][2] * m[2][1]) +
           m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]);
}

const double half = 0.7071067811865476;  // sine and cosine of half a right angle

}  // namespace

TEST_CASE("a node scales then rotates then translates and a parent's transform is applied last") {
    GltfFile file = triangle({{"translation", {10, 0, 0}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}});
    const Matrix own = file.load().list.instances.at(0).model;
    check_near(transformed(own, {1, 0, 0}), {10, 2, 0});
    check_near(transformed(own, {0, 1, 0}), {7, 0, 0});
    check_near(transformed(own, {0, 0, 1}), {10, 0, 4});
    file.json["scenes"][0]["nodes"] = {1};
    file.add("nodes", {{"children", {0}}, {"rotation", {half, 0, 0, half}}, {"translation", {0, 0, 5}}});
    const Matrix below = file.load().list.instances.at(0).model;
    check_near(transformed(below, {1, 0, 0}), {10, 0, 7});
    check_near(transformed(below, {0, 0, 1}), {10, -4, 5});
}

TEST_CASE("a matrix is read as written column by column and a mirroring one stays so") {
    const Json matrix{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, -10, 0, 11, 12, 13, 1};
    CHECK(triangle({{"matrix", matrix}}).load().list.instances.at(0).model ==
          strata::matrix_of(matrix.get<std::array<double, 16>>()));
    const auto mirrored = triangle({{"scale", {-1, 1, 1}}}).load();
    CHECK(determinant_of(mirrored.list.instances.at(0).model) == -1);
    CHECK(mirrored.bounds.lo == strata::Vec3d{-1, 0, 0});
    CHECK(mirrored.bounds.hi == strata::Vec3d{0, 1, 0});
}

TEST_CASE("a mesh of two nodes is stored once and instances keep the order of the traversal") {
    GltfFile file = triangle({{"translation", {1, 0, 0}}});
    file.show_node({{"children", {2, 3}}});
    file.add("nodes", {{"mesh", 0}, {"translation", {2, 0, 0}}});
    file.add("nodes", {{"mesh", 0}, {"translation", {3, 0, 0}}});
    file.show_node({{"mesh", 0}, {"translation", {4, 0, 0}}});
    const auto list = file.load().list;
    CHECK(list.meshes.size() == 1);
    REQUIRE(list.instances.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(list.instances[i].model[3][0] == static_cast<double>(i + 1));
}

TEST_CASE("nodes may nest 100000 deep and a transform that overflows is rejected") {
    GltfFile file = triangle({{"translation", {1, 0, 0}}});
    for (int i = 1; i <= 100000; ++i) file.add("nodes", {{"children", {i - 1}}, {"translation", {1, 0, 0}}});
    file.json["scenes"][0]["nodes"] = {100000};
    CHECK(file.load().list.instances.at(0).model[3][0] == 100001);
    GltfFile large = triangle({{"scale", {1e308, 1, 1}}});
    large.json["scenes"][0]["nodes"] = {1};
    large.add("nodes", {{"children", {0}}, {"scale", {1e308, 1, 1}}});
    CHECK(refusal(to_bytes(large.document().dump())) ==
          "test.gltf: /nodes/0: expected a finite world transform, found an overflow [VALUE_NOT_IN_RANGE]");
}

TEST_CASE("the scene is that of --scene or else the file's own or the first and without scenes all nodes are used") {
    GltfFile file = triangle({{"translation", {1, 0, 0}}});
    file.add("nodes", {{"mesh", 0}, {"translation", {2, 0, 0}}});
    file.add("scenes", {{"nodes", {1}}});
    const auto x = [&](const strata::scenes::SceneOptions& options) {
        return file.load(options).list.instances.at(0).model[3][0];
    };
    CHECK(x({}) == 1);
    CHECK(x({.scene = 1}) == 2);
    file.json["scene"] = 1;
    CHECK(x({}) == 2);
    CHECK(x({.scene = 0}) == 1);
    CHECK(file.load().scene_count == 2);
    CHECK(file.load().scene_index == 1);
    for (const int bad : {-1, 2}) CHECK_THROWS_AS(file.load({.scene = bad}), strata::InputError);
    file.json.erase("scene");
    file.json.erase("scenes");
    CHECK(file.load().list.instances.size() == 2);
    CHECK(file.load().warnings == std::vector<std::string>{"/scenes: the file has no scene: all its nodes are shown"});
}

TEST_CASE("an instance that a scale of 0 makes a line or a point is reported and a flat one is not") {
    const strata::test::TemporaryFolder folder;
    const auto warnings = [&](const Json& scale) {
        std::ofstream{folder / "a.gltf"} << triangle({{"scale", scale}}).document().dump();
        return load_scene(folder / "a.gltf", {}).warnings;
    };
    for (const Json& scale : {Json{0, 0, 0}, Json{2, 0, 0}, Json{0, 0, -1}})
        CHECK(warnings(scale) ==
              std::vector{folder / "a.gltf" + ": 1 of 1 instances have a scale of 0 and are not drawn; the first is "
                                              "instance 0, mesh 'mesh 0'"});
    for (const Json& scale : {Json{1, 1, 0}, Json{1e-30, 1e-30, 1e-30}}) CHECK(warnings(scale).empty());
}

TEST_CASE("a camera looks along its node's -z for any scale or mirroring of the node") {
    for (const Json& scale : {Json{1, 1, 1}, Json{2, 3, 4}, Json{-1, 1, 1}, Json{-2, -3, 5}}) {
        GltfFile file;
        file.add("cameras", {{"name", "front"},
                             {"type", "perspective"},
                             {"perspective", {{"yfov", 0.5}, {"znear", 1}, {"aspectRatio", 2}}}});
        file.show_node({{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}, {"scale", scale}});
        const auto camera = file.load().cameras.at(0);
        CHECK(camera.name == "front");
        CHECK(
            (camera.perspective && camera.yfov == 0.5 && camera.znear == 1 && camera.zfar == 0 && camera.aspect == 2));
        CHECK(determinant_of(camera.view) == Approx(1));
        check_near(transformed(camera.view, {1, 2, 3}), {0, 0, 0});
        // Rotated by a right angle about y, -z is -x. A negative scale of x reverses "right", and with it "up".
        const double side = scale[0] < 0 ? -1 : 1;
        check_near(transformed(camera.view, {-4, 2, 3}), {0, 0, -5});
        check_near(transformed(camera.view, {1, 2, 2}), {side, 0, 0});
    }
}

TEST_CASE("an orthographic camera keeps its magnifications and names are made unique") {
    GltfFile file;
    file.add("cameras",
             {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", -3}, {"znear", 0}, {"zfar", 9}}}});
    for (int i = 0; i < 2; ++i) file.show_node({{"camera", 0}, {"name", "side"}});
    file.show_node({{"camera", 0}});
    const auto cameras = file.load().cameras;
    REQUIRE(cameras.size() == 3);
    CHECK((!cameras[0].perspective && cameras[0].xmag == 2 && cameras[0].ymag == -3 && cameras[0].znear == 0 &&
           cameras[0].zfar == 9));
    CHECK(cameras[0].name == "side");
    CHECK(cameras[1].name == "side#2");
    CHECK(cameras[2].name == "camera");
}

TEST_CASE("every camera has a unique name even if a file uses a name that another one was given") {
    const auto names_of = [](const std::vector<std::string>& written) {
        GltfFile file;
        file.add("cameras",
                 {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}});
        for (const std::string& name : written) file.show_node({{"camera", 0}, {"name", name}});
        std::vector<std::string> names;
        for (const auto& camera : file.load().cameras) names.push_back(camera.name);
        return names;
    };
    using Names = std::vector<std::string>;
    CHECK(names_of({"cam", "cam", "cam#2"}) == Names{"cam", "cam#2", "cam#2#2"});
    CHECK(names_of({"cam#2", "cam", "cam", "cam"}) == Names{"cam#2", "cam", "cam#3", "cam#4"});
    CHECK(names_of({"cam", "cam#2", "cam#3", "cam", "cam#2"}) == Names{"cam", "cam#2", "cam#3", "cam#4", "cam#2#2"});
}
