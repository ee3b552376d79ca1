// Tests the colour scale of heat maps. The expected lightness is L* of CIE 1976 (of sRGB, D65), computed here in
// double; logarithms are those of the C library.
#include "tools/oracle/compare/heat_scale.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tools/oracle/compare/small_text.h"

using namespace strata::oracle;

namespace {

double linear(std::uint8_t code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double lightness(const std::array<std::uint8_t, 3>& rgb) {
    const double y = 0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]);
    return y <= 216.0 / 24389 ? y * 24389 / 27 : 116 * std::cbrt(y) - 16;
}

}  // namespace

TEST_CASE("each doubling of the distance is one equal step of lightness within a fourteenth of the whole range") {
    for (const std::uint32_t greatest : {1u, 255u, 256u, 65535u, 65536u, ~0u}) {
        const HeatScale scale{greatest};
        const int octaves = std::bit_width(scale.end());
        CHECK(scale.end() >= std::max(greatest, 255u));
        CHECK((scale.end() & (scale.end() + 1)) == 0);
        CHECK((scale.end() == 255 || scale.end() / 2 < greatest));
        CHECK(lightness(scale.color(1)) > 20);  // clearly lighter than black
        CHECK(lightness(scale.color(scale.end())) > 95);
        const double whole = lightness(scale.color(scale.end())) - lightness(scale.color(1));
        INFO("greatest " << greatest);
        double worst = 0;
        for (int k = 0; k + 1 < octaves; ++k) {
            const double share = (k + 1) / std::log2(scale.end() + 0.0);
            const double wanted = lightness(scale.color(1)) + share * whole;
            worst = std::max(worst, std::fabs(lightness(scale.color(2u << k)) - wanted));
        }
        CHECK(worst < whole / 14);
    }
}

TEST_CASE("a distance of 0 is black and larger distances are never darker and constant beyond the end") {
    const HeatScale scale{200};
    CHECK(scale.color(0) == std::array<std::uint8_t, 3>{0, 0, 0});
    double before = 0;
    for (std::uint32_t distance = 1; distance <= 255; ++distance) {
        const double now = lightness(scale.color(distance));
        CHECK(now >= before);
        before = now;
    }
    CHECK(scale.color(1'000'000) == scale.color(255));
    // In a useful map one code and forty-four codes are clearly different.
    CHECK(lightness(scale.color(44)) - lightness(scale.color(1)) > 40);
}

TEST_CASE("the bar of the legend has the scale's colours from end to end with numbers below their colours") {
    const HeatScale scale{255};
    strata::pipeline::Image image{strata::pipeline::Format::rgba8, 300, legend_height_px};
    draw_legend(image, 0, 0, 300, scale);
    const auto at = [&](int x, int y) {
        return std::array{static_cast<std::uint8_t>(image.codes[image.index(x, y, 0)]),
                          static_cast<std::uint8_t>(image.codes[image.index(x, y, 1)]),
                          static_cast<std::uint8_t>(image.codes[image.index(x, y, 2)])};
    };
    CHECK(at(0, 5) == scale.color(1));
    CHECK(at(299, 5) == scale.color(255));
    for (const std::uint32_t distance : {2u, 4u, 16u, 64u}) {
        const auto x = static_cast<int>(std::lround(std::log2(distance) / std::log2(255.0) * 299));
        CHECK(std::fabs(lightness(at(x, 5)) - lightness(scale.color(distance))) < 1);
    }
    // "16" is drawn at its position: the same pixels are lit when it is drawn alone.
    strata::pipeline::Image word{strata::pipeline::Format::rgba8, 300, legend_height_px};
    const auto x = static_cast<int>(std::log2(16.0) / std::log2(255.0) * 299);
    draw_text(word, x - 8, 14, "16", 2);
    int missing = 0;
    for (int y = 14; y < 24; ++y)
        for (int column = x - 8; column < x + 8; ++column)
            missing += word.codes[word.index(column, y, 0)] > image.codes[image.index(column, y, 0)] ? 1 : 0;
    CHECK(missing == 0);
    // The last number is complete in the narrowest legend.
    for (const std::uint32_t greatest : {255u, 65535u, 16'777'215u, 4'294'967'295u}) {
        const HeatScale other{greatest};
        strata::pipeline::Image least{strata::pipeline::Format::rgba8, least_legend_width_px, legend_height_px},
            end = least;
        draw_legend(least, 0, 0, 1, other);
        const std::string text = std::to_string(greatest) + " codes";
        draw_text(end, least_legend_width_px - 8 * static_cast<int>(text.size()), 14, text, 2);
        CHECK(text.size() * 8 <= std::size_t{least_legend_width_px});
        for (int y = 14; y < 24; ++y)
            for (int column = 0; column < least_legend_width_px; ++column)
                missing += end.codes[end.index(column, y, 0)] > least.codes[least.index(column, y, 0)] ? 1 : 0;
    }
    CHECK(missing == 0);
    // A narrow legend keeps its end colours.
    strata::pipeline::Image narrow{strata::pipeline::Format::rgba8, 20, legend_height_px};
    draw_legend(narrow, 0, 0, 20, scale);
    CHECK(narrow.codes[narrow.index(0, 5, 0)] == scale.color(1)[0]);
}

TEST_CASE("a legend has three to five numbers from 1 code to the end at the positions of their logarithms") {
    for (int bits = 1; bits <= 32; ++bits) {
        const HeatScale scale{~std::uint32_t{0} >> (32 - bits)};
        const auto marks = scale.marks();
        CHECK(marks.front() == 1);
        CHECK(marks.back() == scale.end());
        CHECK(std::is_sorted(marks.begin(), marks.end(), std::less_equal<>{}));
        CHECK(marks.size() >= 3);
        CHECK(marks.size() <= 5);
        CHECK(scale.position(1) == 0);
        CHECK(scale.position(scale.end()) == 1);
        for (const std::uint32_t mark : marks)
            CHECK(std::fabs(scale.position(mark) - std::log2(mark) / std::log2(scale.end())) < 0.01);
    }
}

TEST_CASE("the stops of a legend are the scale's colours in even steps") {
    const HeatScale scale{255};
    const auto stops = HeatScale::stops();
    CHECK(stops.front() == scale.color(1));
    CHECK(stops.back() == scale.color(255));
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(stops.size() - 1);
        const auto distance = static_cast<std::uint32_t>(std::lround(std::exp2(share * std::log2(255.0))));
        // distances are rounded to integers
        CHECK(std::fabs(lightness(stops[i]) - lightness(scale.color(distance))) < 6);
    }
}
