// Tests the table of formats against an independent list. The expected codes of an image are counted up in order; the
// bytes of a digest are laid out here.
#include <catch2/catch.hpp>
#include <cstdio>
#include <random>
#include <set>
#include <string>

#include "pipeline/formats/format.h"
#include "pipeline/formats/image.h"
#include "pipeline/formats/lane_mask.h"
#include "pipeline/formats/narrow.h"

namespace {

using namespace strata::pipeline;

struct FormatRow {
    Format format;
    const char* name;
    ChannelType type;
    int channels, bytes;
    const char* traits;  // c colour, n narrow, p packed, d depth, s stencil
};

constexpr FormatRow format_rows[] = {
    {Format::rgba8, "rgba8", ChannelType::unorm8, 4, 4, "c"},
    {Format::rgba16f, "rgba16f", ChannelType::half, 4, 8, "c"},
    {Format::rgba32f, "rgba32f", ChannelType::single, 4, 16, "c"},
    {Format::r16f, "r16f", ChannelType::half, 1, 2, "c"},
    {Format::r32f, "r32f", ChannelType::single, 1, 4, "c"},
    {Format::rg32f, "rg32f", ChannelType::single, 2, 8, "c"},
    {Format::d16, "d16", ChannelType::depth, 1, 2, "d"},
    {Format::d24, "d24", ChannelType::depth, 1, 4, "d"},
    {Format::d24s8, "d24s8", ChannelType::depth, 1, 4, "ds"},
    {Format::d32f, "d32f", ChannelType::depth, 1, 4, "d"},
    {Format::s8, "s8", ChannelType::stencil, 1, 1, "s"},
    {Format::d16f, "d16f", ChannelType::depth, 1, 2, "d"},
    {Format::x8r8g8b8, "x8r8g8b8", ChannelType::unorm8, 4, 4, "cn"},
    {Format::x1a7r8g8b8, "x1a7r8g8b8", ChannelType::unorm8, 4, 4, "cn"},
    {Format::r5g6b5, "r5g6b5", ChannelType::unorm8, 4, 2, "cn"},
    {Format::x1r5g5b5, "x1r5g5b5", ChannelType::unorm8, 4, 2, "cn"},
    {Format::d24f, "d24f", ChannelType::depth, 1, 4, "d"},
    {Format::srgb8_alpha8, "srgb8_alpha8", ChannelType::unorm8, 4, 4, "cp"},
    {Format::rgb10_a2, "rgb10_a2", ChannelType::unorm10, 4, 4, "cp"},
    {Format::r11g11b10f, "r11g11b10f", ChannelType::half, 4, 4, "cp"},
};

[[nodiscard]] bool has_trait(const FormatRow& row, char trait) {
    return std::string_view{row.traits}.find(trait) != std::string_view::npos;
}

}  // namespace

TEST_CASE("each format has the listed name and size and is of the kind that its name says") {
    std::set<std::string_view> names;
    int value = 0;
    for (const FormatRow& row : format_rows) {
        INFO(row.name);
        const FormatInfo found = info(row.format);
        CHECK(static_cast<int>(row.format) == value++);
        CHECK(found.name == row.name);
        CHECK(found.type == row.type);
        CHECK(found.channels == row.channels);
        CHECK(found.bytes_per_pixel == row.bytes);
        CHECK(is_color(row.format) == has_trait(row, 'c'));
        CHECK(is_narrow(row.format) == has_trait(row, 'n'));
        CHECK(is_packed(row.format) == has_trait(row, 'p'));
        CHECK(is_depth(row.format) == has_trait(row, 'd'));
        CHECK(has_stencil(row.format) == has_trait(row, 's'));
        CHECK(names.insert(found.name).second);
    }
}

TEST_CASE("a depth format and its target format refer to each other where d24s8 counts as d24") {
    for (const DepthFormat format :
         {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16f, DepthFormat::d24f})
        CHECK(depth_format(target_format(format)) == format);
    CHECK(target_format(DepthFormat::d16) == Format::d16);
    CHECK(target_format(DepthFormat::d24) == Format::d24);
    CHECK(target_format(DepthFormat::d32f) == Format::d32f);
    CHECK(target_format(DepthFormat::d16f) == Format::d16f);
    CHECK(depth_format(Format::d24s8) == DepthFormat::d24);
}

