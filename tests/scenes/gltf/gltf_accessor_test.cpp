// Tests glTF accessors against glTF 2.0, 3.6.2: its formulas for normalised integers, and sparse substitution as a loop
// over a plain array.
#include <catch2/catch.hpp>

#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
using Vec3s = std::vector<strata::pipeline::Vec3>;

Json quantised() { return Json::array({"KHR_mesh_quantization"}); }

// Three vertices at integer (or normalised) positions of the component type, four-byte aligned.
template <class T>
Vec3s positions(Component component, const std::vector<T>& padded, std::size_t stride, bool is_normalized) {
    GltfFile file;
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = quantised();
    const int accessor = file.accessor("VEC3", component, 3, padded, {{"normalized", is_normalized}});
    file.json["bufferViews"][0]["byteStride"] = stride;
    file.show({{"attributes", {{"POSITION", accessor}}}});
    return file.load({.light = false}).list.meshes.at(0).positions;
}

}  // namespace

TEST_CASE("every component type of a position means its integer or its normalised value") {
    const std::vector<std::int8_t> bytes{-128, 127, 1, 0, 0, -127, 64, 0, -1, 2, 3, 0};
    CHECK(positions(i8, bytes, 4, false) == Vec3s{{-128, 127, 1}, {0, -127, 64}, {-1, 2, 3}});
    CHECK(positions(i8, bytes, 4, true) ==
          Vec3s{{-1, 1, 1 / 127.0f}, {0, -1, 64 / 127.0f}, {-1 / 127.0f, 2 / 127.0f, 3 / 127.0f}});
    const std::vector<std::uint8_t> unsigned_bytes{255, 128, 1, 0, 0, 254, 64, 0, 1, 2, 3, 0};
    CHECK(positions(u8, unsigned_bytes, 4, false) == Vec3s{{255, 128, 1}, {0, 254, 64}, {1, 2, 3}});
    CHECK(positions(u8, unsigned_bytes, 4, true) ==
          Vec3s{{1, 128 / 255.0f, 1 / 255.0f}, {0, 254 / 255.0f, 64 / 255.0f}, {1 / 255.0f, 2 / 255.0f, 3 / 255.0f}});
    const std::vector<std::int16_t> shorts{-32768, 32767, 1, 0, 0, -32767, 2, 0, 3, 4, 5, 0};
    CHECK(positions(i16, shorts, 8, false) == Vec3s{{-32768, 32767, 1}, {0, -32767, 2}, {3, 4, 5}});
    CHECK(positions(i16, shorts, 8, true) ==
          Vec3s{{-1, 1, 1 / 32767.0f}, {0, -1, 2 / 32767.0f}, {3 / 32767.0f, 4 / 32767.0f, 5 / 32767.0f}});
    const std::vector<std::uint16_t> unsigned_shorts{65535, 32768, 1, 0, 0, 65534, 2, 0, 3, 4, 5, 0};
    CHECK(positions(u16, unsigned_shorts, 8, false) == Vec3s{{65535, 32768, 1}, {0, 65534, 2}, {3, 4, 5}});
    CHECK(positions(u16, unsigned_shorts, 8, true) == Vec3s{{1, 32768 / 65535.0f, 1 / 65535.0f},
                                                            {0, 65534 / 65535.0f, 2 / 65535.0f},
                                                            {3 / 65535.0f, 4 / 65535.0f, 5 / 65535.0f}});
    const std::vector<float> floats{0x1p-149f, -0x1.fffffep127f, 1, 0, -0.0f, 2, 3, 0, 4, 5, 6, 0};
    CHECK(positions(f32, floats, 16, false) == Vec3s{{0x1p-149f, -0x1.fffffep127f, 1}, {-0.0f, 2, 3}, {4, 5, 6}});
}

