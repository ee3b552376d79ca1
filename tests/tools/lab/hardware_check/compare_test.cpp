// Tests the comparison with hardware captures on pictures of one or a few marked pixels. The expected values are worked
// out by hand for each reading.
#include "tools/lab/hardware_check/drawing/compare.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"

namespace {

using namespace strata;
using namespace strata::hardware_check;
using pipeline::Format;
using pipeline::Image;
using Bytes4 = std::array<std::uint32_t, 4>;  // r g b a
using Histogram = std::map<std::int64_t, std::uint64_t>;

Image blank(Format format) { return {format, picture_width, picture_height}; }

void paint(Image& image, int x, int y, const Bytes4& color) {
    std::copy(color.begin(), color.end(), image.codes.begin() + static_cast<std::ptrdiff_t>(image.index(x, y)));
}

// A drawn depth picture with one value at (5, 7), and a capture with one pixel there.
struct OneWord {
    SuitePicture drawn;
    Image capture = blank(Format::rgba8);
    OneWord(CaptureFormat reading, std::uint32_t depth, std::optional<std::uint32_t> stencil, const Bytes4& pixel) {
        drawn.reading = reading;
        drawn.image = blank(reading == CaptureFormat::depth16 ? Format::d16 : Format::d24);
        drawn.image.codes[drawn.image.index(5, 7)] = depth;
        if (stencil) {
            drawn.stencil = blank(Format::s8);
            drawn.stencil.codes[drawn.stencil.index(5, 7)] = *stencil;
        }
        paint(capture, 5, 7, pixel);
    }
    [[nodiscard]] CaptureComparison compared() const { return compare(drawn, capture, "c.png"); }
};

SuitePicture colored(const Bytes4& background) {
    SuitePicture picture;
    picture.image = blank(Format::rgba8);
    for (int y = 0; y < picture_height; ++y)
        for (int x = 0; x < picture_width; ++x) paint(picture.image, x, y, background);
    for (std::size_t c = 0; c < 4; ++c) picture.background[c] = static_cast<std::uint8_t>(background[c]);
    return picture;
}

}  // namespace

TEST_CASE("a 16-bit depth is read from R5G6B5 expanded to 8 bits per channel") {
    for (const std::uint32_t word : {0u, 1u, 0x001fu, 0x0020u, 0x07e0u, 0x0800u, 0x1234u, 0xfedcu, 0xffffu}) {
        const std::uint32_t r = word >> 11, g = word >> 5 & 63, b = word & 31;
        const OneWord same{CaptureFormat::depth16, word, {}, {r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2, 255}};
        CHECK(same.compared().differing == 0);
        CHECK(same.compared().compared == 640 * 480);
    }
    const OneWord more{
        CaptureFormat::depth16, 0x1234, {}, {0x10, 0x44, 0xa5, 255}};  // 00010 010001 10100, and 1234 is ...10001 10100
    CHECK(more.compared().differing == 0);
    const OneWord less{CaptureFormat::depth16, 0x1235, {}, {0x10, 0x44, 0xa5, 255}};
    CHECK(less.compared().histogram == Histogram{{-1, 1}});
    CHECK(less.compared().ours == 0x1235);
    CHECK(less.compared().theirs == 0x1234);
}

TEST_CASE("a 24-bit depth is read from channels A R G with the highest byte first and its stencil from B") {
    const OneWord equal{CaptureFormat::depth24, 0x123456, 0x78, {0x34, 0x56, 0x78, 0x12}};
    CHECK(equal.compared().differing == 0);
    const OneWord nearer{CaptureFormat::depth24, 0x123456, 0x78, {0x34, 0x54, 0x78, 0x12}};
    CHECK(nearer.compared().histogram == Histogram{{-2, 1}});  // in depth units
    const OneWord both{CaptureFormat::depth24, 0x123456, 0x78, {0x34, 0x57, 0x70, 0x12}};
    CHECK(both.compared().histogram == Histogram{{1, 1}});  // the depth difference counts, the stencil is not added
    const OneWord counted{CaptureFormat::depth24, 0x123456, 0x78, {0x34, 0x56, 0x7b, 0x12}};
    CHECK(counted.compared().histogram == Histogram{{3, 1}});
    const OneWord highest{CaptureFormat::depth24, 0x123456, 0xff, {0x34, 0x56, 0x00, 0x12}};
    CHECK(highest.compared().histogram == Histogram{{-255, 1}});
    const OneWord without{CaptureFormat::depth24, 0x123456, {}, {0x34, 0x56, 0x99, 0x12}};
    CHECK(without.compared().differing == 0);  // B is ignored
    const OneWord farthest{CaptureFormat::depth24, 0, {}, {0xff, 0xff, 0, 0xff}};
    CHECK(farthest.compared().largest == 0xffffff);
}

