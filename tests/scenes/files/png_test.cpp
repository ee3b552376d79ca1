// Tests PNG output by a round trip, and conversions to 8 bits against codes worked out by hand.
#include <OpenImageIO/imageio.h>
#include <zlib.h>

#include <bit>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_decode.h"
#include "scenes/files/image_io.h"
#include "scenes/files/system_error.h"
#include "tests/scenes/image_support.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes;
using strata::pipeline::ColorSpace;
using strata::pipeline::Format;
using strata::pipeline::Image;
using strata::pipeline::ImageCodes;
using strata::test::TemporaryFolder;

namespace {

OutputColor one_pixel(Format format, ImageCodes codes) {
    OutputColor output{.color = Image{format, 1, 1}};
    output.color.codes = std::move(codes);
    return output;
}

ImageCodes floats(float r, float g, float b, float a) {
    return {std::bit_cast<std::uint32_t>(r), std::bit_cast<std::uint32_t>(g), std::bit_cast<std::uint32_t>(b),
            std::bit_cast<std::uint32_t>(a)};
}

}  // namespace

TEST_CASE("all 65536 pairs of colour and alpha are unchanged after a PNG round trip") {
    const TemporaryFolder folder;
    OutputColor output{.color = Image{Format::rgba8, 256, 256}};
    for (std::uint32_t i = 0; i < 65536; ++i) {
        const std::uint32_t pixel[4] = {i % 256, 255 - i % 256, i % 256 ^ 0x5a, i / 256};
        std::copy(pixel, pixel + 4, &output.color.codes[4 * i]);
    }
    write_image(folder / "a.png", output);
    const auto images = read_images(folder / "a.png");
    REQUIRE(images.size() == 1);
    CHECK(images[0].target == "color");
    CHECK(images[0].image == output.color);
    CHECK(digest(images[0].image) == digest(output.color));
}

TEST_CASE("the same image written a second later gives the same PNG bytes") {
    const TemporaryFolder folder;
    const OutputColor output{.color = strata::test::wild_image(Format::rgba8, 70, 33, 1),
                             .attributes = {{"command", "strata"}}};
    write_image(folder / "a.png", output);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    write_image(folder / "b.png", output);
    CHECK(strata::test::bytes_of(folder / "a.png") == strata::test::bytes_of(folder / "b.png"));
}

TEST_CASE("a float target becomes 8 bits by clamping and rounding the exact product with 255 half up") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(as_straight_rgba8(one_pixel(Format::rgba32f, floats(-1, 2, nan, 0.5f))).codes == ImageCodes{0, 255, 0, 128});
    const float half_code = 100.5f / 255;  // the float may be on either side of the half
    const auto expected = static_cast<std::uint32_t>(std::floor(double{half_code} * 255 + 0.5));
    CHECK(as_straight_rgba8(one_pixel(Format::rgba32f, floats(half_code, 0, 1, 1))).codes ==
          ImageCodes{expected, 0, 255, 255});
    CHECK(as_straight_rgba8(one_pixel(Format::rgba16f, {0x3800, 0x3c00, 0xbc00, 0x7c00})).codes ==
          ImageCodes{128, 255, 0, 255});  // 0.5, 1, -1, infinity
}

