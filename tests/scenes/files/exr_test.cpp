// Tests EXR files: OpenImageIO's own reader gives what other programs see, and codes must be unchanged in every bit
// after a round trip.
#include <OpenImageIO/imageio.h>

#include <bit>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "pipeline/formats/half.h"
#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "scenes/files/system_error.h"
#include "tests/scenes/image_support.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes;
using strata::pipeline::Format;
using strata::pipeline::Image;
using strata::test::TemporaryFolder;
using strata::test::wild_image;

namespace {

std::vector<Format> formats(bool (*is_one)(Format)) {
    std::vector<Format> all;
    for (const Format format : strata::enum_values<Format>)
        if (is_one(format)) all.push_back(format);
    return all;
}
const std::vector<Format> colors = formats(strata::pipeline::is_color), depths = formats(strata::pipeline::is_depth);

std::vector<float> channel(OIIO::ImageInput& input, const std::string& name) {
    const OIIO::ImageSpec spec = input.spec();
    const int index = spec.channelindex(name);
    REQUIRE(index >= 0);
    std::vector<float> values(std::size_t(spec.width) * std::size_t(spec.height));
    REQUIRE(input.read_image(0, 0, index, index + 1, OIIO::TypeDesc::FLOAT, values.data()));
    return values;
}

}  // namespace

TEST_CASE("targets full of NaN payloads and extreme codes have the same digest after an EXR round trip") {
    const TemporaryFolder folder;
    for (const Format color : colors) {
        for (const Format depth : depths) {
            for (const bool premultiplied : {false, true}) {
                const OutputColor output{.color = wild_image(color, 131, 67, 5),
                                         .depth = wild_image(depth, 131, 67, 6),
                                         .premultiplied = premultiplied};
                write_image(folder / "a.exr", output);
                const auto images = read_images(folder / "a.exr");
                INFO(info(color).name << " " << info(depth).name << (premultiplied ? " premultiplied" : " straight"));
                REQUIRE(images.size() == 2);
                CHECK(images[0].target == "color");
                CHECK(images[0].image == output.color);
                CHECK(digest(images[0].image) == digest(output.color));
                CHECK(images[1].target == "depth");
                CHECK(digest(images[1].image) == digest(output.depth));
            }
        }
    }
}

TEST_CASE("all 65536 halves survive an EXR as native channels and as codes") {
    const TemporaryFolder folder;
    OutputColor output{.color = Image{Format::rgba16f, 128, 128}, .premultiplied = true};
    for (std::uint32_t i = 0; i < 65536; ++i) output.color.codes[i] = i;
    write_image(folder / "a.exr", output);
    CHECK(read_images(folder / "a.exr")[0].image == output.color);
    output.premultiplied = false;
    write_image(folder / "b.exr", output);
    CHECK(read_images(folder / "b.exr")[0].image == output.color);
}

TEST_CASE("other programs see premultiplied colours and the depth's value in an EXR") {
    const TemporaryFolder folder;
    OutputColor output{.color = Image{Format::rgba8, 2, 1}, .depth = Image{Format::d24, 2, 1}};
    output.color.codes = {255, 51, 0, 102, 255, 255, 255, 255};
    output.depth.codes = {0x7fffff, 0xffffff};
    write_image(folder / "a.exr", output);
    const auto input = OIIO::ImageInput::open(folder / "a.exr");
    REQUIRE(input);
    CHECK(channel(*input, "R") == std::vector<float>{102.0f / 255, 1});
    CHECK(channel(*input, "G")[0] == Approx(0.2 * 0.4));
    CHECK(channel(*input, "A") == std::vector<float>{102.0f / 255, 1});
    CHECK(channel(*input, "Z")[0] == Approx(8388607.0 / 16777215));
    CHECK(input->spec().channelformat(input->spec().channelindex("Zbits")) == OIIO::TypeDesc::UINT32);
}

TEST_CASE("an EXR stores the command and digests and formats but no time or host or path") {
    const TemporaryFolder folder;
    const OutputColor output{.color = wild_image(Format::rgba8, 9, 9, 1),
                             .depth = wild_image(Format::d24, 9, 9, 2),
                             .attributes = {{"command", "strata render teapot"}, {"profile", "geforce8"}}};
    write_image(folder / "a.exr", output);
    const auto input = OIIO::ImageInput::open(folder / "a.exr");
    REQUIRE(input);
    const auto text = [&](const char* name) { return std::string{input->spec().get_string_attribute(name)}; };
    CHECK(text("strata:command") == "strata render teapot");
    CHECK(text("strata:profile") == "geforce8");
    CHECK(text("strata:colour") == "encoded");
    CHECK(text("strata:format.color") == "rgba8");
    CHECK(text("strata:format.depth") == "d24");
    CHECK(text("strata:digest.color") == digest(output.color));
    CHECK(text("strata:digest.depth") == digest(output.depth));
    CHECK(text("DateTime").empty());
    CHECK(strata::test::bytes_of(folder / "a.exr").find(folder.path) == std::string::npos);
}

