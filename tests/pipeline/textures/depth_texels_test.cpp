// Tests depth textures whose codes encode (column, row); a lookup outside of the stored rectangle finds nothing.
#include "pipeline/textures/depth_texels.h"

#include <catch2/catch.hpp>
#include <optional>
#include <vector>

#include "rasterizer/rules/depth_code.h"

namespace {

using namespace strata::pipeline;
using strata::rasterizer::Rect;

[[nodiscard]] std::optional<std::uint32_t> texel_at(const DepthTexels& texels, int column, int row) {
    try {
        return texels.at(column, row);
    } catch (const NeedsFrame&) {
        return std::nullopt;
    }
}

}  // namespace

TEST_CASE(
    "a texture of which a rectangle is stored has texels there from the top or from the bottom and none elsewhere") {
    const Rect held{3, 2, 8, 6};
    std::vector<std::uint32_t> codes;
    for (int y = held.y0; y < held.y1; ++y)
        for (int x = held.x0; x < held.x1; ++x) codes.push_back(static_cast<std::uint32_t>(100 * y + x));
    DepthTexels texels;
    CHECK_FALSE(texels.exists());
    texels.codes = codes.data();
    texels.held = held;
    texels.width = 12, texels.height = 9;
    CHECK(texels.exists());
    int wrong = 0, found = 0;
    for (const bool bottom_up : {false, true}) {
        texels.bottom_up = bottom_up;
        for (int row = -1; row <= 9; ++row)
            for (int column = -1; column <= 12; ++column) {
                const int y = bottom_up ? 8 - row : row;  // of 9 rows
                const bool is_held = column >= 3 && column < 8 && y >= 2 && y < 6;
                const auto code = texel_at(texels, column, row);
                wrong += code.has_value() != is_held ? 1 : 0;
                wrong += code && *code != static_cast<std::uint32_t>(100 * y + column) ? 1 : 0;
                found += code ? 1 : 0;
            }
    }
    CHECK(wrong == 0);
    CHECK(found == 2 * 20);
}

TEST_CASE("a finished image is a complete texture of its own size and depth format") {
    for (const Format format : {Format::d16, Format::d24, Format::d24s8, Format::d32f, Format::d16f}) {
        Image image{format, 4, 3};
        for (std::size_t i = 0; i < image.codes.size(); ++i) image.codes[i] = static_cast<std::uint32_t>(i);
        const DepthTexels texels{image};
        CHECK(texels.exists());
        CHECK(texels.held == Rect{0, 0, 4, 3});
        CHECK((texels.width == 4 && texels.height == 3));
        CHECK(texels.format == depth_format(format));
        CHECK_FALSE(texels.is_eight_bit);
        CHECK_FALSE(texels.bottom_up);
        CHECK(texels.at(3, 2) == 11);
        CHECK(texels.at(0, 1) == 4);
        CHECK_FALSE(texel_at(texels, 4, 0));
        CHECK_FALSE(texel_at(texels, 0, 3));
    }
}

TEST_CASE("the greatest texel is that of depth 1 in its format or 255 for 8-bit texels") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16f}) {
        DepthTexels texels;
        texels.format = format;
        CHECK(texels.max() == strata::rasterizer::to_depth_code(1.0f, format, DepthRounding::floor));
        texels.is_eight_bit = true;
        CHECK(texels.max() == 255);
    }
}
