// Tests ordered dithering: the formula in rationals, the means of 4 x 4 pixels, and drawn surfaces.
#include "pipeline/formats/dither.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "pipeline/region/surface.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata::pipeline;
namespace raster = strata::rasterizer;

constexpr int dither_side = 16;

// A rectangle whose red is `value`, drawn on a surface of zeros.
Image drawn_red(std::string_view profile, Format format, float value, const Blend& blend) {
    Surface surface{*find_profile(profile), {format, DepthFormat::d24, dither_side, dither_side}};
    raster::TriangleSoup soup;
    for (const auto& [x, y] : {std::array{0.0f, 0.0f}, std::array{40.0f, 0.0f}, std::array{0.0f, 40.0f}}) {
        raster::ClipVertex v{.x = x, .y = y, .z = 0.5f};
        v.front = v.back = {value, value, value, value};
        soup.vertices.push_back(v);
    }
    soup.indices = {0, 1, 2};
    surface.draw({.blend = blend}, std::move(soup));
    return surface.color();
}

}  // namespace

TEST_CASE("the pattern has each of its sixteen numbers once, and neighbours in a row are at least 6 apart") {
    std::set<std::uint32_t> numbers;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const auto at = [](int column, int row) { return static_cast<int>(dither_pattern(column, row)); };
            numbers.insert(dither_pattern(x, y));
            CHECK(dither_pattern(x + 4, y + 8) == dither_pattern(x, y));
            CHECK(std::abs(at(x, y) - at(x + 1, y)) >= 6);
        }
    CHECK(numbers.size() == 16);
    CHECK(*numbers.rbegin() == 15);
}

TEST_CASE("a dithered code is the floor of the value plus the pattern's threshold, one of the two codes beside it") {
    using raster::Rational;
    std::uint32_t state = 1;
    int wrong = 0;
    for (int i = 0; i < 60000; ++i) {
        state = state * 1664525u + 1013904223u;
        const float value =
            i < 1024 ? static_cast<float>(i) / 1023.0f : std::ldexp(static_cast<float>(state >> 8), -24 - i % 40);
        const int greatest = i % 3 == 0 ? 3 : i % 3 == 1 ? 255 : 1023;
        const Rational exact = Rational{value} * greatest;
        const raster::Integer below = raster::floor(exact);
        for (std::uint32_t p = 0; p < 16; ++p) {
            const raster::Integer code = dithered(value, greatest, p);
            wrong += code != raster::floor(exact + Rational{2 * p + 1, 32}) ? 1 : 0;
            wrong += code != below && code != below + 1 ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    CHECK(dithered(std::nanf(""), 255, 15) == 0);
    CHECK(dithered(-1.0f, 255, 15) == 0);
    CHECK(dithered(7.0f, 255, 15) == 255);
}

TEST_CASE("narrow surfaces keep the mean of every code over 4 x 4 pixels up to their greatest code") {
    for (const Format format : {Format::r5g6b5, Format::x1r5g5b5})
        for (int channel = 0; channel < 3; ++channel) {
            const std::uint32_t step = format == Format::r5g6b5 && channel == 1 ? 4 : 8;
            int wrong = 0;
            for (std::uint32_t code = 0; code < 256; ++code) {
                std::uint32_t sum = 0;
                for (std::uint32_t p = 0; p < 16; ++p) {
                    const std::uint32_t stored = dithered_narrow(format, channel, code, p);
                    wrong += stored % step != 0 || (stored + step <= code) || stored >= code + step ? 1 : 0;
                    sum += stored;
                }
                if (code <= 256 - step) wrong += sum != 16 * code ? 1 : 0;
            }
            CHECK(wrong == 0);
        }
    CHECK(dithered_narrow(Format::x8r8g8b8, 0, 77, 15) == 77);
    CHECK(dithered_narrow(Format::x8r8g8b8, 3, 77, 15) == 255);
    CHECK(dithered_narrow(Format::x1a7r8g8b8, 3, 1, 15) == 2);
    CHECK(dithered_narrow(Format::x1a7r8g8b8, 3, 1, 7) == 0);
}

TEST_CASE("a dithered surface shows values between its codes, and is unchanged without dithering or by blending") {
    const Blend dither{.enabled = false, .color = {}, .alpha = {}, .dither = true};
    const Image plain = drawn_red("ideal", Format::rgba8, 100.4f / 255.0f, {});
    const Image fine = drawn_red("ideal", Format::rgba8, 100.4f / 255.0f, dither);
    double sum = 0;
    int wrong = 0;
    for (int y = 0; y < dither_side; ++y)
        for (int x = 0; x < dither_side; ++x) {
            const auto i = 4 * static_cast<std::size_t>(y * dither_side + x);
            wrong += plain.codes[i] != 100 ? 1 : 0;
            wrong += fine.codes[i] != dithered(100.4f / 255.0f, 255, dither_pattern(x, y)) ? 1 : 0;
            sum += fine.codes[i];
        }
    CHECK(wrong == 0);
    CHECK(std::abs(sum / (dither_side * dither_side) - 100.4) <= 1.0 / 32);
    Blend blended = blend_mode::over;
    blended.dither = true;
    CHECK(drawn_red("ideal", Format::rgba8, 0.3f, blended).codes ==
          drawn_red("ideal", Format::rgba8, 0.3f, blend_mode::over).codes);
    CHECK(drawn_red("ideal", Format::rgba16f, 0.3f, dither).codes ==
          drawn_red("ideal", Format::rgba16f, 0.3f, {}).codes);

    // 100 lies between the five-bit codes 96 and 104: half of the pixels have each.
    const Image narrow = drawn_red("geforce3", Format::r5g6b5, 100.0f / 255.0f, dither);
    int lower = 0, upper = 0;
    for (std::size_t i = 0; i < narrow.codes.size(); i += 4) {
        lower += narrow.codes[i] == 96 ? 1 : 0;
        upper += narrow.codes[i] == 104 ? 1 : 0;
        wrong += narrow.codes[i + 1] != 100 ? 1 : 0;  // six bits have it exactly
    }
    CHECK(wrong == 0);
    CHECK(lower == upper);
    CHECK(lower + upper == dither_side * dither_side);
}
