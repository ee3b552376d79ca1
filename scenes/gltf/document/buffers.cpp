// scenes/gltf/document/buffers.cpp - reads the bytes of buffers and views, and charges the budget (buffers.h).
#include "scenes/gltf/document/buffers.h"

#include "scenes/gltf/document/uri.h"
#include "scenes/memory_limit.h"

namespace strata::scenes {
namespace {

constexpr std::uint64_t elements_per_byte =
    16;  // 1 suffices for unshared data; the rest is for primitives that share vertices

void check_media_type(const Resource& resource, const FileLocation& location) {
    const std::string& type = resource.media_type;
    if (!type.empty() && type != "application/octet-stream" && type != "application/gltf-buffer")
        location.fail("BUFFER_DATA_URI_MIME_TYPE_INVALID", "application/octet-stream or application/gltf-buffer",
                      in_quotes(type));
}

}  // namespace

void Budget::pay_elements(std::uint64_t count, std::uint64_t bytes_each, const FileLocation& location) {
    if (count > elements_)
        location.fail("VALUE_NOT_IN_RANGE", "at most 2^22 vertices and indices, plus 16 per byte of the file",
                      "more: this primitive has " + std::to_string(count));
    elements_ -= count;
    check_memory_need(location.file, location.pointer,
                      {.kind = "elements that take",
                       .amount = std::to_string(count) + " of them, which take",
                       .bytes = count * bytes_each});
}

void Budget::pay_texels(std::uint64_t count, const FileLocation& location) {
    if (count > texels_)
        location.fail("VALUE_NOT_IN_RANGE", "at most 2^28 texels in all textures together",
                      "more: this image has " + std::to_string(count));
    texels_ -= count;
}

Bytes Buffers::view(std::size_t view_index) {
    const Json& view = document_.json["bufferViews"][view_index];
    const auto offset = view.value("byteOffset", std::size_t{0});
    return buffer(view["buffer"].get<std::size_t>()).subspan(offset, view["byteLength"].get<std::size_t>());
}

Bytes Buffers::buffer(std::size_t index) {
    if (const auto found = known_.find(index); found != known_.end()) return found->second;
    const Bytes bytes = read(index);
    budget_.allow_elements(elements_per_byte * bytes.size());
    return known_[index] = bytes;
}

// Returns exactly the declared number of bytes.
Bytes Buffers::read(std::size_t index) {
    const JsonAt at = document_.at("buffers", index);
    const auto declared = at.json()["byteLength"].get<std::size_t>();
    Bytes bytes;
    if (const auto uri = at.find("uri")) {
        Resource resource = read_uri(uri->json().get_ref<const std::string&>(), document_.folder, uri->location());
        check_media_type(resource, uri->location());
        bytes = held_[index] = std::move(resource.bytes);
    } else {
        if (index != 0)
            at.location().fail("BUFFER_NON_FIRST_GLB", "a uri, because only the first buffer can be the BIN chunk",
                               "none");
        if (!document_.bin)
            at.location().fail("BUFFER_MISSING_GLB_DATA", "a uri, because the file has no BIN chunk", "none");
        bytes = *document_.bin;
    }
    if (bytes.size() < declared)
        at.location()
            .under("byteLength")
            .fail(at.has("uri") ? "BUFFER_EXTERNAL_BYTELENGTH_MISMATCH" : "BUFFER_EMBEDDED_BYTELENGTH_MISMATCH",
                  "at most " + std::to_string(bytes.size()) + ", the number of bytes in the buffer",
                  std::to_string(declared));
    return bytes.first(declared);
}

}  // namespace strata::scenes