TEST_CASE("quantised formats need KHR_mesh_quantization") {
    GltfFile file;
    const int accessor = file.accessor<std::int16_t>("VEC3", i16, 3, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
    file.json["bufferViews"][0]["byteStride"] = 8;
    file.show({{"attributes", {{"POSITION", accessor}}}});
    CHECK(refusal(to_bytes(file.document().dump())).ends_with("[MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT]"));
    file.json["extensionsUsed"] = quantised();
    CHECK(refusal(to_bytes(file.document().dump())) == "");
    file.json["bufferViews"][0].erase("byteStride");
    CHECK(refusal(to_bytes(file.document().dump())).ends_with("[MESH_PRIMITIVE_ACCESSOR_UNALIGNED]"));
}

TEST_CASE("indices of 8 16 or 32 bits name the same vertices and the largest value of each type is rejected") {
    const auto load_with = [](auto index, Component component, std::uint32_t last) {
        using Index = decltype(index);
        GltfFile file;
        const int positions = file.positions(std::vector<float>(3 * 300, 1.0f));
        const int indices =
            file.accessor<Index>("SCALAR", component, 3, {Index(7), Index(200), static_cast<Index>(last)});
        file.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        return file;
    };
    const auto indices = [](const GltfFile& file) { return file.load({.light = false}).list.meshes.at(0).indices; };
    CHECK(indices(load_with(std::uint8_t{}, u8, 9)) == std::vector<std::uint32_t>{0, 2, 1});
    CHECK(indices(load_with(std::uint16_t{}, u16, 299)) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(indices(load_with(std::uint32_t{}, u32, 299)) == std::vector<std::uint32_t>{0, 1, 2});
    const auto refused = [](const GltfFile& file) { return refusal(to_bytes(file.document().dump())); };
    CHECK(refused(load_with(std::uint8_t{}, u8, 255))
              .ends_with("found 255 at element 2 [ACCESSOR_INDEX_PRIMITIVE_RESTART]"));
    CHECK(refused(load_with(std::uint16_t{}, u16, 0xffff)).ends_with("[ACCESSOR_INDEX_PRIMITIVE_RESTART]"));
    CHECK(refused(load_with(std::uint32_t{}, u32, 0xffffffff)).ends_with("[ACCESSOR_INDEX_PRIMITIVE_RESTART]"));
    CHECK(refused(load_with(std::uint32_t{}, u32, 300)).ends_with("found 300 at element 2 [ACCESSOR_INDEX_OOB]"));
}

TEST_CASE("sparse values replace elements of the base or of zeros") {
    for (const bool has_base : {true, false}) {
        std::vector<float> base(3 * 5);
        for (std::size_t i = 0; i < base.size(); ++i) base[i] = static_cast<float>(i + 1);
        GltfFile file;
        const int indices = file.view(std::vector<std::uint8_t>{1, 4});
        const int values = file.view(std::vector<float>{-1, -2, -3, -4, -5, -6});
        Json accessor{{"componentType", f32},
                      {"count", 5},
                      {"type", "VEC3"},
                      {"sparse",
                       {{"count", 2},
                        {"indices", {{"bufferView", indices}, {"componentType", u8}}},
                        {"values", {{"bufferView", values}}}}}};
        if (has_base) accessor["bufferView"] = file.view(base);
        file.show({{"attributes", {{"POSITION", file.add("accessors", accessor)}}}, {"mode", 5}});
        Vec3s expected(5);
        for (std::size_t i = 0; i < 15 && has_base; ++i) expected[i / 3][i % 3] = base[i];
        expected[1] = {-1, -2, -3};
        expected[4] = {-4, -5, -6};
        CHECK(file.load({.light = false}).list.meshes.at(0).positions == expected);
    }
}

TEST_CASE("accessors share a view by stride and offset") {
    GltfFile file;
    const std::vector<float> interleaved{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1};
    file.accessor("VEC3", f32, 3, interleaved);
    file.json["bufferViews"][0]["byteStride"] = 24;
    file.add("accessors",
             {{"bufferView", 0}, {"byteOffset", 12}, {"componentType", f32}, {"count", 3}, {"type", "VEC3"}});
    file.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
    const auto mesh = file.load().list.meshes.at(0);
    CHECK(mesh.positions == Vec3s{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.normals == Vec3s{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
}

TEST_CASE("a small file cannot ask for unbounded memory") {
    GltfFile file;
    file.add("accessors", {{"componentType", f32}, {"count", 2147483647}, {"type", "VEC3"}});
    file.show({{"attributes", {{"POSITION", 0}}}});
    const std::string zeros = refusal(to_bytes(file.document().dump()));
    CHECK(zeros.starts_with("test.gltf: /meshes/0/primitives/0: expected "));
    CHECK(zeros.ends_with("[VALUE_NOT_IN_RANGE]"));
    file.json["accessors"][0]["count"] = 1000000;
    Json primitive = file.json["meshes"][0]["primitives"][0];
    for (int i = 0; i < 100; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
    CHECK(refusal(to_bytes(file.document().dump())).ends_with("[VALUE_NOT_IN_RANGE]"));
}
