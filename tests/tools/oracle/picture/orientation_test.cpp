// Tests that a TIFF is read upright whatever corner its first pixel is. The files are written here byte by byte; the
// expected rows are written by hand from the table of TIFF 6.0, page 36.
#include <catch2/catch.hpp>

#include "tests/tools/oracle/picture/own_file.h"
#include "tools/oracle/picture/picture.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

std::string little_endian(std::uint32_t word, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(word >> (8 * i) & 0xff);
    return text;
}

// Grey, 8 bits, uncompressed, one strip behind the directory.
std::string tiff(std::uint32_t width, std::uint32_t height, std::uint32_t orientation, const std::string& codes) {
    const std::pair<std::uint32_t, std::uint32_t> tags[] = {{256, width},       {257, height},
                                                            {258, 8},           {259, 1},
                                                            {262, 1},           {273, 8 + 2 + 10 * 12 + 4},
                                                            {274, orientation}, {277, 1},
                                                            {278, height},      {279, width * height}};
    std::string file = "II" + little_endian(42, 2) + little_endian(8, 4) + little_endian(std::size(tags), 2);
    for (const auto& [tag, value] : tags)
        file += little_endian(tag, 2) + little_endian(4, 2) + little_endian(1, 4) + little_endian(value, 4);
    return file + little_endian(0, 4) + codes;
}

}  // namespace

TEST_CASE("a TIFF is read upright whatever its orientation is") {
    // Stored: 1 2 3 / 4 5 6.
    const std::string codes{"\1\2\3\4\5\6"};
    using Codes = std::vector<std::uint32_t>;
    const struct {
        std::uint32_t orientation;
        int width;
        Codes upright;
    } cases[] = {{1, 3, {1, 2, 3, 4, 5, 6}}, {2, 3, {3, 2, 1, 6, 5, 4}}, {3, 3, {6, 5, 4, 3, 2, 1}},
                 {4, 3, {4, 5, 6, 1, 2, 3}}, {5, 2, {1, 4, 2, 5, 3, 6}}, {6, 2, {4, 1, 5, 2, 6, 3}},
                 {7, 2, {6, 3, 5, 2, 4, 1}}, {8, 2, {3, 6, 2, 5, 1, 4}}};
    for (const auto& c : cases) {
        const OwnFile file{".tif", tiff(3, 2, c.orientation, codes)};
        const TargetImage target = read_picture(file.path()).targets.at(0);
        INFO("orientation " << c.orientation);
        CHECK(target.width == c.width);
        CHECK(target.height == 6 / c.width);
        CHECK(target.codes == c.upright);
    }
}
