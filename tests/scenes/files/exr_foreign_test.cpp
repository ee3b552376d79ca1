// Tests EXR files that other programs write. OpenImageIO and OpenEXR write them here, with values that encode their own
// position.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>
#include <cstring>

#include "rasterizer/base/input_error.h"
#include "scenes/exr/parts.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes;
using strata::test::TemporaryFolder;

namespace {

constexpr int foreign_width = 37, foreign_height = 21, corner_x = -5, corner_y = 7, display_size = 64;

// The value of channel `c` in a sample of a pixel, counted from the data window's corner.
std::uint32_t number_at(int x, int y, int sample, int c) {
    return static_cast<std::uint32_t>(((y * foreign_width + x) * 8 + sample) * 8 + c);
}

int samples_at(int x, int y) { return (x + 2 * y) % 4; }

// Two 32-bit channels in a data window that begins left of the display window; scan lines if `tile` is 0.
OIIO::ImageSpec foreign_spec(int tile, bool is_deep) {
    OIIO::ImageSpec spec{foreign_width, foreign_height, 2, OIIO::TypeDesc::UINT32};
    spec.channelnames = {"first", "second"};
    spec.x = corner_x, spec.y = corner_y;
    spec.full_width = spec.full_height = display_size;
    spec.tile_width = spec.tile_height = tile;
    spec.deep = is_deep;
    return spec;
}

void write_foreign(const std::string& path, int tile) {
    const OIIO::ImageSpec spec = foreign_spec(tile, false);
    std::vector<std::uint32_t> words;
    for (int y = 0; y < foreign_height; ++y)
        for (int x = 0; x < foreign_width; ++x)
            for (int c = 0; c < 2; ++c) words.push_back(number_at(x, y, 0, c));
    const auto output = OIIO::ImageOutput::create("openexr");
    REQUIRE((output->open(path, spec) && output->write_image(OIIO::TypeDesc::UINT32, words.data()) && output->close()));
}

void write_foreign_deep(const std::string& path, int tile) {
    const OIIO::ImageSpec spec = foreign_spec(tile, true);
    OIIO::DeepData data{spec};
    for (int y = 0; y < foreign_height; ++y)
        for (int x = 0; x < foreign_width; ++x) {
            const int pixel = y * foreign_width + x;
            data.set_samples(pixel, samples_at(x, y));
            for (int sample = 0; sample < samples_at(x, y); ++sample)
                for (int c = 0; c < 2; ++c) data.set_deep_value(pixel, c, sample, number_at(x, y, sample, c));
        }
    const auto output = OIIO::ImageOutput::create("openexr");
    REQUIRE((output->open(path, spec) && output->write_deep_image(data) && output->close()));
}

StoredPart only_part(const std::string& path) {
    std::vector<StoredPart> parts;
    exr::read_parts(path, [&](StoredPart&& part) { parts.push_back(std::move(part)); });
    REQUIRE(parts.size() == 1);
    return parts[0];
}

std::vector<std::uint32_t> words_in(const StoredPart& part) {
    std::vector<std::uint32_t> words(part.bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), part.bytes.data(), part.bytes.size());
    return words;
}

}  // namespace

TEST_CASE(
    "a part has the display window's size and zeros outside of the data window in scan lines or tiles, flat or deep") {
    const TemporaryFolder folder;
    const int tile = GENERATE(0, 16);
    const bool is_deep = GENERATE(false, true);
    INFO((tile > 0 ? "tiles" : "scan lines") << (is_deep ? ", deep" : ", flat"));
    is_deep ? write_foreign_deep(folder / "a.exr", tile) : write_foreign(folder / "a.exr", tile);
    std::vector<std::uint32_t> expected, counts;
    for (int y = 0; y < display_size; ++y)
        for (int x = 0; x < display_size; ++x) {
            const int data_x = x - corner_x, data_y = y - corner_y;
            const bool is_held = data_x >= 0 && data_x < foreign_width && data_y >= 0 && data_y < foreign_height;
            const int samples = !is_deep ? 1 : is_held ? samples_at(data_x, data_y) : 0;
            if (is_deep) counts.push_back(static_cast<std::uint32_t>(samples));
            for (int sample = 0; sample < samples; ++sample)
                for (int c = 0; c < 2; ++c) expected.push_back(is_held ? number_at(data_x, data_y, sample, c) : 0);
        }
    const StoredPart part = only_part(folder / "a.exr");
    CHECK(part.is_whole);
    CHECK(part.header.is_deep == is_deep);
    CHECK((part.header.width == display_size && part.header.height == display_size));
    CHECK(part.samples == counts);
    CHECK(words_in(part) == expected);
}

TEST_CASE("a display window of more than 16384 pixels a side is rejected by name") {
    const TemporaryFolder folder;
    OIIO::ImageSpec spec{4, 4, 1, OIIO::TypeDesc::FLOAT};
    spec.full_width = 20000, spec.full_height = 8;
    const std::vector<float> values(16);
    const auto output = OIIO::ImageOutput::create("openexr");
    REQUIRE((output->open(folder / "a.exr", spec) && output->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
             output->close()));
    CHECK_THROWS_WITH(only_part(folder / "a.exr"),
                      folder / "a.exr" + ": size of the display window: expected at most 16384x16384, found 20000x8");
}

TEST_CASE("a channel with fewer samples than pixels is rejected with a message that names it") {
    const TemporaryFolder folder;
    const std::vector<float> values(8 * 8);
    Imf::Header header{8, 8};
    Imf::FrameBuffer frame;
    for (const char* name : {"BY", "Y"}) {
        const int each = name[0] == 'B' ? 2 : 1;
        header.channels().insert(name, Imf::Channel{Imf::FLOAT, each, each});
        frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 0, 0, each, each));
    }
    {
        Imf::OutputFile file{(folder / "a.exr").c_str(), header};
        file.setFrameBuffer(frame);
        file.writePixels(8);
    }
    const std::string path = folder / "a.exr";
    const std::string said =
        path + ": channel BY: expected a sample for every pixel (sampling 1 x 1), found sampling 2 x 2";
    CHECK_THROWS_WITH(only_part(path), said);
    CHECK_THROWS_AS(only_part(path), strata::InputError);
}