TEST_CASE("an EXR states for viewers whether its colours are sRGB or linear in every part and when deep") {
    using strata::pipeline::ColorSpace;
    const TemporaryFolder folder;
    for (const ColorSpace space : {ColorSpace::encoded, ColorSpace::linear}) {
        const OutputColor output{.color = wild_image(Format::rgba8, 9, 9, 1), .space = space};
        write_image(folder / "a.exr", output);
        write_layers(folder / "b.exr", std::vector<OutputColor>(3, output));
        write_deep(folder / "c.exr", {.width = 1, .height = 1, .space = space, .count = {0}}, {});
        for (const char* name : {"a.exr", "b.exr", "c.exr"}) {
            const auto input = OIIO::ImageInput::open(folder / name);
            REQUIRE(input);
            int parts = 0;
            for (; input->seek_subimage(parts, 0); ++parts) {
                const OIIO::ImageSpec spec = input->spec();
                const bool is_encoded = space == ColorSpace::encoded;
                CHECK(spec.get_string_attribute("oiio:ColorSpace") == (is_encoded ? "sRGB" : "Linear"));
                CHECK(spec.get_string_attribute("colorInteropID") ==
                      (is_encoded ? "srgb_rec709_scene" : "lin_rec709_scene"));
                const auto* primaries = spec.find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8));
                REQUIRE(primaries != nullptr);
                CHECK(static_cast<const float*>(primaries->data())[0] == 0.64f);
            }
            CHECK(parts == (name[0] == 'b' ? 3 : 1));
            (void)input->geterror();
        }
    }
}

TEST_CASE("the same image written a second later gives the same EXR bytes in parts and deep as well") {
    const TemporaryFolder folder;
    const OutputColor output{.color = wild_image(Format::rgba16f, 70, 133, 1),
                             .depth = wild_image(Format::d32f, 70, 133, 2)};
    const std::vector<OutputColor> layers(3, output);
    DeepFragments deep{.width = 1,
                       .height = 1,
                       .count = {1},
                       .depth_code = {7},
                       .z = {0.5f},
                       .rgba = {{1, 1, 1, 1}},
                       .primitive = {3}};
    for (const char* run : {"1", "2"}) {
        write_image(folder / (run + std::string{"a.exr"}), output);
        write_layers(folder / (run + std::string{"b.exr"}), layers);
        write_deep(folder / (run + std::string{"c.exr"}), deep, {});
        std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    }
    for (const char* name : {"a.exr", "b.exr", "c.exr"})
        CHECK(strata::test::bytes_of(folder / ("1" + std::string{name})) ==
              strata::test::bytes_of(folder / ("2" + std::string{name})));
}

TEST_CASE("layers are the parts layer.000 layer.001 and so on with their own codes and attributes") {
    const TemporaryFolder folder;
    std::vector<OutputColor> layers;
    for (unsigned i = 0; i < 12; ++i) {
        layers.push_back({.color = wild_image(Format::rgba8, 33, 21, i),
                          .depth = wild_image(Format::d32f, 33, 21, 100 + i),
                          .attributes = {{"layer", std::to_string(i)}}});
    }
    write_layers(folder / "layers.exr", layers);
    const auto images = read_images(folder / "layers.exr");
    REQUIRE(images.size() == 24);
    for (std::size_t i = 0; i < 12; ++i) {
        const std::string name = (i < 10 ? "layer.00" : "layer.0") + std::to_string(i);
        CHECK(images[2 * i].part == name);
        CHECK(images[2 * i].image == layers[i].color);
        CHECK(images[2 * i + 1].part == name);
        CHECK(images[2 * i + 1].image == layers[i].depth);
    }
    CHECK_THROWS_AS(write_layers(folder / "layers.png", layers), strata::InputError);
}

TEST_CASE("an EXR by another program is digested by its own types and rejected without colours") {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, std::vector<std::string> channels, OIIO::TypeDesc type) {
        OIIO::ImageSpec spec{2, 1, static_cast<int>(channels.size()), type};
        spec.channelnames = std::move(channels);
        const auto output = OIIO::ImageOutput::create("openexr");
        const std::vector<std::byte> zeros(spec.image_bytes());
        REQUIRE((output->open(folder / name, spec) && output->write_image(type, zeros.data()) && output->close()));
    };
    write("half.exr", {"R", "G", "B", "A"}, OIIO::TypeDesc::HALF);
    write("float.exr", {"R", "G", "B", "A"}, OIIO::TypeDesc::FLOAT);
    write("opaque.exr", {"R", "G", "B"}, OIIO::TypeDesc::FLOAT);
    write("luminance.exr", {"Y"}, OIIO::TypeDesc::FLOAT);
    CHECK(read_images(folder / "half.exr")[0].image == Image{Format::rgba16f, 2, 1});
    CHECK(read_images(folder / "float.exr")[0].image == Image{Format::rgba32f, 2, 1});
    CHECK_THROWS_AS(read_images(folder / "opaque.exr"), strata::InputError);
    CHECK_THROWS_AS(read_images(folder / "luminance.exr"), strata::InputError);
}

TEST_CASE("a truncated EXR is an input error at every tested length") {
    const TemporaryFolder folder;
    write_image(folder / "a.exr", {.color = wild_image(Format::rgba8, 64, 64, 2)});
    const std::string bytes = strata::test::bytes_of(folder / "a.exr");
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{3}, std::size_t{100}, std::size_t{500}, bytes.size() / 2, bytes.size() - 9}) {
        std::ofstream(folder / "cut.exr", std::ios::binary) << bytes.substr(0, size);
        INFO("cut after " << size << " of " << bytes.size());
        CHECK_THROWS_AS(read_images(folder / "cut.exr"), strata::InputError);
    }
}
