// tests/scenes/gltf/gltf_file.cpp - builds the parts of small glTF files and encodes PNG and JPEG images for them
// (gltf_file.h).
#include "tests/scenes/gltf/gltf_file.h"

#include <array>

#include "rasterizer/base/input_error.h"

namespace strata::scenes::test {
namespace {

void append(ByteVector& bytes, const ByteVector& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

ByteVector little_endian(std::uint32_t value) {
    ByteVector bytes;
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
    return bytes;
}

ByteVector big_endian(std::uint32_t value) {
    const ByteVector bytes = little_endian(value);
    return {bytes.rbegin(), bytes.rend()};
}

std::uint32_t crc32(const ByteVector& bytes) {  // PNG annex D, bit by bit
    std::uint32_t crc = 0xffffffffu;
    for (const std::byte b : bytes) {
        crc ^= std::to_integer<std::uint32_t>(b);
        for (int i = 0; i < 8; ++i) crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

std::uint32_t adler32(const ByteVector& bytes) {
    std::uint32_t a = 1, b = 0;
    for (const std::byte byte : bytes) a = (a + std::to_integer<std::uint32_t>(byte)) % 65521, b = (b + a) % 65521;
    return b << 16 | a;
}

ByteVector png_chunk(const std::string& type, const ByteVector& data) {
    ByteVector named = to_bytes(type);
    append(named, data);
    ByteVector bytes = big_endian(static_cast<std::uint32_t>(data.size()));
    append(bytes, named);
    append(bytes, big_endian(crc32(named)));
    return bytes;
}

ByteVector stored_zlib(const ByteVector& data) {  // one stored block: below 65,536 bytes
    ByteVector bytes{std::byte{0x78}, std::byte{0x01}, std::byte{1}};
    const auto size = static_cast<std::uint32_t>(data.size());
    for (const std::uint32_t part : {size, ~size})
        for (const int shift : {0, 8}) bytes.push_back(static_cast<std::byte>(part >> shift & 0xff));
    append(bytes, data);
    append(bytes, big_endian(adler32(data)));
    return bytes;
}

}  // namespace

ByteVector to_bytes(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string data_uri(std::span<const std::byte> bytes, const std::string& type) {
    return "data:" + type + ";base64," + base64(bytes);
}

ByteVector chunk(std::uint32_t type, const ByteVector& data) {
    ByteVector padded = data;
    padded.resize((data.size() + 3) / 4 * 4, type == json_chunk ? std::byte{' '} : std::byte{0});
    ByteVector bytes = little_endian(static_cast<std::uint32_t>(padded.size()));
    append(bytes, little_endian(type));
    append(bytes, padded);
    return bytes;
}

ByteVector glb(const Json& json, const ByteVector& bin) {
    ByteVector chunks = chunk(json_chunk, to_bytes(json.dump()));
    append(chunks, chunk(bin_chunk, bin));
    ByteVector bytes = to_bytes("glTF");
    append(bytes, little_endian(2));
    append(bytes, little_endian(static_cast<std::uint32_t>(12 + chunks.size())));
    append(bytes, chunks);
    return bytes;
}

ByteVector png(std::uint32_t width, std::uint32_t height, int bits, int channels,
               const std::vector<std::uint8_t>& raw) {
    constexpr std::array<int, 5> color_type{0, 0, 4, 2, 6};
    ByteVector header = big_endian(width);
    append(header, big_endian(height));
    for (const int v : {bits, color_type[static_cast<std::size_t>(channels)], 0, 0, 0})
        header.push_back(static_cast<std::byte>(v));
    ByteVector rows;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (i % (raw.size() / height) == 0) rows.push_back(std::byte{0});  // filter: none
        rows.push_back(static_cast<std::byte>(raw[i]));
    }
    ByteVector bytes = to_bytes("\x89PNG\r\n\x1a\n");
    append(bytes, png_chunk("IHDR", header));
    append(bytes, png_chunk("IDAT", stored_zlib(rows)));
    append(bytes, png_chunk("IEND", {}));
    return bytes;
}

// A JPEG by ITU T.81, written by hand: every quantizer is 1, with one Huffman code '0' each for "DC difference 0" and
// "end of block".
ByteVector grey_jpeg() {
    std::vector<int> codes{0xff, 0xd8, 0xff, 0xdb, 0, 67, 0};
    codes.insert(codes.end(), 64, 1);
    codes.insert(codes.end(), {0xff, 0xc0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0});
    for (const int table : {0x00, 0x10}) {
        codes.insert(codes.end(), {0xff, 0xc4, 0, 20, table, 1});
        codes.insert(codes.end(), 16, 0);
    }
    codes.insert(codes.end(), {0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0, 0x3f, 0xff, 0xd9});
    ByteVector bytes;
    for (const int code : codes) bytes.push_back(static_cast<std::byte>(code));
    return bytes;
}

Json GltfFile::document() const {
    Json whole = json;
    if (!bin.empty()) whole["buffers"] = Json::array({{{"byteLength", bin.size()}, {"uri", data_uri(bin)}}});
    return whole;
}

ByteVector GltfFile::as_glb() const {
    Json whole = json;
    whole["buffers"] = Json::array({{{"byteLength", bin.size()}}});
    return glb(whole, bin);
}

Scene GltfFile::load(const SceneOptions& options) const { return test::load(document(), options); }

Scene load(const Json& document, const SceneOptions& options) {
    return load_gltf_bytes(to_bytes(document.dump()), "test.gltf", options);
}

GltfFile everything() {
    GltfFile file;
    file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    file.accessor<float>("VEC3", f32, 4, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.accessor<float>("VEC2", f32, 4, {0, 0, 1, 0, 0, 1, 1, 1});
    const std::vector<float> colors{1, 0.5f, 0, 1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1};
    const int indices = file.view(std::vector<std::uint16_t>{1, 2}),
              values = file.view(std::vector<float>{0, 0, 1, 1, 0, 1, 0, 0.5f});
    file.accessor("VEC4", f32, 4, colors,
                  {{"sparse",
                    {{"count", 2},
                     {"indices", {{"bufferView", indices}, {"componentType", u16}}},
                     {"values", {{"bufferView", values}}}}}});
    file.accessor<std::uint16_t>("SCALAR", u16, 6, {0, 1, 2, 2, 1, 3});
    file.add("images", {{"uri", data_uri(png(1, 1, 8, 4, {10, 20, 30, 40}), "image/png")}});
    file.add("samplers", {{"magFilter", 9728}, {"wrapS", 33071}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    file.add("materials",
             {{"alphaMode", "BLEND"},
              {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}, {"baseColorTexture", {{"index", 0}}}}}});
    file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 10}}}});
    file.add("cameras",
             {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 10}}}});
    file.add("meshes",
             {{"primitives",
               Json::array({{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}}},
                             {"indices", 4},
                             {"material", 0}}})}});
    file.show_node(
        {{"children", {1, 2}}, {"translation", {0, 0, -5}}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 1, 1}}});
    file.add("nodes", {{"mesh", 0}});
    file.add("nodes", {{"camera", 0}});
    file.show_node({{"camera", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    file.json["scene"] = 0;
    return file;
}

std::string refusal(std::span<const std::byte> bytes) {
    try {
        (void)load_gltf_bytes(bytes, "test.gltf", {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace strata::scenes::test
