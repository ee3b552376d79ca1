#include <bit>
#include <catch2/catch.hpp>
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

TEST_CASE(
    "every fragment comes back from a deep EXR, in its pixel and order, with code, primitive and premultiplied "
    "colour") {
    const TemporaryFolder folder;
    for (const int most : {0, 1, 40}) {
        const DeepFragments written = random_fragments(37, 23, most);
        write_deep(folder / "deep.exr", written, {{"command", "strata layers"}});
        DeepFragments expected = written;
        for (auto& color : expected.rgba)
            for (std::size_t c = 0; c < 3; ++c) color[c] *= color[3];
        CHECK(read_deep(folder / "deep.exr") == expected);
    }
}

TEST_CASE("depth codes and primitives of a deep EXR keep all 32 bits, and Z its NaN and signed zero") {
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

TEST_CASE("a deep file is not a flat one and a flat one not deep; a deep PNG does not exist") {
    const TemporaryFolder folder;
    write_deep(folder / "deep.exr", random_fragments(3, 3, 2), {});
    write_image(folder / "flat.exr", {.color = strata::pipeline::Image{strata::pipeline::Format::rgba8, 3, 3}});
    CHECK_THROWS_AS(read_images(folder / "deep.exr"), strata::InputError);
    CHECK_THROWS_AS(read_deep(folder / "flat.exr"), strata::InputError);
    CHECK_THROWS_AS(write_deep(folder / "deep.png", random_fragments(3, 3, 2), {}), strata::InputError);
    CHECK_THROWS_AS(write_deep(folder / "no/deep.exr", random_fragments(3, 3, 2), {}), strata::SystemError);
}
