// scenes/gltf/document/uri.h - resolves a uri to bytes inside the document (data:) or to a regular file in the scene's
// folder.
//
// Rule     No scheme but data:, no absolute path, no "..", no backslash, no query; the rest is percent-decoded, links
//          are followed, and their target must be a regular file inside the folder of the scene. data: must be base64.
//          Nothing is opened or allocated before all of this has been checked.
// Source   glTF 2.0, 2.8 (URIs), 3.6.1.1; RFC 2397, RFC 3986, RFC 4648.
// Tests    tests/scenes/gltf/gltf_bad_uri_test.cpp
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/gltf/document/file_location.h"

namespace strata::scenes {

inline constexpr std::uintmax_t max_file_bytes = 0xffffffff;  // the length field of a .glb has 32 bits

struct Resource {
    std::string media_type;  // of a data: uri, otherwise empty
    std::vector<std::byte> bytes;
};

// `folder`: the scene's folder; if empty, only data: uris are allowed.
[[nodiscard]] Resource read_uri(std::string_view uri, const std::optional<std::filesystem::path>& folder,
                                const FileLocation& location);

// Reads a whole regular file of at most max_file_bytes.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path, const FileLocation& location);

}  // namespace strata::scenes