TEST_CASE("a premultiplied target is divided by its alpha and is black where alpha is 0") {
    OutputColor float_target = one_pixel(Format::rgba32f, floats(0.25f, 0.5f, 0.75f, 0.5f));
    float_target.premultiplied = true;
    CHECK(as_straight_rgba8(float_target).codes == ImageCodes{128, 255, 255, 128});
    int wrong = 0;
    for (std::uint32_t a = 0; a < 256; ++a) {
        for (std::uint32_t c = 0; c < 256; ++c) {
            OutputColor output = one_pixel(Format::rgba8, {c, c, c, a});
            output.premultiplied = true;
            const double expected = a == 0 ? 0 : std::min(255.0, std::floor(255.0 * c / a + 0.5));
            wrong += as_straight_rgba8(output).codes[0] == static_cast<std::uint32_t>(expected) ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("the colours of a linear target are encoded as sRGB and its alpha is not") {
    OutputColor output = one_pixel(Format::rgba32f, floats(0.5f, 0.0f, 1.0f, 0.5f));
    output.space = ColorSpace::linear;
    CHECK(as_straight_rgba8(output).codes == ImageCodes{188, 0, 255, 128});  // linear 0.5 in 8 bits
    OutputColor codes = one_pixel(Format::rgba8, {55, 0, 255, 7});
    codes.space = ColorSpace::linear;
    CHECK(as_straight_rgba8(codes).codes == ImageCodes{128, 0, 255, 7});  // 55/255 = 0.2157 encodes to 0.5018
}

TEST_CASE("a wrong file ending or a missing or damaged file is an input error and a missing folder a system error") {
    const TemporaryFolder folder;
    const OutputColor output = one_pixel(Format::rgba8, {1, 2, 3, 4});
    CHECK_THROWS_WITH(write_image(folder / "a.jpg", output), Catch::Contains("a file name that ends in .png or .exr"));
    CHECK_THROWS_AS(read_images(folder / "none.png"), strata::InputError);
    CHECK_THROWS_AS(write_image(folder / "no/a.png", output), strata::SystemError);
    CHECK(image_file("A.PNG") == ImageFile::png);
    write_image(folder / "a.png", {.color = strata::test::wild_image(Format::rgba8, 64, 64, 2)});
    const std::string bytes = strata::test::bytes_of(folder / "a.png");
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{40}, bytes.size() / 2}) {
        std::ofstream(folder / "cut.png", std::ios::binary) << bytes.substr(0, size);
        INFO("cut after " << size);
        CHECK_THROWS_AS(read_images(folder / "cut.png"), strata::InputError);
    }
}

TEST_CASE("a PNG without alpha is digested as opaque and a grey or 16-bit one is rejected") {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, int channels, OIIO::TypeDesc type) {
        const OIIO::ImageSpec spec{2, 1, channels, type};
        const auto output = OIIO::ImageOutput::create("png");
        const std::vector<std::byte> bytes(spec.image_bytes(), std::byte{77});
        REQUIRE((output->open(folder / name, spec) && output->write_image(type, bytes.data()) && output->close()));
    };
    write("rgb.png", 3, OIIO::TypeDesc::UINT8);
    write("grey.png", 1, OIIO::TypeDesc::UINT8);
    write("wide.png", 4, OIIO::TypeDesc::UINT16);
    CHECK(read_images(folder / "rgb.png")[0].image.codes == ImageCodes{77, 77, 77, 255, 77, 77, 77, 255});
    CHECK_THROWS_AS(read_images(folder / "grey.png"), strata::InputError);
    CHECK_THROWS_AS(read_images(folder / "wide.png"), strata::InputError);
}

TEST_CASE("a PNG that was cropped and has another place than 0 0 on its page is rejected with the place") {
    const TemporaryFolder folder;
    const std::string path = folder / "a.png";
    write_image(path, {.color = strata::test::wild_image(Format::rgba8, 3, 2, 1)});
    std::ifstream stream{path, std::ios::binary};
    const std::string plain{std::istreambuf_iterator<char>{stream}, {}};
    // The message of reading the file with a chunk oFFs of these bytes behind IHDR.
    const auto message = [&](std::string chunk) -> std::string {
        chunk = "oFFs" + chunk;
        const auto crc = static_cast<std::uint32_t>(
            ::crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size())));
        std::string bytes{"\0\0\0\x09", 4};
        bytes += chunk;
        for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(crc >> shift & 0xff);
        std::ofstream{path, std::ios::binary} << plain.substr(0, 33) << bytes << plain.substr(33);
        std::string found;
        for (const bool as_codes : {false, true}) try {
                if (as_codes)
                    static_cast<void>(read_codes(path, "png"));
                else
                    static_cast<void>(read_images(path));
            } catch (const strata::InputError& error) {
                found += error.what();
            }
        return found;
    };
    const std::string expected =
        path +
        ": place: expected a picture at 0,0 of its page, found 9,-4 (chunk oFFs: it was cropped; magick IN.png "
        "+repage OUT.png drops the place)";
    CHECK(message({"\0\0\0\x09\xff\xff\xff\xfc\0", 9}) == expected + expected);
    CHECK(message(std::string(9, '\0')).empty());
    CHECK(message({"\0\0\0\x09\0\0\0\0\x01", 9}).empty());  // micrometres: a place on paper
}
