// Tests the readers of picture files on files that are written here byte by byte from the formats' specifications, and
// on files that the project writes.
#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "tests/tools/oracle/picture/own_file.h"
#include "tests/tools/oracle/picture/pictures.h"
#include "tools/oracle/picture/numbers_file.h"

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

// Unfiltered rows in one stored deflate block of fewer than 65,536 bytes.
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

TEST_CASE("a 16-bit PNG keeps all bits and its number of channels") {
    using namespace std::string_literals;
    const OwnFile rgb{".png", png(2, 1, 16, 2, "\0\x12\x34\x00\x01\xff\xff\x80\x00\x7f\xff\x00\x00"s)};
    const Picture picture = read_picture(rgb.path());
    REQUIRE(picture.targets.size() == 1);
    const TargetImage& target = picture.targets[0];
    CHECK(target.code == Code::unorm16);
    CHECK(target.channels == 3);
    CHECK(target.codes == std::vector<std::uint32_t>{0x1234, 0x0001, 0xffff, 0x8000, 0x7fff, 0x0000});
    const OwnFile grey{".png", png(3, 1, 8, 0, "\0\x07\x80\xff"s)};
    CHECK(read_picture(grey.path()).targets[0].codes == std::vector<std::uint32_t>{0x07, 0x80, 0xff});
    CHECK(read_picture(grey.path()).targets[0].channels == 1);
    const OwnFile straight{".png", png(1, 1, 8, 6, "\0\xc8\x64\x32\x80"s)};
    CHECK(read_picture(straight.path()).targets[0].codes == std::vector<std::uint32_t>{200, 100, 50, 128});
}

TEST_CASE("a NumPy array is read in its own type and shape") {
    using namespace std::string_literals;
    const OwnFile words{".npy", npy("{'descr': '<u4', 'fortran_order': False, 'shape': (1, 2), }\n",
                                    "\x01\x02\x03\x04\xff\xff\xff\xff"s)};
    const TargetImage depth = read_picture(words.path()).targets[0];
    CHECK(depth.code == Code::integer);
    CHECK(depth.meaning == Meaning::depth);
    CHECK(depth.codes == std::vector<std::uint32_t>{0x04030201, 0xffffffff});
    const OwnFile halves{".npy", npy("{'descr': '<f2', 'fortran_order': False, 'shape': (2, 1, 2), }\n",
                                     "\x00\x3c\x00\x38\x00\x00\x00\x80"s)};
    const TargetImage color = read_picture(halves.path()).targets[0];
    CHECK(color.width == 1);
    CHECK(color.height == 2);
    CHECK(color.channels == 2);
    CHECK(color.codes == std::vector<std::uint32_t>{0x3c00, 0x3800, 0x0000, 0x8000});
}

TEST_CASE("an array of 16-bit words holds rgb10_a2 only if its colours and alphas are codes of that format") {
    const auto code_of_two_pixels = [](const std::array<std::uint16_t, 8>& words) {
        std::string data;
        for (const unsigned word : words) data += {static_cast<char>(word & 0xffu), static_cast<char>(word >> 8)};
        const OwnFile file{".npy", npy("{'descr': '<u2', 'fortran_order': False, 'shape': (1, 2, 4), }\n", data)};
        return read_picture(file.path()).targets.at(0).code;
    };
    CHECK(code_of_two_pixels({0, 1023, 7, 1023, 5, 6, 7, 0}) == Code::unorm10);
    CHECK(code_of_two_pixels({0, 1023, 7, 341, 5, 6, 7, 682}) == Code::unorm10);
    CHECK(code_of_two_pixels({0, 1024, 7, 1023, 5, 6, 7, 0}) == Code::unorm16);  // a colour above 1023
    CHECK(code_of_two_pixels({0, 1023, 7, 1022, 5, 6, 7, 0}) == Code::unorm16);  // no such alpha
    CHECK(code_of_two_pixels({0, 1023, 7, 1364, 5, 6, 7, 0}) == Code::unorm16);  // 4 times 341
    CHECK(code_of_two_pixels({0, 1023, 7, 0, 5, 6, 7, 0}) == Code::unorm16);     // both invisible
}

