// Tests images in glTF files: PNG files by a separate encoder after the PNG specification, and a JPEG whose only block
// is grey, written by hand.
#include <catch2/catch.hpp>

#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;
using Codes = std::vector<std::uint8_t>;

Json document_with(const ByteVector& image, const std::string& type) {
    Json document = everything().document();
    document["images"][0] = {{"uri", data_uri(image, type)}};
    return document;
}

strata::pipeline::Texture texture_of(const ByteVector& image, const std::string& type = "image/png") {
    return load(document_with(image, type)).list.textures.at(0);
}

std::string refusal_of(const ByteVector& image, const std::string& type = "image/png") {
    return refusal(to_bytes(document_with(image, type).dump()));
}

void check_refused(const std::string& message, const std::string& code) {
    INFO(message);
    CHECK(message.starts_with("test.gltf: /images/0/uri: expected "));
    CHECK(message.ends_with(" [" + code + "]"));
}

}  // namespace

TEST_CASE("grey or RGB images with or without alpha become RGBA with straight alpha") {
    CHECK(texture_of(png(2, 1, 8, 1, {0, 200})).texels == Codes{0, 0, 0, 255, 200, 200, 200, 255});
    CHECK(texture_of(png(2, 1, 8, 2, {0, 7, 200, 0})).texels == Codes{0, 0, 0, 7, 200, 200, 200, 0});
    CHECK(texture_of(png(1, 2, 8, 3, {1, 2, 3, 4, 5, 6})).texels == Codes{1, 2, 3, 255, 4, 5, 6, 255});
    const auto whole = texture_of(png(1, 2, 8, 4, {255, 128, 1, 0, 255, 128, 1, 3}));
    CHECK(whole.texels == Codes{255, 128, 1, 0, 255, 128, 1, 3});
    CHECK((whole.width == 1 && whole.height == 2));
}

TEST_CASE("every pair of colour and alpha of a PNG is read as written") {
    Codes codes;
    for (int color = 0; color < 256; color += 5)
        for (int alpha = 0; alpha < 256; alpha += 5)
            for (const int c : {color, 255 - color, 0, alpha}) codes.push_back(static_cast<std::uint8_t>(c));
    CHECK(texture_of(png(52, 52, 8, 4, codes)).texels == codes);
}

TEST_CASE("a 16-bit code becomes the nearest 8-bit one") {
    Codes raw, expected;
    for (int code = 0; code < 65536; code += 37) {
        raw.push_back(static_cast<std::uint8_t>(code >> 8));
        raw.push_back(static_cast<std::uint8_t>(code & 255));
        int nearest = 0;  // minimizes |nearest / 255 - code / 65535|, in integers
        for (int k = 0; k < 256; ++k)
            if (std::abs(k * 257 - code) < std::abs(nearest * 257 - code)) nearest = k;
        expected.insert(expected.end(), 3, static_cast<std::uint8_t>(nearest));
        expected.push_back(255);
    }
    CHECK(texture_of(png(static_cast<std::uint32_t>(raw.size() / 2), 1, 16, 1, raw)).texels == expected);
}

TEST_CASE("a JPEG is decoded by its own reader") {
    const auto texture = texture_of(grey_jpeg(), "image/jpeg");
    CHECK((texture.width == 8 && texture.height == 8));
    CHECK(texture.texels.size() == 256);
    CHECK(std::vector<std::uint8_t>(texture.texels.begin(), texture.texels.begin() + 4) == Codes{128, 128, 128, 255});
}

TEST_CASE("an image of another kind or a truncated one or one with a wrong size is rejected before it is decoded") {
    const ByteVector good = png(2, 2, 8, 4, Codes(16, 9));
    check_refused(refusal_of(to_bytes("GIF89a")), "IMAGE_UNRECOGNIZED_FORMAT");
    check_refused(refusal_of({}), "IMAGE_UNRECOGNIZED_FORMAT");
    check_refused(refusal_of(good, "image/jpeg"), "IMAGE_MIME_TYPE_INVALID");
    check_refused(refusal_of(good, "image/webp"), "IMAGE_MIME_TYPE_INVALID");
    check_refused(refusal_of(ByteVector(good.begin(), good.begin() + 20)), "IMAGE_UNEXPECTED_EOS");
    check_refused(refusal_of(ByteVector(good.begin(), good.begin() + 45)), "IMAGE_UNEXPECTED_EOS");
    check_refused(refusal_of(ByteVector(good.begin(), good.end() - 12)), "IMAGE_UNEXPECTED_EOS");  // without IEND
    ByteVector flipped = good;
    flipped[50] ^= std::byte{0xff};
    check_refused(refusal_of(flipped), "IMAGE_DATA_INVALID");
    const Codes none(1, 0);
    check_refused(refusal_of(png(0, 1, 8, 4, none)), "IMAGE_DATA_INVALID");
    check_refused(refusal_of(png(16385, 1, 8, 4, none)), "VALUE_NOT_IN_RANGE");
    check_refused(refusal_of(png(0xffffffff, 1, 8, 4, none)), "VALUE_NOT_IN_RANGE");
    ByteVector bomb = png(16384, 1, 8, 4, none);
    bomb[22] = std::byte{0x40}, bomb[23] = std::byte{0};  // and 16384 high: 1 GiB of texels from 80 bytes
    check_refused(refusal_of(bomb), "IMAGE_UNEXPECTED_EOS");
}

TEST_CASE("a JPEG that is truncated or claims too much or has endless scans is rejected") {
    const ByteVector good = grey_jpeg();
    for (std::size_t length = 4; length < good.size(); ++length)
        CHECK(refusal_of(ByteVector(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)), "image/jpeg") !=
              "");
    constexpr std::size_t size_at = 71 + 5;  // after SOI, DQT (69 bytes), and the frame's marker, length and precision
    ByteVector bomb = good;
    bomb[size_at] = bomb[size_at + 2] = std::byte{0x40};
    bomb[size_at + 1] = bomb[size_at + 3] = std::byte{0};
    check_refused(refusal_of(bomb, "image/jpeg"), "IMAGE_UNEXPECTED_EOS");
    bomb[size_at] = std::byte{0xff};
    check_refused(refusal_of(bomb, "image/jpeg"), "VALUE_NOT_IN_RANGE");
    ByteVector scans(good.begin(), good.end() - 2);
    const ByteVector scan(good.end() - 13, good.end() - 2);
    for (int i = 0; i < 70; ++i) scans.insert(scans.end(), scan.begin(), scan.end());
    scans.insert(scans.end(), good.end() - 2, good.end());
    check_refused(refusal_of(scans, "image/jpeg"), "IMAGE_DATA_INVALID");
}
