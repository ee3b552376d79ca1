// Tests damaged .glb and .gltf containers against glTF 2.0, 4.4, and JSON's grammar. Each file is a valid one that is
// truncated or has bytes changed.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;

ByteVector with_word(ByteVector bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i) & 0xff);
    return bytes;
}

ByteVector with_length(ByteVector bytes) { return with_word(bytes, 8, static_cast<std::uint32_t>(bytes.size())); }

ByteVector joined(ByteVector bytes, const ByteVector& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return bytes;
}

void check_refused(const ByteVector& bytes, const std::string& code) {
    INFO(code);
    CHECK(refusal(bytes).ends_with(" [" + code + "]"));
}

std::string nested(std::size_t depth, const std::string& open, const std::string& close) {
    std::string text = "{\"asset\":{\"version\":\"2.0\"},\"extras\":";
    for (std::size_t i = 0; i < depth; ++i) text += open;
    text += "1";
    for (std::size_t i = 0; i < depth; ++i) text += close;
    return text + "}";
}

}  // namespace

TEST_CASE("a .glb truncated after any byte is rejected and the complete one is accepted") {
    GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    const ByteVector whole = file.as_glb();
    REQUIRE(refusal(whole) == "");
    std::size_t accepted = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        accepted += refusal(std::span(whole).first(length)).empty() ? 1u : 0u;
        ByteVector relabelled(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        if (length >= 12) accepted += refusal(with_length(relabelled)).empty() ? 1u : 0u;
    }
    CHECK(accepted == 0);
}

TEST_CASE("a .gltf truncated after any byte is rejected and one with any byte changed is rejected or loads", "[slow]") {
    const ByteVector whole = to_bytes(everything().document().dump());
    std::size_t accepted = 0;
    for (std::size_t length = 0; length < whole.size(); ++length)
        accepted += refusal(std::span(whole).first(length)).empty() ? 1u : 0u;
    CHECK(accepted == 0);
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const char replacement : {'9', '"', ']'}) {
            ByteVector changed = whole;
            changed[at] = static_cast<std::byte>(replacement);
            (void)refusal(changed);  // anything but InputError fails the test
        }
}

