// Tests digests against the bytes of pipeline/reference/formats.md 8, serialized here field by field, with the one-shot
// XXH3_128bits.
#include <xxhash.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <random>

#include "pipeline/formats/image.h"

namespace {

using strata::pipeline::Format;
using strata::pipeline::Image;

struct Stored {
    Format format;
    const char* name;
    int channels, bytes;
};
constexpr Stored formats[] = {
    {Format::rgba8, "rgba8", 4, 1}, {Format::rgba16f, "rgba16f", 4, 2}, {Format::rgba32f, "rgba32f", 4, 4},
    {Format::r16f, "r16f", 1, 2},   {Format::r32f, "r32f", 1, 4},       {Format::rg32f, "rg32f", 2, 4},
    {Format::d16, "d16", 1, 4},     {Format::d24, "d24", 1, 4},         {Format::d24s8, "d24s8", 1, 4},
    {Format::d32f, "d32f", 1, 4},   {Format::s8, "s8", 1, 1},
};

void append(std::string& bytes, std::uint32_t word, int count) {
    for (int i = 0; i < count; ++i) {
        bytes += static_cast<char>(word % 256);
        word /= 256;
    }
}

std::string expected_digest(const Image& image, const Stored& stored) {
    std::string bytes = stored.name;
    bytes += '\0';
    append(bytes, static_cast<std::uint32_t>(image.width), 4);
    append(bytes, static_cast<std::uint32_t>(image.height), 4);
    append(bytes, static_cast<std::uint32_t>(image.samples), 4);
    for (const std::uint32_t code : image.codes) append(bytes, code, stored.bytes);
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                  static_cast<unsigned long long>(hash.low64));
    return text;
}

}  // namespace

TEST_CASE("a digest is XXH3-128 of name and size and codes for every format and sample count") {
    std::mt19937 random{1};
    for (const Stored& stored : formats) {
        for (const int size : {0, 1, 3, 17, 129}) {
            for (const int samples : {1, 4}) {
                Image image{stored.format, size, size + 1, samples};
                for (auto& code : image.codes)
                    code = static_cast<std::uint32_t>(random() & ((std::uint64_t{1} << (8 * stored.bytes)) - 1));
                INFO(stored.name << " " << size << " samples " << samples);
                CHECK(digest(image) == expected_digest(image, stored));
            }
        }
    }
}

TEST_CASE("digests of fixed images are these strings on every machine") {
    Image color{Format::rgba8, 2, 2};
    for (std::size_t i = 0; i < color.codes.size(); ++i) color.codes[i] = static_cast<std::uint32_t>(17 * i % 256);
    Image depth{Format::d24, 3, 1};
    depth.codes = {0, 0x123456, 0xffffff};
    Image half{Format::rgba16f, 1, 1};
    half.codes = {0x7e01, 0x8000, 0x3c00, 0xfc00};
    CHECK(digest(color) == "4d2c3ecc266544abc02e30afd2764738");
    CHECK(digest(depth) == "f8c8c07227c9ee941a264c4f0a32c682");
    CHECK(digest(half) == "ab4a7be7b8890896e69cfd2fb60ca4e4");
}

TEST_CASE("digests differ for images with equal codes and another format or shape") {
    const Image wide{Format::rgba8, 4, 1}, tall{Format::rgba8, 1, 4}, sampled{Format::rgba8, 1, 1, 4};
    const Image d16{Format::d16, 4, 1}, d24{Format::d24, 4, 1};
    CHECK(digest(wide) != digest(tall));
    CHECK(digest(wide) != digest(sampled));
    CHECK(digest(d16) != digest(d24));
}
