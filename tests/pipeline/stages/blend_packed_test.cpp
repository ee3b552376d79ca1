// Tests blending into packed targets: OVER in linear light step by step in binary32, rounded to a code once; masks,
// clamps, MAX, and blending off.
#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/formats/packed.h"
#include "pipeline/stages/blend.h"

namespace strata::testing::blend_packed {

namespace {

using namespace pipeline;

constexpr std::array packed_formats{Format::srgb8_alpha8, Format::rgb10_a2, Format::r11g11b10f};
using Channels = std::array<std::uint32_t, 4>;

const DeviceProfile& geforce8() { return *find_profile("geforce8_dx101"); }

Channels blended(Format format, const Blend& state, const Rgba& source, const Channels& stored) {
    std::array<rasterizer::Lanes<float>, 4> src{};
    std::array<rasterizer::Lanes<std::uint32_t>, 4> codes{};
    for (std::size_t c = 0; c < 4; ++c) src[c][0] = source[c], codes[c][0] = stored[c];
    blend_into(format, state, geforce8(), src, codes, 1);
    return {codes[0][0], codes[1][0], codes[2][0], codes[3][0]};
}

float value(Format format, std::size_t channel, std::uint32_t code) {
    return packed_value(format, static_cast<int>(channel), code, geforce8().color_rounding());
}
std::uint32_t code(Format format, std::size_t channel, float x) {
    return packed_code(format, static_cast<int>(channel), x, geforce8().color_rounding());
}
Channels codes_of(Format format, const Rgba& color) {
    return {code(format, 0, color[0]), code(format, 1, color[1]), code(format, 2, color[2]), code(format, 3, color[3])};
}

}  // namespace

TEST_CASE("OVER onto every code of a packed target blends its value and rounds to a code once") {
    std::size_t wrong = 0;
    for (const Format format : packed_formats)
        for (std::uint32_t k = 0; k < (format == Format::srgb8_alpha8 ? 256u : 1024u); ++k)
            for (const float alpha : {0.0f, 0.1f, 0.5f, 0.75f, 1.0f}) {
                const std::uint32_t stored = format == Format::r11g11b10f ? k << 5 : k;
                if (format == Format::r11g11b10f && stored >= 0x7c00) continue;
                const Rgba source{0.6f, 0.2f, 0.05f, alpha};
                const Channels result = blended(format, blend_mode::over, source, {stored, stored, stored, 0});
                for (std::size_t c = 0; c < 3; ++c) {
                    const float s = source[c] * alpha, rest = 1 - alpha, d = value(format, c, stored) * rest;
                    wrong += result[c] != code(format, c, s + d) ? 1 : 0;
                }
            }
    CHECK(wrong == 0);
}

TEST_CASE("white at half alpha over black is half the light in an sRGB target: code 188") {
    const Channels black{0, 0, 0, 255};
    CHECK(blended(Format::srgb8_alpha8, blend_mode::over, {1, 1, 1, 0.5f}, black)[0] == 188);
    CHECK(blended(Format::rgb10_a2, blend_mode::over, {1, 1, 1, 0.5f}, {0, 0, 0, 1023})[0] == 512);
    CHECK(blended(Format::r11g11b10f, blend_mode::over, {1, 1, 1, 0.5f}, {0, 0, 0, 0x3c00})[0] == 0x3800);
}

TEST_CASE("blending off stores the colour's codes, in the channels of the mask alone") {
    for (const Format format : packed_formats) {
        const Rgba color{0.3f, 0.7f, 0.9f, 0.4f};
        const Channels stored = codes_of(format, {1, 1, 1, 1});
        for (unsigned mask = 0; mask < 16; ++mask)
            for (const bool is_enabled : {false, true}) {
                Blend state;  // ONE and ZERO
                state.enabled = is_enabled;
                state.write_mask = static_cast<std::uint8_t>(mask);
                const Channels result = blended(format, state, color, stored);
                for (std::size_t c = 0; c < 4; ++c)
                    CHECK(result[c] == ((mask >> c & 1u) != 0 ? code(format, c, color[c]) : stored[c]));
            }
    }
}

TEST_CASE("sources are clamped before the blend where codes end at 1 and not in r11g11b10f") {
    const Channels black = codes_of(Format::srgb8_alpha8, {0, 0, 0, 1});
    CHECK(blended(Format::srgb8_alpha8, blend_mode::over, {4, -3, 4, 0.5f}, black)[0] == 188);
    CHECK(blended(Format::srgb8_alpha8, blend_mode::over, {4, -3, 4, 0.5f}, {9, 9, 9, 255})[1] ==
          code(Format::srgb8_alpha8, 1, value(Format::srgb8_alpha8, 1, 9) * 0.5f));
    CHECK(blended(Format::r11g11b10f, blend_mode::over, {4, 4, 4, 0.5f}, {0, 0, 0, 0})[0] ==
          code(Format::r11g11b10f, 0, 2.0f));
}

TEST_CASE("MAX keeps the code of the greater value in every packed format") {
    Blend state = blend_mode::over;
    state.color.equation = state.alpha.equation = BlendEquation::max;
    for (const Format format : packed_formats) {
        const Channels low = codes_of(format, {0.2f, 0.2f, 0.2f, 0.2f});
        CHECK(blended(format, state, {0.9f, 0.1f, 0.5f, 0}, low) == codes_of(format, {0.9f, 0.2f, 0.5f, 0.2f}));
    }
}

TEST_CASE("destination alpha of r11g11b10f is 1") {
    Blend state = blend_mode::over;
    state.color.src = BlendFactor::dst_alpha;
    state.color.dst = BlendFactor::zero;
    CHECK(blended(Format::r11g11b10f, state, {0.5f, 0.5f, 0.5f, 0}, codes_of(Format::r11g11b10f, {0, 0, 0, 0}))[0] ==
          0x3800);
}

TEST_CASE(
    "llvmpipe blends rgb10_a2 in 16 bits: every code survives a blend that keeps it, and OVER is that of integers") {
    const DeviceProfile& llvmpipe = *find_profile("llvmpipe");
    Blend keeps = blend_mode::over;
    keeps.color = keeps.alpha = {.src = BlendFactor::zero, .dst = BlendFactor::one};
    std::size_t wrong = 0;
    for (std::uint32_t k = 0; k < 1024; ++k) {
        std::array<rasterizer::Lanes<float>, 4> src{};
        std::array<rasterizer::Lanes<std::uint32_t>, 4> codes{};
        for (std::size_t c = 0; c < 4; ++c) src[c][0] = 0.5f, codes[c][0] = c == 3 ? 341 * (k % 4) : k;
        blend_into(Format::rgb10_a2, keeps, llvmpipe, src, codes, 1);
        wrong += codes[0][0] != k || codes[3][0] != 341 * (k % 4) ? 1 : 0;
        blend_into(Format::rgb10_a2, blend_mode::over, llvmpipe, src, codes, 1);
        // 0.5 is 32768 of 65535, the even one of two; products are rounded to 16 bits one by one.
        const auto product = [](std::uint64_t a, std::uint64_t b) {
            const std::uint64_t ab = a * b;
            return (ab + (ab >> 16) + 32768) >> 16;
        };
        const std::uint64_t stored = k * 64 + k / 16;
        wrong += codes[0][0] != (product(32768, 32768) + product(stored, 32767)) / 64 ? 1 : 0;
    }
    CHECK(wrong == 0);
}

}  // namespace strata::testing::blend_packed
