// Tests images in memory against bytes written by hand and the codes that they represent.
#include <array>
#include <bit>
#include <catch2/catch.hpp>

#include "strata/picture.h"

using namespace strata;
using Catch::Matchers::Contains;

namespace {

// 2 x 2 pixels of the format whose codes count up from channel to channel.
Image counted(pipeline::Format format) {
    Image image{format, 2, 2};
    for (std::size_t i = 0; i < image.codes.size(); ++i) image.codes[i] = static_cast<std::uint32_t>(0x10 + i);
    return image;
}

std::span<const std::byte> as_memory(const std::vector<unsigned char>& bytes) {
    return std::as_bytes(std::span{bytes});
}

}  // namespace

TEST_CASE("codes of every type are unchanged after a round trip through memory") {
    struct Case {
        pipeline::Format format;
        const char* layout;
        std::size_t bytes;
    };
    for (const auto& [format, layout, bytes] :
         {Case{pipeline::Format::rgba8, "2x2:rgba8", 1}, Case{pipeline::Format::rgba16f, "2x2:rgba16f", 2},
          Case{pipeline::Format::rgba32f, "2x2:rgba32f", 4}, Case{pipeline::Format::d16, "2x2:d16", 2},
          Case{pipeline::Format::d24, "2x2:d24", 4}, Case{pipeline::Format::d32f, "2x2:d32f", 4}}) {
        INFO(layout);
        const Image image = counted(format);
        CHECK(channel_bytes(image) == bytes);
        const std::vector<std::byte> memory = to_memory(image);
        REQUIRE(memory.size() == image.codes.size() * bytes);
        const Picture back = from_memory(memory.data(), memory.size(), layout);
        const Picture direct = picture_of(image);
        CHECK(back.targets[0].codes == direct.targets[0].codes);
        CHECK(back.targets[0].code == direct.targets[0].code);
        CHECK(back.targets[0].meaning == direct.targets[0].meaning);
    }
}

TEST_CASE("rows may be padded and may start at the bottom") {
    // Two rows of two bytes, four bytes apart; the last row has no padding.
    const std::vector<unsigned char> padded{1, 2, 99, 99, 3, 4};
    CHECK(from_memory(as_memory(padded), layout("2x2:r8"), 4).targets[0].codes ==
          std::vector<std::uint32_t>{1, 2, 3, 4});
    CHECK(from_memory(as_memory(padded), layout("2x2:r8:bottom-up"), 4).targets[0].codes ==
          std::vector<std::uint32_t>{3, 4, 1, 2});
    Image image{pipeline::Format::s8, 2, 2};
    for (std::size_t i = 0; i < 4; ++i) image.codes[i] = static_cast<std::uint32_t>(i + 1);
    std::vector<std::byte> memory(6, std::byte{99});
    to_memory(image, memory, Rows::bottom_up, 4);
    CHECK(memory ==
          std::vector<std::byte>{std::byte{3}, std::byte{4}, std::byte{99}, std::byte{99}, std::byte{1}, std::byte{2}});
}

TEST_CASE("the bits of a half or float NaN are unchanged after a round trip through memory") {
    Image image{pipeline::Format::r32f, 1, 1};
    image.codes[0] = 0x7fa00001u;  // signalling NaN
    const std::vector<std::byte> memory = to_memory(image);
    CHECK(from_memory(memory.data(), 4, "1x1:r32f").targets[0].codes[0] == 0x7fa00001u);
}

TEST_CASE("too little memory or overlapping rows or an unknown layout is rejected by name") {
    const std::vector<unsigned char> bytes(15);
    CHECK_THROWS_WITH(from_memory(as_memory(bytes), layout("2x2:rgba8")),
                      Contains("memory: expected at least 16 bytes, found 15"));
    CHECK_THROWS_WITH(from_memory(as_memory(bytes), layout("2x2:rgba8"), 7),
                      Contains("row_bytes: expected 0 or at least 8, found 7"));
    CHECK_THROWS_WITH(from_memory(nullptr, 16, "2x2:rgba8"), Contains("expected an address, found null"));
    CHECK_THROWS_WITH(layout("2x2:rgb9"), Contains("found '2x2:rgb9'"));
    CHECK_THROWS_WITH(from_memory(as_memory(bytes), {.width = 0, .height = 2, .channels = 1}),
                      Contains("width: expected 1 to 16384, found 0"));
    CHECK_THROWS_WITH(from_memory(as_memory(bytes), {.width = 2, .height = 2, .channels = 5}),
                      Contains("channels: expected 1 to 4, found 5"));
    CHECK_THROWS_WITH(picture_of(Image{}), Contains("codes"));
    std::vector<std::byte> small(15);
    CHECK_THROWS_WITH(to_memory(counted(pipeline::Format::rgba8), small), Contains("at least 16 bytes"));
    CHECK_THROWS_WITH(picture_of(Image{pipeline::Format::rgba8, 2, 2}, Image{pipeline::Format::d24, 2, 1}),
                      Contains("depth size"));
}
