// scenes/gltf/document/buffers.h - the bytes of a checked document's buffers, each read when first needed.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/document/container.h"
#include "scenes/gltf/document/json.h"

namespace strata::scenes {

// A checked document and the data it refers to.
struct Document {
    std::string file;
    Json json;
    std::optional<Bytes> bin;                     // the BIN chunk of a .glb; the file's bytes must outlive the document
    std::optional<std::filesystem::path> folder;  // base folder of uris; empty: only data: uris are allowed
    std::size_t size = 0;                         // of the file, in bytes

    [[nodiscard]] JsonAt root() const { return {json, {file, ""}}; }
    [[nodiscard]] JsonAt at(const char* kind, std::size_t index) const {  // of a checked document
        return {json[kind][index], FileLocation{file, ""}.under(kind).under(index)};
    }
};

// The limits on the expanded size of a file: elements (vertices and indices of all meshes) and texels. Sharing,
// zero-filled accessors and compressed images can multiply the content of a file, so each use is charged before memory
// is allocated.
class Budget {
  public:
    Budget(std::uint64_t elements, std::uint64_t texels) : elements_{elements}, texels_{texels} {}

    void allow_elements(std::uint64_t more) { elements_ += more; }
    // `bytes_each`: of memory, for an element. InputError also if they do not fit into memory (memory_limit.h).
    void pay_elements(std::uint64_t count, std::uint64_t bytes_each, const FileLocation& location);
    void pay_texels(std::uint64_t count, const FileLocation& location);

  private:
    std::uint64_t elements_, texels_;
};

// Views are spans of buffers whose ranges check_buffers.cpp has accepted. The bytes live as long as this object; those
// of a .glb's own chunk as long as the file's bytes.
class Buffers {
  public:
    Buffers(const Document& document, Budget& budget) : document_{document}, budget_{budget} {}

    [[nodiscard]] Bytes view(std::size_t view_index);

  private:
    Bytes buffer(std::size_t index);
    Bytes read(std::size_t index);

    const Document& document_;
    Budget& budget_;
    std::map<std::size_t, std::vector<std::byte>> held_;
    std::map<std::size_t, Bytes> known_;
};

}  // namespace strata::scenes
