// scenes/images/exr_color_space.cpp - gives the attribute of the colour space its name in a written EXR file.
//
// Rule     A header is attributes, each NAME 0 TYPE 0 SIZE VALUE, and ends in a zero byte where a name would begin. A file
//          of several parts has one after the other and an empty one behind them. Nothing in the file sums over names,
//          and a reader takes them in any order, so a name of equal length changes nothing else.
// Source   OpenEXR file layout, "Header" and "Multi-part".
#include <array>
#include <fstream>

#include "scenes/images/openimageio.h"

namespace strata::scenes::images {
namespace {

constexpr std::uint32_t several_parts = 1u << 12;

std::uint32_t little_endian(std::fstream& file) {
    std::array<char, 4> bytes{};
    file.read(bytes.data(), bytes.size());
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i) word |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    return word;
}

std::string text(std::fstream& file) {
    std::string found;
    std::getline(file, found, '\0');
    return found;
}

// The number of attributes of the header that begins here; the file then stands behind it.
int rename_in_header(std::fstream& file) {
    int attributes = 0;
    for (auto at = file.tellg(); file; at = file.tellg()) {
        const std::string name = text(file);
        if (name.empty()) break;
        ++attributes;
        if (name == color_space_stand_in) {
            file.seekp(at);
            file.write(color_space_name.data(), static_cast<std::streamsize>(color_space_name.size()));
            file.seekg(at + static_cast<std::streamoff>(name.size() + 1));
        }
        text(file);  // its type
        file.seekg(static_cast<std::streamoff>(little_endian(file)), std::ios::cur);
    }
    return attributes;
}

}  // namespace

bool rename_color_space(const std::string& path) {
    std::fstream file{path, std::ios::in | std::ios::out | std::ios::binary};
    file.seekg(4);  // the magic number
    const bool has_several = (little_endian(file) & several_parts) != 0;
    while (file && rename_in_header(file) > 0 && has_several) {
    }
    file.close();
    return !file.fail();
}

}  // namespace strata::scenes::images
