// scenes/gltf/document/container.h - the container of a file: .glb chunks, or JSON text.
//
// Rule     A file that begins with "glTF" is a .glb: a 12-byte header, then chunks of which the first is JSON and the
//          second may be BIN; other chunks are ignored. Every length is compared with the remaining bytes before it is
//          used. A length that is not a multiple of 4 gives a warning if the offset of the next chunk is unambiguous.
// Source   glTF 2.0, 4.4 (GLB file format).
// Tests    tests/scenes/gltf/gltf_bad_container_test.cpp: a small file truncated at every length
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strata::scenes {

using Bytes = std::span<const std::byte>;

struct Container {
    std::string_view json;
    std::optional<Bytes> bin{};
    std::vector<std::string> warnings{};  // "byte 12: the chunk's length 325 is ..."
};

// The result refers to `bytes`.
[[nodiscard]] Container split_container(Bytes bytes, const std::string& file);

}  // namespace strata::scenes
