// Tests `strata info --digests` on PNG files that the test writes byte by byte: equal codes have equal digests however
// the file is compressed, and one changed bit changes the digest. The format and the size printed are those written.
#include <zlib.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <set>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

// Samples are written unchanged, the high byte first.
struct Samples {
    int width, height, channels, bits;  // 1, 3 or 4 channels of 8 or 16 bits
    std::vector<std::uint32_t> codes;
};

std::string word_bytes(std::uint32_t word) {
    return {static_cast<char>(word >> 24), static_cast<char>(word >> 16), static_cast<char>(word >> 8),
            static_cast<char>(word)};
}

std::string png_chunk(const std::string& name, const std::string& data) {
    const std::string both = name + data;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(both.data()), static_cast<uInt>(both.size()));
    return word_bytes(static_cast<std::uint32_t>(data.size())) + both + word_bytes(static_cast<std::uint32_t>(sum));
}

// `level`: zlib's compression level.
void write_samples(const std::string& path, const Samples& samples, int level = 6) {
    std::string rows;
    std::size_t next = 0;
    for (int y = 0; y < samples.height; ++y) {
        rows += '\0';
        for (int i = 0; i < samples.width * samples.channels; ++i, ++next) {
            if (samples.bits == 16) rows += static_cast<char>(samples.codes[next] >> 8);
            rows += static_cast<char>(samples.codes[next]);
        }
    }
    uLongf room = compressBound(static_cast<uLong>(rows.size()));
    std::string packed(room, '\0');
    REQUIRE(compress2(reinterpret_cast<Bytef*>(packed.data()), &room, reinterpret_cast<const Bytef*>(rows.data()),
                      static_cast<uLong>(rows.size()), level) == Z_OK);
    packed.resize(room);
    const char color_type = samples.channels == 1 ? 0 : samples.channels == 3 ? 2 : 6;
    const std::string header = word_bytes(static_cast<std::uint32_t>(samples.width)) +
                               word_bytes(static_cast<std::uint32_t>(samples.height)) +
                               std::string{static_cast<char>(samples.bits), color_type, 0, 0, 0};
    std::ofstream(path, std::ios::binary)
        << "\x89PNG\r\n\x1a\n"
        << png_chunk("IHDR", header) << png_chunk("IDAT", packed) << png_chunk("IEND", "");
}

Samples some_samples(int channels, int bits) {
    Samples samples{5, 3, channels, bits, {}};
    for (int i = 0; i < 15 * channels; ++i)
        samples.codes.push_back(static_cast<std::uint32_t>(i * 2654435761u) >> (32 - bits));
    return samples;
}

// The line below the column titles.
std::string digest_line(const Folder& folder, const std::string& file) {
    const CommandResult ended = run_strata(folder, {"info", "--digests", file});
    INFO(ended.err);
    REQUIRE(ended.status == 0);
    return lines_of(ended.out).at(1);
}

}  // namespace

TEST_CASE("the digest of a grey or RGB or 16-bit PNG file is that of its own codes at every compression level") {
    const Folder folder;
    std::set<std::string> digests;
    for (const auto& [channels, bits, format] :
         {std::tuple{1, 8, "r/unorm8"}, {1, 16, "r/unorm16"}, {3, 16, "rgb/unorm16"}, {4, 16, "rgba/unorm16"}}) {
        INFO(format);
        Samples samples = some_samples(channels, bits);
        write_samples(folder / "a.png", samples);
        write_samples(folder / "b.png", samples, 0);
        const std::string line = digest_line(folder, "a.png");
        CHECK(line.find(" " + std::string(format) + " ") != std::string::npos);
        CHECK(line.find(" 5x3 ") != std::string::npos);
        CHECK(digest_line(folder, "b.png").substr(0, 32) == line.substr(0, 32));
        digests.insert(line.substr(0, 32));
        samples.codes.back() ^= 1;
        write_samples(folder / "c.png", samples);
        CHECK(digest_line(folder, "c.png").substr(0, 32) != line.substr(0, 32));
        const CommandResult channel_digests = run_strata(folder, {"info", "--digests", "--channels", "a.png"});
        CHECK(lines_of(channel_digests.out).size() == static_cast<std::size_t>(channels) + 1);
        CHECK(run_strata(folder, {"info", "--digests", "--expect", line.substr(0, 32), "a.png"}).status == 0);
    }
    CHECK(digests.size() == 4);
}

TEST_CASE("the digest of an 8-bit RGB PNG is that of the picture with alpha 1") {
    const Folder folder;
    Samples rgb = some_samples(3, 8), rgba{5, 3, 4, 8, {}};
    for (std::size_t pixel = 0; pixel < 15; ++pixel)
        for (std::size_t c = 0; c < 4; ++c) rgba.codes.push_back(c == 3 ? 255 : rgb.codes[3 * pixel + c]);
    write_samples(folder / "rgb.png", rgb);
    write_samples(folder / "rgba.png", rgba);
    CHECK(digest_line(folder, "rgb.png").substr(0, 32) == digest_line(folder, "rgba.png").substr(0, 32));
}
