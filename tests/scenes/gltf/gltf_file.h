// tests/scenes/gltf/gltf_file.h - builds small glTF files for tests.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "scenes/gltf/gltf.h"

namespace strata::scenes::test {

using Json = nlohmann::json;
using ByteVector = std::vector<std::byte>;

[[nodiscard]] ByteVector to_bytes(const std::string& text);
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);
[[nodiscard]] std::string data_uri(std::span<const std::byte> bytes,
                                   const std::string& type = "application/octet-stream");

[[nodiscard]] ByteVector chunk(std::uint32_t type, const ByteVector& data);
[[nodiscard]] ByteVector glb(const Json& json, const ByteVector& bin);
inline constexpr std::uint32_t json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;

// `channels` interleaved codes of 8 or 16 bits, big endian, as a PNG of the matching colour type in stored
// (uncompressed) blocks.
[[nodiscard]] ByteVector png(std::uint32_t width, std::uint32_t height, int bits, int channels,
                             const std::vector<std::uint8_t>& raw);
[[nodiscard]] ByteVector grey_jpeg();  // 8 x 8 texels of code 128

enum Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

// A document that is built part by part, with one buffer; each function that adds a part returns its index.
class GltfFile {
  public:
    Json json{{"asset", {{"version", "2.0"}}}};
    ByteVector bin;

    int add(const char* kind, Json object) {
        json[kind].push_back(std::move(object));
        return static_cast<int>(json[kind].size()) - 1;
    }
    int view(std::span<const std::byte> bytes) {
        bin.resize((bin.size() + 3) / 4 * 4);
        const std::size_t offset = bin.size();
        bin.insert(bin.end(), bytes.begin(), bytes.end());
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
    }
    template <class T>
    int view(const std::vector<T>& values) {
        return view(std::as_bytes(std::span(values)));
    }
    template <class T>
    int accessor(const char* type, Component component, std::size_t count, const std::vector<T>& values,
                 const Json& more = Json::object()) {
        Json object{{"bufferView", view(values)}, {"componentType", component}, {"count", count}, {"type", type}};
        object.update(more);
        return add("accessors", object);
    }
    int positions(const std::vector<float>& values) { return accessor("VEC3", f32, values.size() / 3, values); }

    // Adds a mesh of one primitive and a node for it, and the node to scene 0.
    int show(Json primitive) {
        const int mesh = add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
        return show_node({{"mesh", mesh}});
    }
    int show_node(Json node) {
        const int index = add("nodes", std::move(node));
        if (!json.contains("scenes")) json["scenes"] = Json::array({{{"nodes", Json::array()}}});
        json["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    [[nodiscard]] Json document() const;  // with the buffer as a data: uri
    [[nodiscard]] ByteVector as_glb() const;
    [[nodiscard]] Scene load(const SceneOptions& options = {}) const;
};

[[nodiscard]] Scene load(const Json& document, const SceneOptions& options = {});

// A file that uses every kind of object; the invalid files are this one with one change. Accessors: 0 POSITION, 1
// NORMAL, 2 TEXCOORD_0, 3 COLOR_0 (sparse), 4 indices. Nodes: 0 (parent of 1 and 2), 1 mesh, 2 camera, 3 camera.
[[nodiscard]] GltfFile everything();

// The message of the InputError that `load` throws, or "" if it throws none.
[[nodiscard]] std::string refusal(std::span<const std::byte> bytes);

}  // namespace strata::scenes::test