TEST_CASE("for a picture that is read as drawn or not only the covered pixels are compared and not their colours") {
    SuitePicture picture = colored({1, 2, 3, 4});
    picture.reading = CaptureFormat::drawn;
    Image capture = picture.image;
    paint(picture.image, 10, 20, {9, 9, 9, 9});
    paint(capture, 10, 20, {7, 2, 3, 4});
    CHECK(compare(picture, capture, "c.png").differing == 0);
    paint(capture, 11, 20, {1, 2, 3, 5});
    paint(picture.image, 12, 20, {0, 2, 3, 4});
    const CaptureComparison found = compare(picture, capture, "c.png");
    CHECK(found.histogram == Histogram{{-1, 1}, {1, 1}});
    CHECK(found.first == std::array{11, 20});
}

TEST_CASE("colours differ by their largest channel difference in any of the four channels and in either direction") {
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (const bool is_more : {false, true}) {
            const SuitePicture picture = colored({100, 100, 100, 100});
            Image capture = picture.image;
            Bytes4 pixel{101, 99, 100, 101};
            pixel[channel] = is_more ? 117 : 83;
            paint(capture, 639, 479, pixel);
            const CaptureComparison found = compare(picture, capture, "c.png");
            CHECK(found.histogram == Histogram{{17, 1}});
            CHECK(found.largest == 17);
            CHECK(found.first == std::array{639, 479});
            CHECK(found.ours == 0x64646464);
        }
}

TEST_CASE("a difference is within the bound if neither the pixel count nor the largest difference exceeds it") {
    SuitePicture picture = colored({0, 0, 0, 255});
    Image capture = picture.image;
    for (int x = 0; x < 3; ++x) paint(capture, x, 0, {4, 0, 0, 255});
    for (const std::uint64_t pixels : {0, 2, 3, 4})
        for (const std::uint32_t units : {0, 3, 4, 5}) {
            picture.bound = {pixels, units};
            CHECK(compare(picture, capture, "c.png").within_bound == (pixels >= 3 && units >= 4));
        }
    picture.bound = {};
    CHECK(compare(picture, picture.image, "c.png").within_bound);
}

TEST_CASE(
    "labels are white with alpha 0 in pictures of colours and coverage and such pixels are values in depth pictures") {
    for (const CaptureFormat reading :
         {CaptureFormat::color, CaptureFormat::drawn, CaptureFormat::depth16, CaptureFormat::depth24}) {
        SuitePicture picture = colored({0, 0, 0, 0});
        picture.reading = reading;
        if (reading == CaptureFormat::depth16) picture.image = blank(Format::d16);
        if (reading == CaptureFormat::depth24) picture.image = blank(Format::d24);
        Image capture = blank(Format::rgba8);
        paint(capture, 30, 40, {255, 255, 255, 0});
        paint(capture, 33, 41, {255, 255, 255, 0});
        paint(capture, 34, 45, {255, 255, 255, 1});  // not a label pixel
        const bool has_labels = reading == CaptureFormat::color || reading == CaptureFormat::drawn;
        CHECK(label_box(picture, capture) == (has_labels ? rasterizer::Rect{30, 40, 34, 42} : rasterizer::Rect{}));
        CHECK(compare(picture, capture, "c.png").compared == 640 * 480 - (has_labels ? 2u : 0u));
        CHECK(compare(picture, capture, "c.png").differing == (has_labels ? 1u : 3u));
    }
}

TEST_CASE("a hidden rectangle includes its left and upper sides and excludes its right and lower ones") {
    SuitePicture picture = colored({0, 0, 0, 255});
    picture.hidden = {{100, 200, 103, 202}, {0, 0, 1, 1}};
    for (const auto& [x, y, is_hidden] : {std::tuple{100, 200, true},
                                          {102, 201, true},
                                          {103, 201, false},
                                          {102, 202, false},
                                          {99, 200, false},
                                          {100, 199, false},
                                          {0, 0, true}}) {
        Image capture = picture.image;
        paint(capture, x, y, {1, 0, 0, 255});
        const CaptureComparison found = compare(picture, capture, "c.png");
        CHECK(found.differing == (is_hidden ? 0u : 1u));
        CHECK(found.compared == 640 * 480 - 7);
        CHECK((digest_outside({}, picture, capture) == digest_outside({}, picture)) == is_hidden);
        CHECK(digest_outside({x, y, x + 1, y + 1}, picture, capture) == digest_outside({x, y, x + 1, y + 1}, picture));
    }
}

