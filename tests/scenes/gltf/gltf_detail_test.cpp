// Tests single statements of glTF 2.0 with one small file each. The frames of cameras are checked for right angles.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "scenes/gltf/check.h"
#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
using strata::pipeline::Matrix;

std::string refused(const GltfFile& file) { return refusal(to_bytes(file.document().dump())); }

// The error message for everything() with one value replaced at a JSON pointer.
std::string refused_with(const char* pointer, const Json& value) {
    GltfFile file = everything();
    file.json[Json::json_pointer(pointer)] = value;
    return refused(file);
}

Json rotation_of_length(double length) { return {0.6 * length, 0, 0, 0.8 * length}; }

double along(const Matrix& m, std::size_t a, std::size_t b) {  // dot product of two rows of a view
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += m[c][a] * m[c][b];
    return sum;
}

}  // namespace

TEST_CASE("a rotation may deviate from unit length by 0.00769 and more is rejected") {
    for (const double off : {0.0, 0.00768, -0.00768})
        CHECK(refused_with("/nodes/0/rotation", rotation_of_length(1 + off)) == "");
    for (const double off : {0.0077, -0.0077, 1.0, -1.0})
        CHECK_THAT(refused_with("/nodes/0/rotation", rotation_of_length(1 + off)),
                   Catch::StartsWith("test.gltf: /nodes/0/rotation: expected a quaternion of length 1, found ") &&
                       Catch::EndsWith("[NODE_ROTATION_NON_UNIT]"));
}

TEST_CASE("a camera's angle must be below pi and its far plane behind the near one") {
    const char *const yfov = "/cameras/0/perspective/yfov", *const zfar = "/cameras/0/perspective/zfar",
                      *const flat_far = "/cameras/1/orthographic/zfar";
    const double pi = std::acos(-1.0);
    CHECK(refused_with(yfov, std::nextafter(pi, 0)) == "");
    CHECK_THAT(refused_with(yfov, pi), Catch::Contains("/cameras/0/perspective/yfov: expected an angle below pi"));
    CHECK_THAT(refused_with(yfov, 0), Catch::Contains("expected a number above 0"));
    CHECK(refused_with(zfar, std::nextafter(1.0, 2.0)) == "");
    CHECK_THAT(refused_with(zfar, 1), Catch::EndsWith("[CAMERA_ZFAR_LEQUAL_ZNEAR]"));
    CHECK(refused_with(flat_far, 1e-300) == "");
    CHECK_THAT(refused_with(flat_far, 0), Catch::EndsWith("[CAMERA_ZFAR_LEQUAL_ZNEAR]"));
    CHECK_THAT(refused_with("/cameras/1/orthographic/znear", -1e-300), Catch::EndsWith("[VALUE_NOT_IN_RANGE]"));
    CHECK_THAT(refused_with("/cameras/1/orthographic/ymag", 0), Catch::EndsWith("[CAMERA_XMAG_YMAG_ZERO]"));
}

TEST_CASE("nodes that are their own ancestors are found in cycles of every length") {
    for (std::size_t length = 1; length <= 5; ++length) {
        GltfFile file = everything();
        const std::size_t first = file.json["nodes"].size();
        for (std::size_t i = 0; i < length; ++i) file.add("nodes", {{"children", {first + (i + 1) % length}}});
        CHECK_THAT(refused(file), Catch::EndsWith("[NODE_LOOP]"));
        file.json["nodes"][first + length - 1].erase("children");  // now a chain without a cycle
        if (length > 1) CHECK(refused(file) == "");
    }
}

TEST_CASE("a camera's frame is orthonormal for any shear and scale and mirroring of its node") {
    std::mt19937_64 random{31};
    std::uniform_real_distribution<double> unit{-1, 1};
    std::string wrong;
    for (int i = 0; i < 60; ++i) {
        Json matrix = Json::array();
        std::array<double, 16> m{};
        for (std::size_t k = 0; k < 16; ++k) m[k] = k % 4 == 3 ? (k == 15 ? 1 : 0) : unit(random) * std::exp2(i % 7);
        for (const double value : m) matrix.push_back(value);
        GltfFile file;
        file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
        file.show_node({{"camera", 0}, {"matrix", matrix}});
        const Matrix view = file.load().cameras.at(0).view;
        bool right = true;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
                right = right && std::fabs(along(view, a, b) - (a == b ? 1 : 0)) < 1e-12;
        const double z_length = std::hypot(m[8], m[9], m[10]);
        double x_right = 0, x_up = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            right = right && std::fabs(view[c][2] - m[8 + c] / z_length) < 1e-12;  // its z is the node's
            x_right += view[c][0] * m[c];
            x_up += view[c][1] * m[c];
        }
        right = right && x_right > 0 && std::fabs(x_up) < 1e-9;  // its x is in the plane of the node's x and z
        for (std::size_t r = 0; r < 3; ++r) {
            const double eye = view[0][r] * m[12] + view[1][r] * m[13] + view[2][r] * m[14] + view[3][r];
            right = right && std::fabs(eye) < 1e-9;
        }
        if (!right && wrong.empty()) wrong = matrix.dump();
    }
    CHECK(wrong == "");
}

