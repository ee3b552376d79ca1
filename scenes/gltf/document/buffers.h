// scenes/gltf/document/buffers.h - the bytes behind a checked document, each buffer read when it is first needed.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/document/container.h"
#include "scenes/gltf/document/json.h"

namespace strata::scenes {

// A checked document and what it stands on.
struct Document {
    std::string file;
    Json json;
    std::optional<Bytes> bin;                     // of a .glb; the file's bytes outlive the document
    std::optional<std::filesystem::path> folder;  // where uris lead; none: data: alone
    std::size_t size = 0;                         // the file's, in bytes

    [[nodiscard]] JsonAt root() const { return {json, {file, ""}}; }
    [[nodiscard]] JsonAt at(const char* kind, std::size_t index) const {  // of a checked document
        return {json[kind][index], Place{file, ""}.under(kind).under(index)};
    }
};

// The budget that a file may unfold to: elements (vertices and indices of all meshes) and texels. Sharing may multiply
// what a file holds, zero-filled accessors and compressed images too, so each is paid for before memory is asked for
// it.
class Budget {
  public:
    Budget(std::uint64_t elements, std::uint64_t texels) : elements_{elements}, texels_{texels} {}

    void allow_elements(std::uint64_t more) { elements_ += more; }
    void pay_elements(std::uint64_t count, const Place& place);
    void pay_texels(std::uint64_t count, const Place& place);

  private:
    std::uint64_t elements_, texels_;
};

// Views are cut from buffers whose ranges check_buffers.cpp has passed. The bytes live as long as this object,
// or the file for a .glb's own chunk.
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
