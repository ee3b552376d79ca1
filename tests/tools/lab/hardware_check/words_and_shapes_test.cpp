// Tests the parser of capture names and the shapes of the test suite. The expected values are OpenGL's names listed by
// hand, the vertex order of a GeForce3's QUADS, and texels decoded bit by bit.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tools/lab/hardware_check/drawing/blend_patterns.h"
#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/textured.h"

namespace {

using namespace strata;
using namespace strata::hardware_check;
using pipeline::BlendEquation;
using pipeline::BlendFactor;
using pipeline::CompareFunc;

// Expands a field of 1, 4, 5, 6 or 8 bits to 8 bits by repeating it from the most significant bit.
std::uint8_t repeated(std::uint32_t value, int bits) {
    std::string text;
    while (text.size() < 8)
        for (int bit = bits - 1; bit >= 0; --bit) text += (value >> bit & 1) != 0 ? '1' : '0';
    return static_cast<std::uint8_t>(std::stoi(text.substr(0, 8), nullptr, 2));
}

}  // namespace

TEST_CASE("a word in a file name has its documented meaning and is case sensitive") {
    const std::pair<const char*, CompareFunc> compares[] = {{"Never", CompareFunc::never},
                                                            {"N", CompareFunc::never},
                                                            {"Less", CompareFunc::less},
                                                            {"LessThan", CompareFunc::less},
                                                            {"LT", CompareFunc::less},
                                                            {"Equal", CompareFunc::equal},
                                                            {"EQ", CompareFunc::equal},
                                                            {"LessThanOrEqual", CompareFunc::lequal},
                                                            {"LE", CompareFunc::lequal},
                                                            {"Greater", CompareFunc::greater},
                                                            {"GreaterThan", CompareFunc::greater},
                                                            {"GT", CompareFunc::greater},
                                                            {"NotEqual", CompareFunc::notequal},
                                                            {"NE", CompareFunc::notequal},
                                                            {"GreaterThanOrEqual", CompareFunc::gequal},
                                                            {"GE", CompareFunc::gequal},
                                                            {"Always", CompareFunc::always},
                                                            {"A", CompareFunc::always}};
    for (const auto& [word, meaning] : compares) CHECK(compare_func(word) == meaning);
    for (const char* word : {"", "never", "NeverX", "L", "AL", "Less "}) CHECK_FALSE(compare_func(word));
    const std::pair<const char*, BlendFactor> named_factors[] = {{"0", BlendFactor::zero},
                                                                 {"1", BlendFactor::one},
                                                                 {"srcRGB", BlendFactor::src_color},
                                                                 {"1-srcRGB", BlendFactor::one_minus_src_color},
                                                                 {"srcA", BlendFactor::src_alpha},
                                                                 {"1-srcA", BlendFactor::one_minus_src_alpha},
                                                                 {"dstA", BlendFactor::dst_alpha},
                                                                 {"1-dstA", BlendFactor::one_minus_dst_alpha},
                                                                 {"dstRGB", BlendFactor::dst_color},
                                                                 {"1-dstRGB", BlendFactor::one_minus_dst_color},
                                                                 {"srcAsat", BlendFactor::src_alpha_saturate},
                                                                 {"cRGB", BlendFactor::constant_color},
                                                                 {"1-cRGB", BlendFactor::one_minus_constant_color},
                                                                 {"cA", BlendFactor::constant_alpha},
                                                                 {"1-cA", BlendFactor::one_minus_constant_alpha}};
    for (const auto& [word, meaning] : named_factors) CHECK(blend_factor(word) == meaning);
    for (const char* word : {"", "2", "1-", "1-1", "SrcA", "srcA "}) CHECK_FALSE(blend_factor(word));
    const std::pair<const char*, BlendEquation> named_equations[] = {
        {"ADD", BlendEquation::add},
        {"SUB", BlendEquation::subtract},
        {"REVSUB", BlendEquation::reverse_subtract},
        {"MIN", BlendEquation::min},
        {"MAX", BlendEquation::max},
        {"SADD", BlendEquation::signed_add},
        {"SREVSUB", BlendEquation::signed_reverse_subtract}};
    for (const auto& [word, meaning] : named_equations) CHECK(blend_equation(word) == meaning);
    for (const char* word : {"", "add", "SSUB"}) CHECK_FALSE(blend_equation(word));
}