TEST_CASE("a cutoff above 1 stays above 1 so that nothing passes and is at most 2") {
    for (const auto& [written, loaded] : {std::pair{0.0, 0.0f}, {1.0, 1.0f}, {1.5, 1.5f}, {2.0, 2.0f}, {1e300, 2.0f}}) {
        GltfFile file = everything();
        file.json["materials"][0]["alphaMode"] = "MASK";
        file.json["materials"][0]["alphaCutoff"] = written;
        CHECK(file.load().list.materials.at(0).alpha_cutoff == loaded);
    }
}

TEST_CASE("a material is reported as invisible only if its factor alone keeps it from being drawn") {
    const auto is_reported = [](const char* mode, double alpha, double cutoff) {
        GltfFile file = everything();
        file.json["materials"][0]["alphaMode"] = mode;
        file.json["materials"][0]["alphaCutoff"] = cutoff;
        file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, alpha};
        return !file.load().warnings.empty();
    };
    CHECK_FALSE(is_reported("MASK", 0.5, 0.5));  // the test is >=
    CHECK(is_reported("MASK", 0.4999, 0.5));
    CHECK_FALSE(is_reported("MASK", 0, 0));
    CHECK(is_reported("BLEND", 0, 0));
    CHECK_FALSE(is_reported("BLEND", 1e-45, 0.5));
    CHECK_FALSE(is_reported("OPAQUE", 0, 0.5));
}

TEST_CASE("materials of equal coverage share a texture and an opaque one has its own because its alpha is 1") {
    GltfFile file = everything();
    Json primitive = file.json["meshes"][0]["primitives"][0];
    for (const char* mode : {"MASK", "OPAQUE", "OPAQUE"}) {
        Json material = file.json["materials"][0];
        material["alphaMode"] = mode;
        primitive["material"] = file.add("materials", material);
        file.json["meshes"][0]["primitives"].push_back(primitive);
    }
    const auto list = file.load().list;
    REQUIRE(list.textures.size() == 2);
    CHECK(list.textures[0].texels == std::vector<std::uint8_t>{10, 20, 30, 40});
    CHECK(list.textures[1].texels == std::vector<std::uint8_t>{10, 20, 30, 255});
    REQUIRE(list.materials.size() == 4);
    const int expected[] = {0, 0, 1, 1};
    for (std::size_t i = 0; i < 4; ++i) CHECK(list.materials[i].texture == expected[i]);
}

TEST_CASE("objects without names are numbered and a texture takes its image's name") {
    GltfFile file = everything();
    file.json["images"][0]["name"] = "leaf.png";
    Json primitive = file.json["meshes"][0]["primitives"][0];
    const auto list = file.load().list;
    CHECK(list.meshes.at(0).name == "mesh 0");
    CHECK(list.materials.at(0).name == "material 0");
    CHECK(list.textures.at(0).name == "leaf.png");
    file.json["textures"][0]["name"] = "leaf";
    file.json["materials"][0]["name"] = "green";
    file.json["meshes"][0]["name"] = "tree";
    file.json["meshes"][0]["primitives"].push_back(primitive);
    const auto named = file.load().list;
    CHECK(named.meshes.at(0).name == "tree/0");
    CHECK(named.meshes.at(1).name == "tree/1");
    CHECK(named.materials.at(0).name == "green");
    CHECK(named.textures.at(0).name == "leaf");
    CHECK(named.instances.size() == 2);
}

TEST_CASE("colours of exactly 0 and 1 are in range and the next numbers beyond are clamped with a warning") {
    for (const float color : {0.0f, 1.0f, std::nextafter(1.0f, 2.0f), -0x1p-149f}) {
        GltfFile file = everything();
        file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
            file.accessor<float>("VEC3", f32, 4, std::vector<float>(12, color));
        const auto scene = file.load();
        const bool is_beyond = color < 0 || color > 1;
        CHECK(scene.warnings.size() == (is_beyond ? 1u : 0u));
        CHECK(scene.list.meshes.at(0).colors.at(0)[0] == (color >= 1 ? 1.0f : 0.0f));
    }
}

TEST_CASE("a warning with several occurrences is reported once with the first one and the number of others") {
    strata::scenes::Warnings warnings;
    CHECK(warnings.messages().empty());
    warnings.add("/b", "second");
    warnings.add("/a", "first");
    warnings.add("/c", "second");
    warnings.add("/b", "second");
    CHECK(warnings.messages() == std::vector<std::string>{"/b (and 2 more): second", "/a: first"});
}

TEST_CASE("text from a file is one line of at most 160 bytes in a message") {
    using strata::scenes::in_quotes;
    using strata::scenes::one_line;
    CHECK(one_line("a\tb\nc\x7f"
                   "d\x1f ~") == "a?b?c?d? ~");
    CHECK(one_line("\xc3\xa4") == "\xc3\xa4");
    CHECK(one_line(std::string(160, 'x')) == std::string(160, 'x'));
    CHECK(one_line(std::string(161, 'x')) == std::string(160, 'x') + "...");
    CHECK(in_quotes("a\nb") == "'a?b'");
    const strata::scenes::FileLocation location{"f", ""};
    CHECK(location.under("a").under(2).pointer == "/a/2");
    CHECK_THROWS_WITH(location.fail("CODE", "this", "that"), "f: /: expected this, found that [CODE]");
}
