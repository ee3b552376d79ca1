// Tests the sixteen logical operations against their truth tables for every pair of codes, and on surfaces: formats,
// masks, profiles, and a rubber band.
#include "pipeline/formats/logic_op.h"

#include <catch2/catch.hpp>
#include <random>

#include "pipeline/device/check.h"
#include "pipeline/region/surface.h"
#include "rasterizer/base/enum_values.h"
#include "tests/pipeline/blend_model.h"

namespace {

using namespace strata::pipeline;
namespace raster = strata::rasterizer;

// OpenGL numbers the operations from GL_CLEAR (0x1500) on by their truth tables: bit 0 of the number is the result of s
// = d = 1, bit 1 of s = 1 and d = 0, bit 2 of s = 0 and d = 1, bit 3 of s = d = 0.
constexpr std::array gl_order{LogicOp::clear,         LogicOp::and_both,    LogicOp::and_reverse, LogicOp::copy,
                              LogicOp::and_inverted,  LogicOp::noop,        LogicOp::xor_both,    LogicOp::or_both,
                              LogicOp::nor,           LogicOp::equiv,       LogicOp::invert,      LogicOp::or_reverse,
                              LogicOp::copy_inverted, LogicOp::or_inverted, LogicOp::nand,        LogicOp::set};

std::uint32_t by_truth_table(std::size_t number, std::uint32_t s, std::uint32_t d, int bits) {
    std::uint32_t result = 0;
    for (int b = 0; b < bits; ++b) {
        const bool source = (s >> b & 1u) != 0, stored = (d >> b & 1u) != 0;
        const unsigned row = source ? (stored ? 0 : 1) : (stored ? 2 : 3);
        result |= (static_cast<std::uint32_t>(number) >> row & 1u) << b;
    }
    return result;
}

raster::TriangleSoup soup_of(const std::vector<std::array<float, 2>>& ends, std::size_t corners,
                             const std::array<float, 4>& color) {
    raster::TriangleSoup soup;
    for (const auto& [x, y] : ends) {
        raster::ClipVertex v{.x = x, .y = y, .z = 0.5f};
        v.front = v.back = color;
        soup.vertices.push_back(v);
    }
    for (std::uint32_t i = 0; i < ends.size(); i += static_cast<std::uint32_t>(corners)) {
        soup.indices.push_back(i);  // a line's indices are A, A, B
        for (std::uint32_t k = 1; k < 3; ++k) soup.indices.push_back(corners == 3 ? i + k : i + k - 1);
    }
    return soup;
}

constexpr int logic_side = 32;

raster::TriangleSoup whole_window(const std::array<float, 4>& color) {
    constexpr float far = 2 * logic_side;
    return soup_of({{0, 0}, {far, 0}, {0, far}}, 3, color);
}

Surface noise_surface(std::string_view profile, Format format) {
    Surface surface{*find_profile(profile), {format, DepthFormat::d24, logic_side, logic_side}};
    std::mt19937 random{5};
    surface.fill([&](int, int) {
        PixelCode pixel{};
        for (std::uint8_t& code : pixel) code = static_cast<std::uint8_t>(random());
        return pixel;
    });
    return surface;
}

}  // namespace