TEST_CASE("a name is split from either end and unchanged where the separator is missing") {
    std::string_view name = "AB_CD_EF";
    CHECK_FALSE(take(name, "B"));
    CHECK_FALSE(take_last(name, "E"));
    CHECK(name == "AB_CD_EF");
    CHECK(take(name, "A"));
    CHECK(take_last(name, "F"));
    CHECK(name == "B_CD_E");
    CHECK(take_until(name, "_") == "B");
    CHECK(take_until(name, "_C") == "CD_E");  // "_C" does not occur: returns the whole name
    CHECK(name.empty());
    CHECK(take_until(name, "_").empty());
    std::string_view ends = "X--";
    CHECK(take_until(ends, "--") == "X");
    CHECK(ends.empty());
    CHECK(to_number("-6.00") == -6.0f);
    CHECK(to_number("0.5625") == 0.5625f);
    for (const char* text : {"", "x", "1 ", "0x1", "+1"}) CHECK_FALSE(to_number(text));
    CHECK(to_hexadecimal("ff") == 255u);
    CHECK(to_hexadecimal("FFFFFFFF") == 0xffffffffu);
    for (const char* text : {"", "0x1", "g", "100000000", "-1", "1 "}) CHECK_FALSE(to_hexadecimal(text));
}

TEST_CASE("a packed colour is alpha red green blue from its highest byte down in units of 1/255") {
    CHECK(unpack(0x12345678) == pipeline::PixelCode{0x34, 0x56, 0x78, 0x12});
    const std::array<float, 4> color = to_float(0x00ff8001);
    CHECK((color[0] == 1 && color[1] == 128 / 255.0f && color[2] == 1 / 255.0f && color[3] == 0));
    const ClipVertex vertex = at(3, 5, 0xff000000u);
    CHECK((vertex.x == 3 && vertex.y == 5 && vertex.z == 0 && vertex.w == 1));
    CHECK(vertex.front == std::array<float, 4>{0, 0, 0, 1});
    CHECK(vertex.back == vertex.front);
    CHECK(at(0, 0, 0.25f, {}, 7).z == 0.25f);
    CHECK(at(0, 0, 0.25f, {}, 7).w == 7);
}

TEST_CASE("a box is a quad from its upper left corner in clockwise order and a quad is the triangles 0 1 2 and 0 2 3") {
    TriangleSoup soup = box({10, 20, 30, 50}, 0xff00ff00, 0.5f);
    add_box(soup, {0, 0, 1, 2}, 0xffffffff);
    REQUIRE(soup.vertices.size() == 12);
    const std::pair<float, float> corners[] = {{10, 20}, {30, 20}, {30, 50}, {10, 20}, {30, 50}, {10, 50}};
    for (std::size_t v = 0; v < 6; ++v) {
        CHECK((soup.vertices[v].x == corners[v].first && soup.vertices[v].y == corners[v].second));
        CHECK(soup.vertices[v].z == 0.5f);
        CHECK(soup.vertices[v].front == std::array<float, 4>{0, 1, 0, 1});
    }
    for (std::uint32_t i = 0; i < 12; ++i) CHECK(soup.indices.at(i) == i);
    CHECK((soup.vertices[11].x == 0 && soup.vertices[11].y == 2 && soup.vertices[11].z == 0));
}

TEST_CASE("the next lower binary32 is the adjacent value across binades as well") {
    for (const float x : {1.0f, 0.5625f, 3.0e38f, 0x1p-126f, 0x1p-149f, 1.5f})
        CHECK(next_below(x) == std::nextafter(x, 0.0f));
}