TEST_CASE(
    "differences are red where the chip's value is greater and cyan where it is less and hidden pixels are white") {
    OneWord words{CaptureFormat::depth16, 100, {}, {0, 0, 0, 255}};
    paint(words.capture, 6, 7, {0, 0, 0x28, 255});  // 5, ours is 0
    words.drawn.hidden = {{50, 60, 51, 61}};
    const Image shown = difference_picture(words.drawn, words.capture);
    const auto pixel = [&](int x, int y) {
        const std::size_t i = shown.index(x, y);
        return Bytes4{shown.codes[i], shown.codes[i + 1], shown.codes[i + 2], shown.codes[i + 3]};
    };
    CHECK(pixel(0, 0) == Bytes4{0, 0, 0, 255});
    CHECK(pixel(50, 60) == Bytes4{255, 255, 255, 255});
    CHECK(pixel(5, 7) == Bytes4{0, 255, 255, 255});  // 100 less: full brightness
    CHECK(pixel(6, 7) == Bytes4{96 + 16 * 5, 0, 0, 255});
    CHECK((shown.format == Format::rgba8 && shown.width == 640 && shown.height == 480));
}

TEST_CASE("a capture of another size or format is rejected with the name of the file and what it contains") {
    const SuitePicture picture = colored({0, 0, 0, 0});
    const auto said = [&](const Image& capture) {
        try {
            static_cast<void>(compare(picture, capture, "dir/c.png"));
        } catch (const InputError& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    CHECK(said({Format::rgba8, 639, 480}) ==
          "dir/c.png: picture: expected 640 x 480 pixels of 8-bit r g b a, found 639 x 480 pixels of rgba8");
    CHECK(said({Format::rgba8, 640, 481}).ends_with("found 640 x 481 pixels of rgba8"));
    CHECK(said({Format::rgba16f, 640, 480}).ends_with("found 640 x 480 pixels of rgba16f"));
}

TEST_CASE("suites are listed once each in byte order and found by their full names only") {
    const std::span<const Suite> all = suites();
    CHECK(all.size() == 51);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) CHECK(all[i - 1].name < all[i].name);
        CHECK(find_suite(all[i].name) == &all[i]);
        CHECK(all[i].draw != nullptr);
        CHECK((all[i].draw_with != nullptr) == (all[i].name == "Pixel_shader"));
        const std::string name{all[i].name};
        CHECK(find_suite(name + "_") == nullptr);
        CHECK(find_suite(name.substr(1)) == nullptr);
    }
    CHECK(find_suite("") == nullptr);
}

TEST_CASE("a suite is marked with the kinds of constants that its captures can distinguish") {
    const std::map<std::string_view, unsigned> told{{"3D_primitive", 4},
                                                    {"Alpha_func", 4},
                                                    {"Attrib_carryover", 4},
                                                    {"Attrib_float", 4},
                                                    {"Color_mask_blend", 4},
                                                    {"Combiner", 8},
                                                    {"Depth_Clamp", 8},
                                                    {"Depth_buffer", 1 | 4},
                                                    {"Depth_buffer_fixed_function", 1 | 4},
                                                    {"Edge_flag", 4},
                                                    {"Fog", 8},
                                                    {"Fog_gen", 8},
                                                    {"Fog_vsh", 8},
                                                    {"Lighting_normals", 4},
                                                    {"Line_width", 4},
                                                    {"Material_alpha", 4},
                                                    {"Material_color_source", 8},
                                                    {"Pixel_shader", 2 | 8},
                                                    {"Point_params", 8},
                                                    {"Shade_model", 4 | 8},
                                                    {"Smoothing_control", 4},
                                                    {"Specular", 4},
                                                    {"Stipple_tests", 4},
                                                    {"Texture_perspective", 4 | 8},
                                                    {"Texture_shadow_comparator", 2 | 8},
                                                    {"W_buffering", 1 | 8},
                                                    {"W_param", 8},
                                                    {"ZMinMaxControl", 4}};
    for (const Suite& suite : suites())
        CHECK(unsigned{suite.determines} == (told.contains(suite.name) ? told.at(suite.name) : 0u));
}