TEST_CASE("the codes of an image are ordered by row then pixel then sample then channel without gaps in every format") {
    std::size_t wrong = 0;
    for (const FormatRow& row : format_rows)
        for (const int samples : {1, 2, 4}) {
            const Image image{row.format, 5, 3, samples};
            std::size_t next = 0;
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 5; ++x)
                    for (int sample = 0; sample < samples; ++sample)
                        for (int channel = 0; channel < row.channels; ++channel)
                            wrong += image.index(x, y, channel, sample) != next++ ? 1 : 0;
            wrong += image.size() != next || image.codes.size() != next || image.channels() != row.channels ? 1 : 0;
            for (const std::uint32_t code : image.codes) wrong += code != 0 ? 1 : 0;
        }
    CHECK(wrong == 0);
    CHECK(Image{}.size() == 0);
}

TEST_CASE("an image for overwriting has the requested shape and images are equal if shape format and codes are") {
    Image image = Image::for_overwrite(Format::rg32f, 7, 2);
    CHECK(image.samples == 1);
    REQUIRE(image.codes.size() == 28);
    for (std::uint32_t& code : image.codes) code = 0;
    CHECK(image == Image{Format::rg32f, 7, 2});
    CHECK(image != Image{Format::rg32f, 2, 7});
    CHECK(image != Image{Format::r32f, 7, 4});
    image.codes[27] = 1;
    CHECK(image != Image{Format::rg32f, 7, 2});
}

TEST_CASE("a digest changes with any code and its position and every number of the shape in every format") {
    std::mt19937 random{701};
    std::set<std::string> digests;
    std::size_t images = 0;
    const auto add = [&](const Image& image) {
        digests.insert(digest(image));
        ++images;
    };
    for (const FormatRow& row : format_rows) {
        Image image{row.format, 3, 2};
        add(image);
        add(Image{row.format, 2, 3});
        add(Image{row.format, 3, 1, 2});
        add(Image{row.format, 6, 1});
        for (std::uint32_t& code : image.codes) {
            code = 1;
            add(image);
            code = 0;
        }
    }
    CHECK(digests.size() == images);
    for (const std::string& text : digests) {
        CHECK(text.size() == 32);
        CHECK(text.find_first_not_of("0123456789abcdef") == std::string::npos);
    }
}

TEST_CASE("a code contributes as many bytes to the digest as its format stores") {
    for (const FormatRow& row : format_rows) {
        INFO(row.name);
        const bool is_short = row.type == ChannelType::half || row.type == ChannelType::unorm10;
        const int bytes = is_short ? 2 : row.type == ChannelType::single || row.type == ChannelType::depth ? 4 : 1;
        const auto with_bit = [&](int bit) {
            Image image{row.format, 2, 2};
            image.codes[1] = 1u << bit;
            return digest(image);
        };
        const std::string zero = digest(Image{row.format, 2, 2});
        for (const int bit : {0, 7, 8, 15, 16, 31}) CHECK((with_bit(bit) != zero) == (bit < 8 * bytes));
    }
}

TEST_CASE("a mask is all ones or zero and selects whole values with every bit unchanged") {
    CHECK(mask(true) == 0xffffffffu);
    CHECK(mask(false) == 0u);
    std::size_t wrong = 0;
    for (const std::uint32_t chosen : {0u, 0xffffffffu, 0xf0f0f0f0u, 0x00000001u})
        for (const std::uint32_t a : {0u, 0xdeadbeefu, 0x7fc00001u})
            for (const std::uint32_t b : {0xffffffffu, 0x80000000u, 0x12345678u})
                for (int bit = 0; bit < 32; ++bit) {
                    const std::uint32_t from = (chosen >> bit & 1) != 0 ? a : b;
                    wrong += (select(chosen, a, b) >> bit & 1) != (from >> bit & 1) ? 1 : 0;
                }
    CHECK(wrong == 0);
    const float quiet = std::bit_cast<float>(0xffc12345u), zero = -0.0f;
    CHECK(std::bit_cast<std::uint32_t>(select(mask(true), quiet, zero)) == 0xffc12345u);
    CHECK(std::bit_cast<std::uint32_t>(select(mask(false), quiet, zero)) == 0x80000000u);
}

TEST_CASE("formats with eight bits per channel or floats keep every code of every channel") {
    std::size_t wrong = 0;
    for (const FormatRow& row : format_rows)
        for (int channel = 0; channel < 4; ++channel)
            for (std::uint32_t code = 0; code < 256; ++code)
                if (!has_trait(row, 'n')) wrong += narrowed(row.format, channel, code) != code ? 1 : 0;
    CHECK(wrong == 0);
    CHECK(narrowed(Format::x1a7r8g8b8, 0, 0x55) == 0x55);
    CHECK(narrowed(Format::x1r5g5b5, 0, 0xff) == 0xf8);
    CHECK(narrowed(Format::x1r5g5b5, 2, 0x0f) == 0x08);
}