TEST_CASE(
    "a textured quad has the coordinates of all units at each of its six vertices and combiners output a register") {
    std::array<TexturedCorner, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        corners[k].x = static_cast<float>(k);
        corners[k].y = static_cast<float>(k * k);
        for (std::size_t u = 0; u < rasterizer::texture_units; ++u)
            for (std::size_t c = 0; c < 4; ++c) corners[k].unit[u][c] = static_cast<float>(100 * k + 10 * u + c);
    }
    const TriangleSoup soup = textured_quad(corners, 0x80ffffff);
    const std::size_t order[] = {0, 1, 2, 0, 2, 3}, stride = 4 * rasterizer::texture_units;
    REQUIRE(soup.vertices.size() == 6);
    REQUIRE(soup.extras.values.size() == 6 * stride);
    CHECK(soup.extras.stride == stride);
    CHECK(soup.extras.has_units);
    int wrong = 0;
    for (std::size_t v = 0; v < 6; ++v) {
        wrong += soup.vertices[v].x == corners[order[v]].x && soup.vertices[v].y == corners[order[v]].y ? 0 : 1;
        wrong += soup.vertices[v].front[3] == 128 / 255.0f ? 0 : 1;
        for (std::size_t i = 0; i < stride; ++i)
            wrong += soup.extras.values[v * stride + i] == corners[order[v]].unit[i / 4][i % 4] ? 0 : 1;
    }
    CHECK(wrong == 0);
    using pipeline::CombinerRegister;
    const auto opaque = show(CombinerRegister::spare0, CombinerRegister::zero),
               own = show(CombinerRegister::spare0, CombinerRegister::spare1);
    CHECK(opaque.final_stage.d.source == CombinerRegister::spare0);
    CHECK(opaque.final_stage.g.source == CombinerRegister::zero);
    CHECK(opaque.final_stage.g.mapping == pipeline::CombinerMapping::unsigned_invert);
    CHECK(own.final_stage.g.source == CombinerRegister::spare1);
    CHECK(own.final_stage.g.mapping == pipeline::CombinerMapping::unsigned_identity);
}

TEST_CASE("an image becomes a rectangle texture of its codes") {
    pipeline::Image image{pipeline::Format::rgba8, 3, 2};
    for (std::size_t i = 0; i < image.codes.size(); ++i) image.codes[i] = static_cast<std::uint32_t>(7 * i);
    const pipeline::Texture texture = as_texture(image);
    CHECK((texture.width == 3 && texture.height == 2 && texture.texels.size() == 24));
    CHECK(texture.target == pipeline::TextureTarget::rectangle);
    CHECK(texture.filter == pipeline::TextureFilter::nearest);
    CHECK((texture.wrap_s == texture.wrap_t && texture.wrap_s == pipeline::TextureWrap::clamp_to_edge));
    for (std::size_t i = 0; i < 24; ++i) CHECK(texture.texels[i] == 7 * i);
}

TEST_CASE("a texel of a flat pattern has the fields of its packed value expanded to 8 bits") {
    struct Field {
        int shift, bits;
    };
    const std::array<Field, 4> formats[] = {{{{0, 8}, {8, 8}, {16, 8}, {24, 8}}},  // A8B8G8R8
                                            {{{16, 8}, {8, 8}, {0, 8}, {0, 0}}},   // X8R8G8B8
                                            {{{11, 5}, {5, 6}, {0, 5}, {0, 0}}},   // R5G6B5
                                            {{{10, 6}, {5, 5}, {0, 5}, {0, 0}}},   // R6G5B5
                                            {{{10, 5}, {5, 5}, {0, 5}, {0, 0}}},   // X1R5G5B5
                                            {{{10, 5}, {5, 5}, {0, 5}, {15, 1}}},  // A1R5G5B5
                                            {{{8, 4}, {4, 4}, {0, 4}, {12, 4}}}};  // A4R4G4B4
    int wrong = 0;
    for (std::size_t f = 0; f < 7; ++f)
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const std::uint32_t word = blended_formats[f].is_wide ? i * 2654435761u : (i * 40503u) & 0xffff;
            const pipeline::Texture texture = flat_pattern(blended_formats[f], 2, word);
            for (std::size_t t = 0; t < 16; ++t) {
                const Field& field = formats[f][t % 4];
                const std::uint32_t value = field.bits == 0 ? 0 : word >> field.shift & ((1u << field.bits) - 1);
                wrong += texture.texels.at(t) == (field.bits == 0 ? 255 : repeated(value, field.bits)) ? 0 : 1;
            }
        }
    CHECK(wrong == 0);
    for (std::size_t f = 0; f < 7; ++f) CHECK(blended_formats[f].is_wide == (f < 2));
}

