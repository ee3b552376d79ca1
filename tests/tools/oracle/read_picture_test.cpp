// Model: files laid out here byte by byte, from the formats' own pages, and files that the project writes.
#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "tests/tools/oracle/own_file.h"
#include "tests/tools/oracle/pictures.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

std::string big_endian(std::uint32_t word) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
    return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = ~0u;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

// Rows without a filter in one stored block of deflate: fewer than 65,536 bytes.
std::string png(std::uint32_t width, std::uint32_t height, char bits, char type, const std::string& rows) {
    std::uint32_t low = 1, high = 0;
    for (const char c : rows) {
        low = (low + static_cast<unsigned char>(c)) % 65521;
        high = (high + low) % 65521;
    }
    const auto size = static_cast<std::uint32_t>(rows.size());
    std::string data{"\x78\x01\x01"};
    for (const std::uint32_t half : {size, ~size}) {
        data += static_cast<char>(half & 0xff);
        data += static_cast<char>(half >> 8 & 0xff);
    }
    data += rows + big_endian(high << 16 | low);
    const std::string header = big_endian(width) + big_endian(height) + bits + type + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", data) + chunk("IEND", "");
}

std::string npy(const std::string& header, const std::string& data) {
    std::string bytes{"\x93NUMPY\x01"};
    bytes += '\0';
    bytes += static_cast<char>(header.size() & 0xff);
    bytes += static_cast<char>(header.size() >> 8);
    return bytes + header + data;
}

}  // namespace

TEST_CASE("a PNG of 16 bits keeps all of them, and its number of channels") {
    using namespace std::string_literals;
    const OwnFile rgb{".png", png(2, 1, 16, 2, "\0\x12\x34\x00\x01\xff\xff\x80\x00\x7f\xff\x00\x00"s)};
    const Picture picture = read_picture(rgb.path());
    REQUIRE(picture.targets.size() == 1);
    const Target& target = picture.targets[0];
    CHECK(target.code == Code::unorm16);
    CHECK(target.channels == 3);
    CHECK(target.codes == std::vector<std::uint32_t>{0x1234, 0x0001, 0xffff, 0x8000, 0x7fff, 0x0000});
    const OwnFile grey{".png", png(3, 1, 8, 0, "\0\x07\x80\xff"s)};
    CHECK(read_picture(grey.path()).targets[0].codes == std::vector<std::uint32_t>{0x07, 0x80, 0xff});
    CHECK(read_picture(grey.path()).targets[0].channels == 1);
    const OwnFile straight{".png", png(1, 1, 8, 6, "\0\xc8\x64\x32\x80"s)};
    CHECK(read_picture(straight.path()).targets[0].codes == std::vector<std::uint32_t>{200, 100, 50, 128});
}

TEST_CASE("an array of NumPy's is read in its own type and shape") {
    using namespace std::string_literals;
    const OwnFile words{".npy", npy("{'descr': '<u4', 'fortran_order': False, 'shape': (1, 2), }\n",
                                    "\x01\x02\x03\x04\xff\xff\xff\xff"s)};
    const Target depth = read_picture(words.path()).targets[0];
    CHECK(depth.code == Code::integer);
    CHECK(depth.meaning == Meaning::depth);
    CHECK(depth.codes == std::vector<std::uint32_t>{0x04030201, 0xffffffff});
    const OwnFile halves{".npy", npy("{'descr': '<f2', 'fortran_order': False, 'shape': (2, 1, 2), }\n",
                                     "\x00\x3c\x00\x38\x00\x00\x00\x80"s)};
    const Target color = read_picture(halves.path()).targets[0];
    CHECK(color.width == 1);
    CHECK(color.height == 2);
    CHECK(color.channels == 2);
    CHECK(color.codes == std::vector<std::uint32_t>{0x3c00, 0x3800, 0x0000, 0x8000});
}