TEST_CASE("an array of another type or order or size is rejected with a message that names the fault") {
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

TEST_CASE("raw numbers are read by their layout from the top or from the bottom") {
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
    for (const char* text : {"8x8:x8d24", "8x8:s8d24", "8x8:d24s8"}) CHECK(layout(text).code == Code::unorm24);
    CHECK(layout("640x480:rgba32f").code == Code::single);
    CHECK_THROWS_AS(read_picture(file.path(), layout("2x2:rgb8")), strata::InputError);
    CHECK_THROWS_AS(read_picture(file.path()), strata::InputError);
    for (const char* text : {"", "640x480", "640:rgba8", "x480:rgba8", "0x1:r8", "16385x1:r8", "1x1:gbra8", "1x1:rgba9",
                             "1x1:8", "1x1:rgba8:top-down", "1x1:bgra16", "1x1:rgba8:offset=0", "1x1:rgba8:offset=x",
                             "1x1:rgba8:stride=3", "1x1:rgba8:stride=4:stride=4", "1x1:r8:bottom-up:bottom-up"})
        CHECK_FALSE(raw_layout(text));
}

TEST_CASE("raw numbers may be in the order blue first or in packed values or after a header or in padded rows") {
    const auto codes = [](const char* text, const std::string& bytes) {
        return raw_target(bytes, "memory", raw_layout(text).value()).codes;
    };
    using Codes = std::vector<std::uint32_t>;
    CHECK(codes("1x1:bgra8", {1, 2, 3, 4}) == Codes{3, 2, 1, 4});
    CHECK(codes("2x1:bgr8", {1, 2, 3, 4, 5, 6}) == Codes{3, 2, 1, 6, 5, 4});
    // From the lowest bit up: 1023, 1, 512 and 2; the 2-bit value is 2 / 3 = 682 / 1023.
    const std::uint32_t word = 1023u | 1u << 10 | 512u << 20 | 2u << 30;
    std::string packed;
    for (int shift = 0; shift < 32; shift += 8) packed += static_cast<char>(word >> shift & 0xff);
    CHECK(codes("1x1:rgb10a2", packed) == Codes{1023, 1, 512, 682});
    CHECK(codes("1x1:bgr10a2", packed) == Codes{512, 1, 1023, 682});
    CHECK(raw_target(packed, "memory", raw_layout("1x1:rgb10a2").value()).code == Code::unorm10);
    // A word of 32 bits with 24 bits of depth, lowest byte first.
    const std::string depth{4, 5, 6, 7};
    for (const char* text : {"1x1:x8d24", "1x1:s8d24"}) CHECK(codes(text, depth) == Codes{0x060504});
    CHECK(codes("1x1:d24s8", depth) == Codes{0x070605});
    CHECK(codes("1x1:d24", {4, 5, 6, 0}) == Codes{0x060504});
    CHECK_THROWS_WITH(codes("1x2:d24", {4, 5, 6, 0, 4, 5, 6, 7}),
                      "memory: pixel 0,1: expected a depth of 24 bits with 0 in the upper byte (x8d24 or s8d24: the "
                      "upper byte is something else; d24s8: the lower one is), found 0x07060504");
    // Two bytes of header; rows of 3 bytes whose last byte is padding.
    const std::string rows{9, 9, 1, 2, 0, 3, 4, 0};
    CHECK(codes("2x2:r8:offset=2:stride=3", rows) == Codes{1, 2, 3, 4});
    CHECK(codes("2x2:r8:stride=3:bottom-up:offset=2", rows) == Codes{3, 4, 1, 2});
    CHECK(codes("2x2:r8:offset=2:stride=3", rows.substr(0, 7)) == Codes{1, 2, 3, 4});  // the last row may be unpadded
    CHECK_THROWS_WITH(codes("2x2:r8:offset=2:stride=3", rows.substr(0, 6)),
                      "memory: size: expected 8 bytes (offset 2, 2 rows of 3 bytes), found 6 bytes");
}

TEST_CASE("PPM PGM TGA and BMP files have the codes of their bytes with the top row first") {
    using namespace std::string_literals;
    using Codes = std::vector<std::uint32_t>;
    const auto read = [](const char* ending, const std::string& bytes) {
        const OwnFile file{ending, bytes};
        const Picture picture = read_picture(file.path());
        REQUIRE(picture.targets.size() == 1);
        return picture.targets[0];
    };
    const Codes expected{1, 2, 3, 40, 50, 60, 7, 8, 9, 100, 110, 120};
    const TargetImage ppm = read(".ppm", "P6\n2 2\n255\n\x01\x02\x03\x28\x32\x3c\x07\x08\x09\x64\x6e\x78"s);
    CHECK(ppm.codes == expected);
    CHECK(ppm.channels == 3);
    CHECK(ppm.alpha_form == AlphaForm::straight);
    const TargetImage wide = read(".PPM", "P6 1 1 65535\n\x12\x34\x00\x01\xff\xff"s);
    CHECK(wide.code == Code::unorm16);
    CHECK(wide.codes == Codes{0x1234, 1, 0xffff});
    CHECK(read(".pgm", "P5\n# made by hand\n3 1\n1023\n\x00\x01\x02\x00\x03\xff"s).codes == Codes{64, 32800, 65535});
    CHECK(read(".pgm", "P2 4 1 7 0 1 6 7\n"s).codes == Codes{0, 36, 219, 255});
    CHECK(read(".ppm", "P3 1 1 300 300 150 1 "s).codes == Codes{65535, 32768, 218});
    const TargetImage pgm = read(".pgm", "P5 2 1 255\n\x05\xff"s);
    CHECK(pgm.is_grey);
    CHECK(pgm.codes == Codes{5, 255});
    // 18 bytes of header: uncompressed (2) or run-length coded (10), 2 x 2 pixels of 24 bits, top row first (0x20);
    // blue, green, red.
    const auto tga = [](char type, char bits, char order) {
        return "\0\0"s + type + "\0\0\0\0\0\0\0\0\0\2\0\2\0"s + bits + order;
    };
    const std::string pixels = "\x03\x02\x01\x3c\x32\x28\x09\x08\x07\x78\x6e\x64"s;
    CHECK(read(".tga", tga(2, 24, 0x20) + pixels).codes == expected);
    CHECK(read(".tga", tga(2, 24, 0) + pixels.substr(6) + pixels.substr(0, 6)).codes == expected);
    CHECK(read(".tga", tga(10, 24, 0x20) + "\x81\x03\x02\x01\x01\x09\x08\x07\x78\x6e\x64"s).codes ==
          Codes{1, 2, 3, 1, 2, 3, 7, 8, 9, 100, 110, 120});
    CHECK(read(".tga", tga(2, 32, 0x28) + "\x01\x02\x03\x80\1\1\1\1\2\2\2\2\3\3\3\3"s).codes[3] == 0x80);
    // not premultiplied
    CHECK(read(".tga", tga(2, 32, 0x28) + "\x01\x02\x03\x80\1\1\1\1\2\2\2\2\3\3\3\3"s).codes[0] == 3);
    // 14 + 40 bytes of header; rows of 8 bytes, the bottom row first.
    const auto bmp = [](char bits, const std::string& rows) {
        return "BM"s + "\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0"s + bits + std::string(25, '\0') +
               rows;
    };
    CHECK(read(".bmp", bmp(24, "\x09\x08\x07\x78\x6e\x64\0\0\x03\x02\x01\x3c\x32\x28\0\0"s)).codes == expected);
    const TargetImage unused = read(".bmp", bmp(32, "\x09\x08\x07\0\x78\x6e\x64\0\x03\x02\x01\0\x3c\x32\x28\0"s));
    CHECK(unused.channels == 3);  // a fourth byte that is 0 in every pixel is not alpha
    CHECK(unused.codes == expected);
}

TEST_CASE("Radiance HDR is read as binary32 from its shared exponents") {
    using namespace std::string_literals;
    // (r, g, b, e) is r / 256 2^(e - 128); the library returns the middle of a step or its lower end, within 2^-8 of
    // it.
    const OwnFile file{".hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x82\x00\x00\x00\x00"s};
    const TargetImage target = read_picture(file.path()).targets.at(0);
    CHECK(target.code == Code::single);
    CHECK(target.channels == 3);
    CHECK(target.value_at(0, 0) == Approx(2).epsilon(1.0 / 128));
    CHECK(target.value_at(0, 1) == Approx(1).epsilon(1.0 / 64));
    CHECK(target.value_at(1, 2) == 0);
}

TEST_CASE(
    "a picture that is truncated or of another kind or claims more pixels than its bytes hold is rejected by name") {
    using namespace std::string_literals;
    const auto refused = [](const char* ending, const std::string& bytes) {
        const OwnFile file{ending, bytes};
        CHECK_THROWS_AS(read_picture(file.path()), strata::InputError);
    };
    refused(".ppm", "P6 2 2 255\n\x01\x02"s);
    refused(".ppm", "P6 16384 16384 255\n\x01\x02"s);
    refused(".ppm", "P6 0 2 255\n"s);
    refused(".ppm", "P6 1 1 0\n\1\1\1"s);
    // A strip beyond the file, for which the reader gives zeros.
    const auto entry = [](char tag, char type, const std::string& value) {
        return tag + "\1"s + type + "\0\1\0\0\0"s + value;
    };
    refused(".tif", "II*\0\x08\0\0\0\x07\0"s + entry(0, 3, "\4\0\0\0"s) + entry(1, 3, "\4\0\0\0"s) +
                        entry(2, 3, "\x08\0\0\0"s) + entry(6, 3, "\1\0\0\0"s) + entry('\x11', 4, "\0\1\0\0"s) +
                        entry('\x16', 3, "\4\0\0\0"s) + entry('\x17', 4, "\x10\0\0\0"s) + "\0\0\0\0"s);
    refused(".tga", "\x89PNG\r\n\x1a\n"s);
    // 70 bytes, whose 16 bytes of pixels begin one byte after their place, and after the end, where the reader gives 0.
    for (const char offset : {'\x37', '\x47'})
        refused(".bmp", "BM\0\0\0\0\0\0\0\0"s + offset + "\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18"s +
                            std::string(25, '\0') + std::string(16, '\1'));
    refused(".bmp", "BM"s);
    refused(".bmp", "");
    refused(".jpg", "P6 1 1 255\n\1\2\3"s);
    refused(".hdr", "#?RADIANCE\n"s);
    refused(".tif", "II*\0"s);
    const OwnFile pointer{".png", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12345\n"};
    CHECK_THROWS_WITH(read_picture(pointer.path()), Catch::EndsWith(": a Git LFS pointer, run git lfs pull"));
    const OwnFile exr{".exr", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12345\n"};
    CHECK_THROWS_WITH(read_picture(exr.path()), Catch::EndsWith("found a Git LFS pointer, run git lfs pull"));
}

TEST_CASE("a file written by this project is read with its codes and parts and the meaning of each target") {
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