TEST_CASE("a wide pattern consists of four equal quarters of ramps whose alpha decreases from the centre") {
    constexpr std::size_t side = 64, half = side / 2;
    const auto texels = radial_pattern(blended_formats[0], side).texels;
    const auto texel = [&](std::size_t x, std::size_t y, std::size_t c) {
        return int{texels.at(4 * (y * side + x) + c)};
    };
    int wrong = 0;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            const int down = static_cast<int>((y % half) * 255 / half),
                      right = static_cast<int>((x % half) * 255 / half);
            const double dx = double(x) - half, dy = double(y) - half, far = (dx * dx + dy * dy) / (2.0 * half * half);
            wrong += texel(x, y, 0) == down && texel(x, y, 1) == right && texel(x, y, 2) == 255 - down ? 0 : 1;
            wrong += std::abs(texel(x, y, 3) - 255 * (1 - far)) <= 1 ? 0 : 1;
        }
    CHECK(wrong == 0);
    CHECK(texel(half, half, 3) == 255);
    CHECK(texel(0, 0, 3) == 0);
}

TEST_CASE("a narrow pattern has blue that decreases to the right and red that increases downwards") {
    constexpr std::size_t side = 31;
    const auto texels = radial_pattern(blended_formats[6], side).texels;  // A4R4G4B4: a 4-bit digit is a multiple of 17
    const auto digit = [&](std::size_t x, std::size_t y, std::size_t c) {
        return texels.at(4 * (y * side + x) + c) / 17;
    };
    int wrong = 0;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            const double fx = x / 30.0, fy = y / 30.0, dx = x - 15.0, dy = y - 15.0;
            const auto is = [&](std::size_t c, double exact) {  // truncated; the exact value may be next to a binary32
                return digit(x, y, c) == std::floor(exact + 1e-5) || digit(x, y, c) == std::floor(exact - 1e-5);
            };
            wrong += is(2, 15 * (1 - fx)) && is(0, 15 * fy) && is(1, 15 * (fx * (1 - fy) + (1 - fx) * fy)) ? 0 : 1;
            wrong += is(3, 15 * (1 - (dx * dx + dy * dy) / 450)) ? 0 : 1;
        }
    CHECK(wrong == 0);
}

TEST_CASE("the test suite's camera projects world points as its matrix does") {
    const std::array<float, 4> white{1, 1, 1, 1};
    const ClipVertex centre = project(0, 0, 0, 16777215, white), right = project(1, 0, -6, 16777215, white),
                     above = project(0, 2, -3, 65535, white);
    CHECK((centre.x == 320 && centre.y == 240 && centre.w == 7));
    CHECK(right.x == Approx(320 + 240 * 2.414213562373095));
    CHECK(right.y == 240);
    CHECK(right.z == Approx(0).margin(1e-9));  // the near plane
    CHECK(above.y == Approx(240 - 240 * 2.414213562373095 * 2 / 4));
    CHECK(above.w == 4);
    CHECK(window_z(-6, 65535) == 0);
    CHECK(window_z(193, 65535) == Approx(65535).epsilon(1e-12));
    CHECK(window_z(0, 199) == Approx(200 * (1 - 1 / 7.0)));
    // A floor's corners, seen by a camera that looks down by 3 in 7. The expected positions are those of the chip, in
    // 1/16 pixel, three steps inside the exact ones.
    const float ahead = 7.0f * (1.0f / std::sqrt(58.0f)), start = 26.1299801f;
    const CompositeMatrix camera{
        {320.0f * chip_cotangent_x, 0, ahead * 320.0f, start * 320.0f}, {}, {}, {0, 0, ahead, start}};
    const auto sixteenth = [&](float x) { return std::trunc(16 * chip_window_point(camera, {x, 0, -10, 1})[0]); };
    CHECK(sixteenth(15000) == 16 * 513420.875);
    CHECK(sixteenth(-15000) == 16 * -512779.8125);
    double last = -1;
    for (float z = -6; z <= 193; z += 0.37f) {  // the chip's depth is near the exact one and monotonic
        const double chip = double{chip_window_z(z, 16777215.0f)};
        CHECK(std::fabs(chip - window_z(double{z}, 16777215)) < 40);
        CHECK(chip >= last);
        last = chip;
    }
}
