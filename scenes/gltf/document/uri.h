// scenes/gltf/document/uri.h - what a uri may lead to: bytes inside the document (data:), or a plain file in the
// scene's own folder.
//
// Rule     No scheme but data:, no absolute path, no "..", no backslash, no query; what is left is percent-decoded,
//          links are followed, and the file at their end must be a regular one inside the folder of the scene. data:
//          must be base64. Nothing is opened, and nothing allocated, before all this holds.
// Source   glTF 2.0, 2.8 (URIs), 3.6.1.1; RFC 2397, RFC 3986, RFC 4648.
// Tests    tests/scenes/gltf/gltf_bad_uri_test.cpp
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/gltf/document/place.h"

namespace strata::scenes {

inline constexpr std::uintmax_t max_file_bytes = 0xffffffff;  // a .glb says its length in 32 bits

struct Resource {
    std::string media_type;  // of a data: uri, else empty
    std::vector<std::byte> bytes;
};

// `folder`: where the scene stands; none: only data: uris are followed.
[[nodiscard]] Resource read_uri(std::string_view uri, const std::optional<std::filesystem::path>& folder,
                                const Place& place);

// A regular file of at most max_file_bytes, whole.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path, const Place& place);

}  // namespace strata::scenes