TEST_CASE("each logical operation combines every source code with every stored code bit by bit") {
    static Colors src;
    static Codes codes, stored;
    static raster::Lanes<std::uint16_t> place;
    const DeviceProfile profile;
    int wrong = 0;
    for (std::size_t number = 0; number < gl_order.size(); ++number) {
        const Blend state{.enabled = true, .color = blend_mode::over.color, .alpha = {}, .logic_op = gl_order[number]};
        Blend unblended = state;
        unblended.enabled = state.blends();
        for (std::uint32_t d = 0; d < 256; ++d) {
            for (std::size_t c = 0; c < 4; ++c)
                for (std::uint32_t s = 0; s < 256; ++s) {
                    src[c][s] = static_cast<float>(s) / 255.0f;
                    codes[c][s] = stored[c][s] = (d + 37 * static_cast<std::uint32_t>(c)) % 256;
                }
            blend_into(Format::rgba8, unblended, profile, src, codes, 256);
            finish_codes(Format::rgba8, unblended, src, {place, place, stored}, codes, 256);
            for (std::size_t c = 0; c < 4; ++c)
                for (std::uint32_t s = 0; s < 256; ++s)
                    wrong += codes[c][s] != by_truth_table(number, s, stored[c][s], 8) ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    int wide = 0;  // ten bits
    for (std::size_t number = 0; number < gl_order.size(); ++number)
        for (std::uint32_t s = 0; s < 1024; s += 7)
            for (std::uint32_t d = 0; d < 1024; d += 5)
                wide += combined(gl_order[number], s, d, 1023) != by_truth_table(number, s, d, 10) ? 1 : 0;
    CHECK(wide == 0);
}

TEST_CASE("an operation reads the stored codes unless they cannot change its result") {
    for (std::size_t number = 0; number < gl_order.size(); ++number) {
        const bool depends = by_truth_table(number, 0, 0, 1) != by_truth_table(number, 0, 1, 1) ||
                             by_truth_table(number, 1, 0, 1) != by_truth_table(number, 1, 1, 1);
        CHECK(reads_stored(gl_order[number]) == depends);
    }
}

TEST_CASE("a drawn logical operation keeps masked channels and the bits of narrow surfaces, and disables blending") {
    const std::array<float, 4> color{200.0f / 255, 90.0f / 255, 13.0f / 255, 77.0f / 255};
    const std::array<std::uint32_t, 4> source{200, 90, 13, 77};
    for (const Format format : {Format::rgba8, Format::x8r8g8b8, Format::r5g6b5, Format::x1r5g5b5}) {
        // The bits that a pixel of the format stores of each channel.
        const std::array<std::uint32_t, 4> kept =
            format == Format::r5g6b5 ? std::array<std::uint32_t, 4>{0xf8, 0xfc, 0xf8, 0}
            : format == Format::x1r5g5b5
                ? std::array<std::uint32_t, 4>{0xf8, 0xf8, 0xf8, 0}
                : std::array<std::uint32_t, 4>{255, 255, 255, format == Format::rgba8 ? 255u : 0u};
        for (std::size_t number = 0; number < gl_order.size(); ++number) {
            Surface surface = noise_surface("geforce3", format);
            const Image before = surface.color();
            DrawState state{.blend = blend_mode::over, .color_mask = 0xb};  // without blue
            state.blend.logic_op = gl_order[number];
            surface.draw(state, whole_window(color));
            const Image after = surface.color();
            int wrong = 0;
            for (std::size_t i = 0; i < after.codes.size(); ++i) {
                const std::size_t c = i % 4;
                const std::uint32_t drawn = by_truth_table(number, source[c], before.codes[i], 8) & kept[c];
                const std::uint32_t expected = c == 2 ? before.codes[i] : kept[c] == 0 ? 255 : drawn;
                wrong += after.codes[i] != expected ? 1 : 0;
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("float and sRGB targets store the source of a pass with a logical operation, unblended") {
    for (const Format format : {Format::rgba16f, Format::rgba32f, Format::srgb8_alpha8, Format::r11g11b10f}) {
        const auto drawn = [&](const Blend& blend) {
            Surface surface{*find_profile("ideal"), {format, DepthFormat::d24, logic_side, logic_side}};
            surface.draw({}, whole_window({0.25f, 0.5f, 0.75f, 1}));
            surface.draw({.blend = blend}, whole_window({0.3f, 0.6f, 0.1f, 0.4f}));
            return surface.color().codes;
        };
        Blend state = blend_mode::over;
        state.logic_op = LogicOp::xor_both;
        CHECK(drawn(state) == drawn({}));
        CHECK(drawn(state) != drawn(blend_mode::over));
    }
}

TEST_CASE("a rubber band that is drawn twice with XOR restores the picture") {
    for (const char* profile : {"geforce3", "geforce8", "ideal", "llvmpipe", "softpipe"})
        for (const float width : {1.0f, 3.0f}) {
            INFO(profile << ' ' << width);
            Surface surface = noise_surface(profile, Format::rgba8);
            const Image before = surface.color();
            DrawState state{.blend = blend_mode::over, .line_width_px = width};
            state.blend.logic_op = LogicOp::xor_both;
            const auto band = [&] {
                const std::vector<std::array<float, 2>> box{{4.5f, 5.5f},   {27.5f, 5.5f},  {27.5f, 5.5f},
                                                            {27.5f, 25.5f}, {27.5f, 25.5f}, {4.5f, 25.5f},
                                                            {4.5f, 25.5f},  {4.5f, 5.5f}};
                return surface.draw(state, soup_of(box, 2, {1, 1, 1, 1}), raster::Primitive::lines);
            };
            CHECK(band() >= 80);
            const Image during = surface.color();
            int inverted = 0, other = 0;
            for (std::size_t i = 0; i < before.codes.size(); ++i)
                if (during.codes[i] != before.codes[i]) ++(during.codes[i] == 255 - before.codes[i] ? inverted : other);
            CHECK(inverted >= 300);
            CHECK(other == 0);
            band();
            CHECK(surface.color().codes == before.codes);
        }
}

TEST_CASE("profiles without logical operations refuse them by name") {
    Blend state;
    state.logic_op = LogicOp::copy;
    for (const char* name : {"swiftshader", "direct3d11"})
        CHECK(check(*find_profile(name), state)->message(*find_profile(name)) ==
              std::string{"profile "} + name +
                  " has no logical operations on colours; use geforce3, geforce8, geforce8_dx101, ideal, llvmpipe, "
                  "llvmpipe_sse or softpipe");
    CHECK_FALSE(check(*find_profile("geforce8"), state));
    Surface surface{*find_profile("direct3d11"), {Format::rgba8, DepthFormat::d24, logic_side, logic_side}};
    CHECK_THROWS_AS(surface.draw({.blend = state}, whole_window({1, 1, 1, 1})), Refused);
}
