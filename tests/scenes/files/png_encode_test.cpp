// Tests the PNG encoder against ISO/IEC 15948: chunks, checksums computed bit by bit, and rows unpacked by zlib and
// unfiltered by 9.2.
#include "scenes/images/png_encode.h"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <stdexcept>

using namespace strata::scenes;

namespace {

std::string bytes_of(const PngPicture& picture) {
    std::string bytes;
    CHECK(encode_png(picture, [&](const void* part, std::size_t size) {
              return bytes.append(static_cast<const char*>(part), size), true;
          }).empty());
    return bytes;
}

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<std::uint8_t>(bytes.at(at + i));
    return word;
}

// PNG 5.5: polynomial division, one bit at a time.
std::uint32_t check_sum(const std::string& bytes) {
    std::uint32_t sum = 0xffffffff;
    for (const char byte : bytes) {
        sum ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? sum >> 1 ^ 0xedb88320 : sum >> 1;
    }
    return ~sum;
}

struct Chunk {
    std::string type, data;
};

std::vector<Chunk> chunks_of(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at < bytes.size(); at += 12 + word_at(bytes, at)) {
        const std::size_t size = word_at(bytes, at);
        chunks.push_back({bytes.substr(at + 4, 4), bytes.substr(at + 8, size)});
        CHECK(word_at(bytes, at + 8 + size) == check_sum(bytes.substr(at + 4, 4 + size)));
    }
    return chunks;
}

// Paeth predictor: the one of a, b and c that is nearest to a + b - c.
int paeth(int a, int b, int c) {
    const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

// The codes of all rows of `width` bytes; `step` bytes per pixel.
std::string rows_of(const std::vector<Chunk>& chunks, std::size_t width, std::size_t height, std::size_t step) {
    std::string packed, rows((width + 1) * height + 1, '\0');
    for (const Chunk& chunk : chunks)
        if (chunk.type == "IDAT") packed += chunk.data;
    uLongf found = rows.size();
    CHECK(::uncompress(reinterpret_cast<Bytef*>(rows.data()), &found, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()) == Z_OK);
    REQUIRE(found == (width + 1) * height);
    std::string codes;
    for (std::size_t y = 0; y < height; ++y) {
        const auto filter = static_cast<unsigned char>(rows[y * (width + 1)]);
        CHECK(filter <= 4);
        for (std::size_t i = 0; i < width; ++i) {
            const auto at = [&](std::size_t up, std::size_t left) {
                const bool is_there = y >= up && i >= left;
                return is_there ? static_cast<unsigned char>(codes[(y - up) * width + i - left]) : 0;
            };
            const int a = at(0, step), b = at(1, 0), c = at(1, step);
            const int predicted[] = {0, a, b, (a + b) / 2, paeth(a, b, c)};
            codes += static_cast<char>(rows[y * (width + 1) + 1 + i] + predicted[filter]);
        }
    }
    return codes;
}

std::uint8_t code(int x, int y, int c) { return static_cast<std::uint8_t>(x * 37 + y * 101 + c * 59 + x * y); }

}  // namespace

TEST_CASE("a PNG has its texts first and then every row unchanged with and without alpha") {
    const int channels = GENERATE(3, 4), width = GENERATE(1, 7, 300);
    const PngPicture picture{
        .width = width,
        .height = 5,
        .channels = channels,
        .row =
            [&](int y, std::uint8_t* codes) {
                for (int i = 0; i < width * channels; ++i) codes[i] = code(i / channels, y, i % channels);
            },
        .texts = {{"Software", "strata"}, {"strata:command", std::string(70000, 'x') + "\xc3\xa9"}}};
    const std::vector<Chunk> chunks = chunks_of(bytes_of(picture));
    const auto color_type = static_cast<char>(channels == 3 ? 2 : 6);
    const std::string size{0, 0, static_cast<char>(width >> 8), static_cast<char>(width & 255), 0, 0, 0, 5};
    REQUIRE(chunks.size() > 4);
    CHECK(chunks[0].type == "IHDR");
    CHECK(chunks[0].data == size + std::string{8, color_type, 0, 0, 0});
    for (std::size_t i = 1; i < 3; ++i) CHECK(chunks[i].type == "tEXt");
    CHECK(chunks[1].data == std::string("Software\0strata", 15));
    CHECK(chunks[2].data == std::string("strata:command\0", 15) + std::string(70000, 'x') + "\xc3\xa9");
    CHECK(chunks.back().type == "IEND");
    std::string expected;
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) expected += static_cast<char>(code(x, y, c));
    const auto step = static_cast<std::size_t>(channels);
    CHECK((rows_of(chunks, static_cast<std::size_t>(width) * step, 5, step) == expected));
}

TEST_CASE("a PNG that cannot be written or whose rows cannot be made fails at the first error") {
    int rows = 0, parts = 0;
    const PngPicture picture{.width = 3000, .height = 3000, .row = [&](int y, std::uint8_t* codes) {
                                 ++rows;
                                 for (int i = 0; i < 12000; ++i)
                                     codes[i] = static_cast<std::uint8_t>(i * i * (y + 7) >> 3);
                             }};
    CHECK(encode_png(picture, [&](const void*, std::size_t) { return ++parts < 9; }) == "the file cannot be written");
    CHECK(parts == 9);
    CHECK(rows > 0);
    CHECK(rows < 3000);

    const auto keep = [](const void*, std::size_t) { return true; };
    const auto fails = [](const void*, std::size_t) -> bool { throw std::length_error("put"); };
    CHECK_THROWS_AS(encode_png(picture, fails), std::length_error);
    PngPicture broken = picture;
    broken.row = [](int y, std::uint8_t*) {
        if (y == 2) throw std::out_of_range("row");
    };
    CHECK_THROWS_AS(encode_png(broken, keep), std::out_of_range);
    broken = picture;
    broken.texts = {{"", "no keyword"}};
    CHECK(encode_png(broken, keep) == "tEXt: invalid keyword");
    broken = picture;
    broken.width = 0;
    CHECK_FALSE(encode_png(broken, keep).empty());
}
