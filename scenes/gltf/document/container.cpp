// scenes/gltf/document/container.cpp - splits a .glb into chunks, or takes a file as JSON text (container.h).
#include "scenes/gltf/document/container.h"

#include <cstdint>

#include "scenes/gltf/document/file_location.h"

namespace strata::scenes {
namespace {

// The three four-character codes as little-endian words, glTF 2.0, 4.4.
constexpr std::uint32_t magic = 0x46546c67, json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;  // "glTF", "JSON", "BIN\0"
constexpr std::size_t header_size = 12, chunk_header_size = 8;
// The parsed tree takes many times the text's size.
constexpr std::size_t max_json_bytes = std::size_t{1} << 28;

std::uint32_t word(Bytes bytes, std::size_t at) {  // little endian
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

std::string_view text(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

struct Chunk {
    std::uint32_t type;
    Bytes data;
};

// One pass over the chunks. A length is compared with the remaining bytes before a span is made, so no read passes the
// end.
class ChunkReader {
  public:
    ChunkReader(Bytes bytes, const std::string& file) : bytes_{bytes}, file_{file} {
        if (bytes.size() < header_size) fail(0, "GLB_UNEXPECTED_END_OF_HEADER", "a header of 12 bytes", bytes.size());
        if (word(bytes, 4) != 2) fail(4, "GLB_INVALID_VERSION", "version 2", word(bytes, 4));
        const std::uint32_t length = word(bytes, 8);
        if (length < header_size + chunk_header_size)
            fail(8, "GLB_LENGTH_TOO_SMALL", "a length of at least 20", length);
        if (length != bytes.size())
            fail(8, "GLB_LENGTH_MISMATCH", "the file's length, " + std::to_string(bytes.size()), length);
    }
    [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

    Chunk next() {
        const std::size_t left = bytes_.size() - at_;
        if (left < chunk_header_size)
            fail(at_, "GLB_UNEXPECTED_END_OF_CHUNK_HEADER", "a chunk header of 8 bytes", left);
        const std::uint32_t length = word(bytes_, at_), type = word(bytes_, at_ + 4);
        if (length > left - chunk_header_size)
            fail(at_, "GLB_CHUNK_TOO_BIG", "a chunk of at most " + std::to_string(left - chunk_header_size) + " bytes",
                 length);
        const Chunk chunk{type, bytes_.subspan(at_ + chunk_header_size, length)};
        at_ = length % 4 == 0 ? at_ + chunk_header_size + length : behind_odd(length);
        return chunk;
    }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    [[noreturn]] void fail(std::size_t at, std::string_view code, const std::string& expected,
                           std::uint64_t found) const {
        FileLocation{file_, "byte " + std::to_string(at)}.fail(code, expected, std::to_string(found));
    }

  private:
    // Older exporters did not count the padding of a chunk in its length, or did not pad. If only one of the two
    // interpretations leads to the file's end or to a BIN chunk that fits, it is used.
    std::size_t behind_odd(std::uint32_t length) {
        const std::size_t bare = at_ + chunk_header_size + length, padded = (bare + 3) / 4 * 4;
        const auto leads_on = [&](std::size_t to) {
            if (to == bytes_.size()) return true;
            if (to + chunk_header_size > bytes_.size()) return false;
            return word(bytes_, to + 4) == bin_chunk && word(bytes_, to) <= bytes_.size() - to - chunk_header_size;
        };
        if (leads_on(bare) == leads_on(padded))
            fail(at_, "GLB_CHUNK_LENGTH_UNALIGNED",
                 "a chunk length that is a multiple of 4 (gltf-transform copy IN.glb OUT.glb mends the file)", length);
        warnings_.push_back("byte " + std::to_string(at_) + ": the chunk's length " + std::to_string(length) +
                            " is not a multiple of 4; the chunk is read nevertheless");
        return leads_on(bare) ? bare : padded;
    }

    Bytes bytes_;
    const std::string& file_;
    std::size_t at_ = header_size;
    std::vector<std::string> warnings_{};
};

Container split_glb(Bytes bytes, const std::string& file) {
    ChunkReader reader{bytes, file};
    const Chunk first = reader.next();
    if (first.type != json_chunk)
        reader.fail(16, "GLB_UNEXPECTED_FIRST_CHUNK", "1313821514, the type of a JSON chunk", first.type);
    if (first.data.empty()) reader.fail(12, "GLB_EMPTY_CHUNK", "a JSON chunk of at least 1 byte", 0);
    Container container{.json = text(first.data)};
    for (bool is_second = true; !reader.at_end(); is_second = false) {
        const Chunk chunk = reader.next();
        if (chunk.type == json_chunk) reader.fail(16, "GLB_DUPLICATE_CHUNK", "one JSON chunk", 2);
        if (chunk.type != bin_chunk) continue;  // "clients MUST ignore chunks with unknown types"
        if (container.bin) reader.fail(16, "GLB_DUPLICATE_CHUNK", "at most one BIN chunk", 2);
        if (!is_second) reader.fail(16, "GLB_UNEXPECTED_BIN_CHUNK", "the BIN chunk as chunk 2", 3);
        container.bin = chunk.data;
    }
    container.warnings = reader.warnings();
    return container;
}

}  // namespace

Container split_container(Bytes bytes, const std::string& file) {
    const FileLocation start{file, "byte 0"};
    if (bytes.empty()) start.fail("INVALID_JSON", "a glTF file", "an empty file");
    const bool is_glb = bytes.size() >= 4 && word(bytes, 0) == magic;
    const auto first = std::to_integer<unsigned char>(bytes[0]);
    // Whitespace and a byte order mark (it begins with 0xef) may precede the first brace; the parser checks the rest.
    const bool may_be_json =
        first == '{' || first == ' ' || first == '\t' || first == '\n' || first == '\r' || first == 0xef;
    if (!is_glb && !may_be_json)
        start.fail("GLB_INVALID_MAGIC", "glTF: JSON text or a GLB header",
                   in_quotes(text(bytes.first(bytes.size() < 4 ? bytes.size() : 4))));
    const Container container = is_glb ? split_glb(bytes, file) : Container{.json = text(bytes)};
    if (container.json.size() > max_json_bytes)
        start.fail("INVALID_JSON", "at most 2^28 bytes of JSON", std::to_string(container.json.size()));
    return container;
}

}  // namespace strata::scenes
