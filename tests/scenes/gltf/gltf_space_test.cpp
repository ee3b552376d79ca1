// Tests the layout of accessors against plain arrays filled by a loop, for every component type at every stride and
// offset, and limits to the exact element.
#include <catch2/catch.hpp>
#include <cstring>
#include <random>

#include "rasterizer/base/input_error.h"
#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
using strata::scenes::GltfLimits;
using Positions = std::vector<strata::pipeline::Vec3>;

// True if the file loads within `limits`; otherwise its message must end in the code for a number out of range.
bool fits(const Json& document, const GltfLimits& limits) {
    try {
        static_cast<void>(strata::scenes::load_gltf_bytes(to_bytes(document.dump()), "f", {.light = false}, limits));
        return true;
    } catch (const strata::InputError& error) {
        CHECK_THAT(error.what(), Catch::EndsWith("[VALUE_NOT_IN_RANGE]"));
        return false;
    }
}

struct Layout {
    std::size_t stride, view_offset, offset, count;
};

// `count` positions of component type T after `offset` bytes, `stride` bytes apart (0: no stride is written), with
// random bytes between them.
template <class T>
Positions loaded(Component component, const Layout& layout, Positions& expected, std::mt19937& random) {
    const std::size_t step = layout.stride == 0 ? 3 * sizeof(T) : layout.stride;
    std::vector<std::uint8_t> bytes(layout.view_offset + layout.offset + step * layout.count + 8);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    expected.assign(layout.count, {});
    for (std::size_t i = 0; i < layout.count; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto value = static_cast<T>(static_cast<int>(random() % 251) - (std::is_signed_v<T> ? 125 : 0));
            std::memcpy(&bytes[layout.view_offset + layout.offset + i * step + c * sizeof(T)], &value, sizeof(T));
            expected[i][c] = static_cast<float>(value);
        }
    GltfFile file;
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = Json::array({"KHR_mesh_quantization"});
    const int view = file.view(bytes);
    Json& written = file.json["bufferViews"][static_cast<std::size_t>(view)];
    written["byteOffset"] = layout.view_offset;
    written["byteLength"] = bytes.size() - layout.view_offset - 8;
    if (layout.stride != 0) written["byteStride"] = layout.stride;
    file.show({{"mode", 5},
               {"attributes",
                {{"POSITION", file.add("accessors", {{"bufferView", view},
                                                     {"byteOffset", layout.offset},
                                                     {"componentType", component},
                                                     {"count", layout.count},
                                                     {"type", "VEC3"}})}}}});
    return file.load({.light = false}).list.meshes.at(0).positions;
}

template <class T>
int count_wrong(Component component) {
    std::mt19937 random{17};
    int wrong = 0;
    for (const std::size_t stride : {0, 4, 8, 12, 16, 20, 252})
        for (const std::size_t view_offset : {0, 4, 28})
            for (const std::size_t offset : {0, 4, 12})
                for (const std::size_t count : {3, 4, 9}) {
                    if (stride == 0 && sizeof(T) < 4) continue;  // elements of an attribute start at multiples of 4
                    if (stride != 0 && stride < 3 * sizeof(T)) continue;
                    Positions expected;
                    wrong += loaded<T>(component, {stride, view_offset, offset, count}, expected, random) == expected
                                 ? 0
                                 : 1;
                }
    return wrong;
}

// A file whose one mesh is a strip of `count` zeros and which has no binary data.
Json zeros(std::size_t count) {
    GltfFile file;
    file.add("accessors", {{"componentType", f32}, {"count", count}, {"type", "VEC3"}});
    file.show({{"mode", 5}, {"attributes", {{"POSITION", 0}}}});
    return file.document();
}

template <class Index>
Positions with_sparse(Component component, const std::vector<Index>& changed, std::size_t count, bool has_base) {
    std::vector<float> base(3 * count), values(3 * changed.size());
    for (std::size_t i = 0; i < base.size(); ++i) base[i] = static_cast<float>(i) + 0.5f;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = -1 - static_cast<float>(i);
    GltfFile file;
    Json accessor{{"componentType", f32}, {"count", count}, {"type", "VEC3"}};
    if (has_base) accessor["bufferView"] = file.view(base);
    accessor["sparse"] = {{"count", changed.size()},
                          {"indices", {{"bufferView", file.view(changed)}, {"componentType", component}}},
                          {"values", {{"bufferView", file.view(values)}}}};
    file.show({{"mode", 5}, {"attributes", {{"POSITION", file.add("accessors", accessor)}}}});
    return file.load({.light = false}).list.meshes.at(0).positions;
}

