// Tests deep EXR files by a round trip of random fragments, and digests against the bytes of scenes/reference/images.md
// 5.
#include <xxhash.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdio>
#include <random>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "scenes/files/system_error.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes;
using strata::test::TemporaryFolder;

namespace {

DeepFragments random_fragments(int width, int height, int most) {
    std::mt19937 random{9};
    std::uniform_real_distribution<float> unit{0, 1};
    DeepFragments fragments{.width = width, .height = height};
    for (int pixel = 0; pixel < width * height; ++pixel) {
        const auto count = static_cast<std::uint32_t>(random() % static_cast<unsigned>(most + 1));
        fragments.count.push_back(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            fragments.depth_code.push_back(static_cast<std::uint32_t>(random()));
            fragments.z.push_back(unit(random));
            fragments.rgba.push_back({unit(random), unit(random), unit(random), unit(random)});
            fragments.primitive.push_back(static_cast<std::uint32_t>(random()));
        }
    }
    return fragments;
}

}  // namespace

TEST_CASE("every fragment is read from a deep EXR in its pixel and order with all of its values") {
    const TemporaryFolder folder;
    for (const int most : {0, 1, 40}) {
        const DeepFragments written = random_fragments(37, 23, most);
        write_deep(folder / "deep.exr", written, {{"command", "strata layers"}});
        DeepFragments expected = written;
        expected.premultiplied = true;
        for (auto& color : expected.rgba)
            for (std::size_t c = 0; c < 3; ++c) color[c] *= color[3];
        CHECK(read_deep(folder / "deep.exr") == expected);
    }
}

TEST_CASE("depth codes and primitives of a deep EXR keep all 32 bits and Z keeps NaN and signed zero") {
    const TemporaryFolder folder;
    const float nan = std::bit_cast<float>(0x7fc12345u);
    const DeepFragments written{.width = 1,
                                .height = 1,
                                .count = {3},
                                .depth_code = {0, 0xffffffff, 0x3f800001},
                                .z = {-0.0f, nan, 0x1p-149f},
                                .rgba = {{1, 1, 1, 1}, {0, 0, 0, 0}, {1, 1, 1, 0.5f}},
                                .primitive = {0xffffffff, 0, 0x80000000}};
    write_deep(folder / "deep.exr", written, {});
    const DeepFragments read = read_deep(folder / "deep.exr");
    CHECK(read.depth_code == written.depth_code);
    CHECK(read.primitive == written.primitive);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(std::bit_cast<std::uint32_t>(read.z[i]) == std::bit_cast<std::uint32_t>(written.z[i]));
}

TEST_CASE("samples of a pixel are deep parts of their own and are read back in order") {
    const TemporaryFolder folder;
    std::vector<DeepFragments> written;
    for (const int most : {3, 0, 9, 1}) {
        written.push_back(random_fragments(11, 7, most));
        written.back().premultiplied = true;
    }
    write_deep(folder / "deep.exr", written, {{"command", "strata layers"}});
    CHECK(read_deep_samples(folder / "deep.exr") == written);
    CHECK(read_deep(folder / "deep.exr") == written[0]);
    const std::vector<FileDigest> digests = digests_of(folder / "deep.exr");
    REQUIRE(digests.size() == 4);
    for (std::size_t sample = 0; sample < 4; ++sample) {
        CHECK(digests[sample].part == "sample." + std::to_string(sample));
        CHECK(digests[sample].digest == digest(written[sample]));
    }
}

TEST_CASE("reading a deep file as flat or a flat one as deep and writing a deep PNG are errors") {
    const TemporaryFolder folder;
    write_deep(folder / "deep.exr", random_fragments(3, 3, 2), {});
    write_image(folder / "flat.exr", {.color = strata::pipeline::Image{strata::pipeline::Format::rgba8, 3, 3}});
    CHECK_THROWS_AS(read_images(folder / "deep.exr"), strata::InputError);
    CHECK_THROWS_AS(read_deep(folder / "flat.exr"), strata::InputError);
    CHECK_THROWS_AS(write_deep(folder / "deep.png", random_fragments(3, 3, 2), {}), strata::InputError);
    CHECK_THROWS_AS(write_deep(folder / "no/deep.exr", random_fragments(3, 3, 2), {}), strata::SystemError);
}

// The bytes of scenes/reference/images.md 5, serialized here value by value, with the one-shot XXH3_128bits.
TEST_CASE("a deep digest is XXH3-128 of the documented bytes and the same before writing and after reading") {
    const DeepFragments fragments = random_fragments(5, 3, 4);
    std::string bytes{"deep"};
    bytes += '\0';
    const auto word = [&](std::uint32_t value) {
        for (int i = 0; i < 4; ++i, value /= 256) bytes += static_cast<char>(value % 256);
    };
    word(5);
    word(3);
    for (const std::uint32_t count : fragments.count) word(count);
    for (std::size_t i = 0; i < fragments.z.size(); ++i) {
        const auto& color = fragments.rgba[i];
        for (std::size_t c = 0; c < 3; ++c) word(std::bit_cast<std::uint32_t>(color[c] * color[3]));
        word(std::bit_cast<std::uint32_t>(color[3]));
        word(std::bit_cast<std::uint32_t>(fragments.z[i]));
        word(fragments.depth_code[i]);
        word(fragments.primitive[i]);
    }
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    char expected[33];
    std::snprintf(expected, sizeof expected, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                  static_cast<unsigned long long>(hash.low64));
    CHECK(digest(fragments) == expected);
    const TemporaryFolder folder;
    write_deep(folder / "deep.exr", fragments, {});
    CHECK(digest(read_deep(folder / "deep.exr")) == expected);
    CHECK(digests_of(folder / "deep.exr").front().digest == expected);
}
