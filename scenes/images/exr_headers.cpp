// scenes/images/exr_headers.cpp - what is mended and checked in the bytes of a written EXR file.
//
// Rule     A header is attributes, each NAME 0 TYPE 0 SIZE VALUE, and ends in a zero byte where a name would begin. A file
//          of several parts has one after the other and an empty one behind them. Nothing in the file sums over names,
//          and a reader takes them in any order, so a name of equal length changes nothing else. Behind the headers stand
//          the places of all chunks, `chunkCount` words of eight bytes a part.
// Source   OpenEXR file layout, "Header", "Multi-part" and "Offset tables".
// Tests    tests/tools/system_faults_test.cpp; tests/scenes/files/exr_test.cpp
#include <array>
#include <fstream>

#include "scenes/images/openimageio.h"

namespace strata::scenes::images {
namespace {

constexpr std::uint32_t several_parts = 1u << 12;

template <class Word>
Word little_endian(std::fstream& file) {
    std::array<char, sizeof(Word)> bytes{};
    file.read(bytes.data(), bytes.size());
    Word word = 0;
    for (unsigned i = 0; i < bytes.size(); ++i) word |= Word{static_cast<unsigned char>(bytes[i])} << (8 * i);
    return word;
}

std::string text(std::fstream& file) {
    std::string found;
    std::getline(file, found, '\0');
    return found;
}

struct HeaderCounts {
    std::uint32_t attributes = 0, chunks = 0;
};

// Reads the header that begins here, and names its colour space; the file then stands behind it.
HeaderCounts pass_header(std::fstream& file) {
    HeaderCounts counts;
    for (auto at = file.tellg(); file; at = file.tellg()) {
        const std::string name = text(file);
        if (name.empty()) break;
        ++counts.attributes;
        if (name == color_space_stand_in) {
            file.seekp(at);
            file.write(color_space_name.data(), static_cast<std::streamsize>(color_space_name.size()));
            file.seekg(at + static_cast<std::streamoff>(name.size() + 1));
        }
        text(file);  // its type
        const auto size = little_endian<std::uint32_t>(file);
        const auto value = file.tellg();
        if (name == "chunkCount") counts.chunks = little_endian<std::uint32_t>(file);
        file.seekg(value + static_cast<std::streamoff>(size));
    }
    return counts;
}

// OpenEXR writes the places of a part's chunks when the part is done, and does not report it if that fails: zeros remain,
// and readers search the file for its chunks.
bool has_places_of(std::fstream& file, std::uint32_t chunks) {
    while (file && chunks > 0 && little_endian<std::uint64_t>(file) != 0) --chunks;
    return chunks == 0;
}

}  // namespace

bool finish_headers(const std::string& path) {
    std::fstream file{path, std::ios::in | std::ios::out | std::ios::binary};
    file.seekg(4);  // the magic number
    const bool has_several = (little_endian<std::uint32_t>(file) & several_parts) != 0;
    std::uint32_t chunks = 0;
    for (bool is_more = true; file && is_more;) {
        const HeaderCounts counts = pass_header(file);
        chunks += counts.chunks;
        is_more = has_several && counts.attributes > 0;
    }
    const bool is_whole = has_places_of(file, chunks);
    file.close();
    return is_whole && !file.fail();
}

}  // namespace strata::scenes::images