TEST_CASE("an array of another type, order or size is refused by the name of what is wrong") {
    const auto says = [](const std::string& header, const std::string& data, const std::string& words) {
        const OwnFile file{".npy", npy(header, data)};
        try {
            static_cast<void>(read_picture(file.path()));
        } catch (const strata::InputError& error) {
            INFO(error.what());
            CHECK(std::string(error.what()).find(words) != std::string::npos);
            return;
        }
        FAIL("was read: " << header);
    };
    says("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1), }", "12345678",
         "descr: expected elements |u1, <u2, <u4, <i4, <f2 or <f4, found '<f8'");
    says("{'descr': '<i4', 'fortran_order': False, 'shape': (1, 1), }", "1234",
         "descr: expected elements |u1, <u2, <u4, <f2 or <f4, found <i4");
    says("{'descr': '>f4', 'fortran_order': False, 'shape': (1, 1), }", "1234", "descr: ");
    says("{'descr': '<f4', 'fortran_order': True, 'shape': (1, 1), }", "1234", "fortran_order: ");
    says("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }", "1234", "size: expected 8 bytes");
    says("{'descr': '<f4', 'fortran_order': False, 'shape': (4,), }", "1234567812345678", "shape: ");
    says("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 5), }", "12345678123456781234", "shape: ");
}

TEST_CASE("bare numbers are read by their layout, from the top or from the bottom") {
    const OwnFile file{".raw", "abcdef"};
    const auto layout = [](const char* text) {
        const auto found = raw_layout(text);
        REQUIRE(found);
        return *found;
    };
    CHECK(read_picture(file.path(), layout("1x2:rgb8")).targets[0].codes ==
          std::vector<std::uint32_t>{'a', 'b', 'c', 'd', 'e', 'f'});
    CHECK(read_picture(file.path(), layout("1x2:rgb8:bottom-up")).targets[0].codes ==
          std::vector<std::uint32_t>{'d', 'e', 'f', 'a', 'b', 'c'});
    CHECK(read_picture(file.path(), layout("3x1:d16")).targets[0].codes ==
          std::vector<std::uint32_t>{0x6261, 0x6463, 0x6665});
    CHECK(layout("640x480:d24").meaning == Meaning::depth);
    CHECK(layout("640x480:rgba32f").code == Code::single);
    CHECK_THROWS_AS(read_picture(file.path(), layout("2x2:rgb8")), strata::InputError);
    CHECK_THROWS_AS(read_picture(file.path()), strata::InputError);
    for (const char* text : {"", "640x480", "640:rgba8", "x480:rgba8", "0x1:r8", "16385x1:r8", "1x1:bgra8", "1x1:rgba9",
                             "1x1:8", "1x1:rgba8:top-down"})
        CHECK_FALSE(raw_layout(text));
}

TEST_CASE("a file of this project's comes back with its codes, its parts and the meaning of each target") {
    using strata::pipeline::Format;
    strata::pipeline::Image color{Format::rgba8, 3, 2}, depth{Format::d24, 3, 2};
    for (std::size_t i = 0; i < color.codes.size(); ++i) color.codes[i] = static_cast<std::uint32_t>(i * 9);
    for (std::size_t i = 0; i < depth.codes.size(); ++i) depth.codes[i] = static_cast<std::uint32_t>(i * 2222222);
    const OwnFile file{".exr"};
    const strata::scenes::OutputColor layer{.color = color, .depth = depth};
    strata::scenes::write_layers(file.path(), std::array{layer, layer});
    const Picture picture = read_picture(file.path());
    REQUIRE(picture.targets.size() == 4);
    CHECK(picture.targets[0].part == "layer.000");
    CHECK(picture.targets[0].code == Code::unorm8);
    CHECK(std::ranges::equal(picture.targets[0].codes, color.codes));
    CHECK(picture.targets[3].part == "layer.001");
    CHECK(picture.targets[3].meaning == Meaning::depth);
    CHECK(picture.targets[3].code == Code::unorm24);
    CHECK(std::ranges::equal(picture.targets[3].codes, depth.codes));
}