template <class Index>
bool substitutes(Component component, const std::vector<Index>& changed, std::size_t count) {
    for (const bool has_base : {true, false}) {
        Positions expected(count);
        for (std::size_t i = 0; i < 3 * count && has_base; ++i) expected[i / 3][i % 3] = static_cast<float>(i) + 0.5f;
        for (std::size_t k = 0; k < 3 * changed.size(); ++k)
            expected[static_cast<std::size_t>(changed[k / 3])][k % 3] = -1 - static_cast<float>(k);
        if (with_sparse(component, changed, count, has_base) != expected) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("positions of every component type are read at every stride and offset that their size allows") {
    CHECK(count_wrong<std::int8_t>(i8) == 0);
    CHECK(count_wrong<std::uint8_t>(u8) == 0);
    CHECK(count_wrong<std::int16_t>(i16) == 0);
    CHECK(count_wrong<std::uint16_t>(u16) == 0);
    CHECK(count_wrong<float>(f32) == 0);
}

TEST_CASE("sparse elements are read at any position by indices of every type") {
    std::mt19937 random{23};
    int wrong = 0;
    for (int i = 0; i < 40; ++i) {
        const std::size_t count = 3 + random() % 9;
        std::vector<std::uint8_t> changed;
        for (std::size_t k = 0; k < count; ++k)
            if (random() % 2 == 0 || (k + 1 == count && changed.empty()))
                changed.push_back(static_cast<std::uint8_t>(k));
        wrong += substitutes(u8, changed, count) ? 0 : 1;
        wrong += substitutes(u16, std::vector<std::uint16_t>(changed.begin(), changed.end()), count) ? 0 : 1;
        wrong += substitutes(u32, std::vector<std::uint32_t>(changed.begin(), changed.end()), count) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(substitutes(u16, std::vector<std::uint16_t>{255, 256, 299}, 300));
    CHECK(substitutes(u32, std::vector<std::uint32_t>{0, 65535, 65536}, 65537));
}

TEST_CASE("sparse indices must increase strictly and be below the count") {
    const auto said = [](const std::vector<std::uint8_t>& changed) {
        try {
            static_cast<void>(with_sparse(u8, changed, 5, true));
        } catch (const strata::InputError& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    const std::string place = "test.gltf: /accessors/0/sparse/indices: expected ";
    CHECK(said({1, 1}) == place + "indices that increase, found 1 after 1 [ACCESSOR_SPARSE_INDICES_NON_INCREASING]");
    CHECK(said({3, 2}) == place + "indices that increase, found 2 after 3 [ACCESSOR_SPARSE_INDICES_NON_INCREASING]");
    CHECK(said({0, 5}) == place + "indices below 5, found 5 [ACCESSOR_SPARSE_INDEX_OOB]");
    CHECK(said({3, 4}) == "");
}

TEST_CASE("a file may have as many elements as its limit plus 16 for each of its bytes and not one more") {
    const Json document = zeros(5000);
    const std::uint64_t free = 16 * document.dump().size();
    REQUIRE(free < 5000);
    CHECK(fits(document, {.elements = 5000 - free}));
    CHECK_FALSE(fits(document, {.elements = 4999 - free}));
    Json twice = document;  // each primitive counts separately
    twice["meshes"][0]["primitives"].push_back(twice["meshes"][0]["primitives"][0]);
    const std::uint64_t more = 16 * twice.dump().size();
    CHECK(fits(twice, {.elements = 10'000 - more}));
    CHECK_FALSE(fits(twice, {.elements = 9999 - more}));
}

TEST_CASE("the number of corners over all instances may reach its limit and not exceed it") {
    GltfFile file;
    file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    file.show({{"mode", 5}, {"attributes", {{"POSITION", 0}}}});  // a strip of two triangles
    for (int i = 0; i < 4; ++i) file.show_node({{"mesh", 0}});
    const Json document = file.document();
    CHECK(fits(document, {.instanced = 30}));
    CHECK_FALSE(fits(document, {.instanced = 29}));
    CHECK_FALSE(fits(document, {.instanced = 5}));
}

TEST_CASE("the number of texels of all textures may reach its limit and an image of two textures counts twice") {
    GltfFile file = everything();
    file.json["images"][0]["uri"] = data_uri(png(3, 2, 8, 4, std::vector<std::uint8_t>(24, 128)), "image/png");
    CHECK(fits(file.document(), {.texels = 6}));
    CHECK_FALSE(fits(file.document(), {.texels = 5}));
    file.add("textures", {{"source", 0}});
    file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
    Json second = file.json["meshes"][0]["primitives"][0];
    second["material"] = 1;
    file.json["meshes"][0]["primitives"].push_back(second);
    CHECK(fits(file.document(), {.texels = 12}));
    CHECK_FALSE(fits(file.document(), {.texels = 11}));
}