// A chunk whose length excludes its padding, with no padding after it or with 1 to 3 blanks that align the next chunk.
TEST_CASE("a chunk of odd length is read with a warning if the position of the next chunk is unambiguous") {
    GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    const ByteVector whole = file.as_glb();
    const auto word_at = [](const ByteVector& bytes, std::size_t at) {
        std::uint32_t word = 0;
        for (std::size_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
        return word;
    };
    const std::size_t json_begin = 20, json_length = word_at(whole, 12);
    // The JSON text ends with its last brace.
    std::size_t length = json_length;
    while (std::to_integer<char>(whole[json_begin + length - 1]) == ' ') --length;
    for (std::size_t own = length; own < length + 4; ++own) {
        if (own % 4 == 0) continue;
        ByteVector text_bytes(whole.begin() + json_begin,
                              whole.begin() + static_cast<std::ptrdiff_t>(json_begin + length));
        text_bytes.resize(own, std::byte{' '});
        const ByteVector rest(whole.begin() + static_cast<std::ptrdiff_t>(json_begin + json_length), whole.end());
        for (const bool is_padded : {false, true}) {
            ByteVector bytes(whole.begin(), whole.begin() + json_begin);
            bytes = joined(bytes, text_bytes);
            if (is_padded) bytes.resize((bytes.size() + 3) / 4 * 4, std::byte{' '});
            bytes = with_length(joined(with_word(bytes, 12, static_cast<std::uint32_t>(own)), rest));
            INFO(own << (is_padded ? " padded" : " bare"));
            const auto scene = strata::scenes::load_gltf_bytes(bytes, "odd.glb", {});
            CHECK(scene.list.meshes.at(0).positions.size() == 3);
            CHECK(scene.list.meshes[0].positions[1] == strata::Vec3{1, 0, 0});
            REQUIRE(scene.warnings.size() == 1);
            CHECK(scene.warnings[0].starts_with("byte 12: the chunk's length " + std::to_string(own)));
            ByteVector cut = bytes;
            cut.pop_back();
            CHECK(refusal(with_length(cut)).ends_with("[GLB_CHUNK_LENGTH_UNALIGNED]"));
        }
    }
}

TEST_CASE("each fault of the header and chunks of a .glb has the validator's code") {
    GltfFile file;
    file.show({{"attributes", {{"POSITION", file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    const ByteVector whole = file.as_glb();
    check_refused(with_word(whole, 0, 0x46546c68), "GLB_INVALID_MAGIC");
    check_refused(with_word(whole, 4, 1), "GLB_INVALID_VERSION");
    check_refused(with_word(whole, 8, 12), "GLB_LENGTH_TOO_SMALL");
    check_refused(with_word(whole, 8, 0xffffffff), "GLB_LENGTH_MISMATCH");
    check_refused(with_word(whole, 12, 0xfffffffc), "GLB_CHUNK_TOO_BIG");
    check_refused(with_word(whole, 12, 0xffffffff), "GLB_CHUNK_TOO_BIG");
    check_refused(with_word(whole, 12, 21), "GLB_CHUNK_LENGTH_UNALIGNED");
    check_refused(with_word(whole, 12, 0), "GLB_EMPTY_CHUNK");
    check_refused(with_word(whole, 16, bin_chunk), "GLB_UNEXPECTED_FIRST_CHUNK");
    check_refused(ByteVector(whole.begin(), whole.begin() + 11), "GLB_UNEXPECTED_END_OF_HEADER");
    const ByteVector rest{std::byte{0}, std::byte{0}, std::byte{0}, std::byte{0}};
    check_refused(with_length(joined(whole, rest)), "GLB_UNEXPECTED_END_OF_CHUNK_HEADER");
    check_refused(with_length(joined(whole, chunk(bin_chunk, rest))), "GLB_DUPLICATE_CHUNK");
    check_refused(with_length(joined(whole, chunk(json_chunk, rest))), "GLB_DUPLICATE_CHUNK");
    CHECK(refusal(with_length(joined(whole, chunk(0x12345678, rest)))) == "");
    Json longer = file.json;
    longer["buffers"] = Json::array({{{"byteLength", 37}}});
    check_refused(glb(longer, file.bin), "BUFFER_EMBEDDED_BYTELENGTH_MISMATCH");
    longer["buffers"] = Json::array({{{"byteLength", 36}, {"uri", data_uri(file.bin)}}, {{"byteLength", 36}}});
    longer["bufferViews"][0]["buffer"] = 1;
    check_refused(glb(longer, file.bin), "BUFFER_NON_FIRST_GLB");
}

TEST_CASE("malformed or too deeply nested JSON is rejected and so are duplicate keys and numbers out of range") {
    for (const char* text :
         {"", "{", "{}x", "[", "nil", " ", "{\"asset\":}", "{\"asset\":{\"version\":\"\xff\"}}", "{\"a\":1,\"a\":2}",
          "{\"asset\":{\"version\":\"2.0\"},\"extras\":1e999}", "{\"asset\":{\"version\":\"2.0\"},\"extras\":NaN}"}) {
        INFO(text);
        CHECK(refusal(to_bytes(text)) != "");
    }
    check_refused(to_bytes("{}"), "UNDEFINED_PROPERTY");
    check_refused(to_bytes("\n[]"), "TYPE_MISMATCH");
    check_refused(to_bytes("[]"), "GLB_INVALID_MAGIC");
    CHECK(refusal(to_bytes(nested(90, "[", "]"))) == "");
    check_refused(to_bytes(nested(101, "[", "]")), "INVALID_JSON");
    check_refused(to_bytes(nested(20000, "[", "]")), "INVALID_JSON");
    check_refused(to_bytes(nested(1000000, "{\"a\":", "}")), "INVALID_JSON");
}

TEST_CASE("a message is one line of printable characters for any file content") {
    GltfFile file = everything();
    file.json["meshes"][0]["primitives"][0]["attributes"][std::string("\x1b[31m\n\0bad", 9)] = 0;
    const std::string message = refusal(to_bytes(file.document().dump()));
    CHECK(message.ends_with("[MESH_PRIMITIVE_INVALID_ATTRIBUTE]"));
    CHECK(std::all_of(message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x20; }));
}
