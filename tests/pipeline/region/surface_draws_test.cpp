// Tests the values that are written, drawn and tested on surfaces of each format. The expected codes are integers
// worked out by hand, positions are given by row and column.
#include <catch2/catch.hpp>

#include "pipeline/device/check.h"
#include "pipeline/geforce3/texture_environment.h"
#include "pipeline/region/fragment_path.h"
#include "pipeline/region/surface.h"

namespace {

using namespace strata::pipeline;

// A triangle that covers a complete surface of 20 x 5.
strata::rasterizer::TriangleSoup cover(const std::array<float, 4>& color) {
    strata::rasterizer::TriangleSoup soup;
    for (const auto& [x, y] : {std::pair{-8.0f, -8.0f}, std::pair{80.0f, -8.0f}, std::pair{-8.0f, 80.0f}})
        soup.vertices.push_back({.x = x, .y = y, .front = color, .back = color});
    soup.indices = {0, 1, 2};
    return soup;
}

constexpr int surface_width = 20, surface_height = 5;

Surface surface_of(Format format) {
    return {*find_profile("geforce3"), {.color = format, .width = surface_width, .height = surface_height}};
}

std::vector<std::uint32_t> stencils(const Surface& surface) {
    const Image image = surface.stencil();
    return {image.codes.begin(), image.codes.end()};
}

// The bits of an 8-bit code that a narrow surface keeps; a channel that it does not store is read as 255.
std::uint32_t kept(Format format, int channel, std::uint32_t code) {
    if (format == Format::rgba8) return code;
    if (channel == 3) return 255;
    if (format == Format::x8r8g8b8) return code;
    const std::uint32_t lost = format == Format::r5g6b5 && channel == 1 ? 4 : 8;
    return code - code % lost;
}

}  // namespace

TEST_CASE("a surface that is filled has every pixel's value at its position truncated to what its format stores") {
    for (const Format format : {Format::rgba8, Format::x8r8g8b8, Format::r5g6b5, Format::x1r5g5b5}) {
        Surface surface = surface_of(format);
        const auto value = [](int x, int y) {
            return PixelCode{static_cast<std::uint8_t>(12 * x + y), static_cast<std::uint8_t>(50 * y + x),
                             static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(255 - x)};
        };
        surface.fill(value);
        const Image image = surface.color();
        std::size_t wrong = 0;
        for (int y = 0; y < surface_height; ++y)
            for (int x = 0; x < surface_width; ++x)
                for (int c = 0; c < 4; ++c) {
                    const std::uint32_t found = image.codes[static_cast<std::size_t>((y * surface_width + x) * 4 + c)];
                    wrong += found != kept(format, c, value(x, y)[static_cast<std::size_t>(c)]);
                }
        INFO("format " << static_cast<int>(format));
        CHECK(wrong == 0);
    }
}

TEST_CASE("colours drawn to a narrow surface lose the bits that it does not store with and without blending") {
    for (const Format format : {Format::rgba8, Format::x8r8g8b8, Format::r5g6b5, Format::x1r5g5b5}) {
        Surface surface = surface_of(format);
        const std::array<float, 4> color{203 / 255.0f, 103 / 255.0f, 53 / 255.0f, 1};
        for (const bool is_blended : {false, true}) {
            surface.clear_color({0, 0, 0, 0});
            DrawState state;
            if (is_blended) state.blend = blend_mode::sum;  // 0 + the source, which a narrow surface truncates first
            CHECK(surface.draw(state, cover(color)) == surface_width * surface_height);
            const Image image = surface.color();
            INFO("format " << static_cast<int>(format) << (is_blended ? ", blended" : ""));
            for (int c = 0; c < 4; ++c) {
                const std::uint32_t code = std::array{203u, 103u, 53u, 255u}[static_cast<std::size_t>(c)];
                CHECK(image.codes[static_cast<std::size_t>(c)] == kept(format, c, code));
            }
        }
    }
}

TEST_CASE("a surface's stencil test passes by the stored stencil and applies its operation") {
    Surface surface = surface_of(Format::rgba8);
    surface.clear_stencil(3);
    DrawState state;
    state.stencil = {.enabled = true,
                     .front = {.func = CompareFunc::equal, .ref = 3, .fail = StencilOp::zero, .pass = StencilOp::incr},
                     .back = {}};
    CHECK(surface.draw(state, cover({1, 0, 0, 1})) == surface_width * surface_height);
    CHECK(stencils(surface) == std::vector<std::uint32_t>(surface_width * surface_height, 4));
    CHECK(surface.draw(state, cover({0, 1, 0, 1})) == 0);  // 3 is not 4
    CHECK(stencils(surface) == std::vector<std::uint32_t>(surface_width * surface_height, 0));
    CHECK(surface.color().codes[0] == 255);
}

TEST_CASE("a surface draws through texture shader and combiners if it has a fragment path") {
    Surface surface = surface_of(Format::rgba8);
    FragmentPath path;
    path.combiners = texture_environment({});
    DrawState state;
    state.path = &path;
    CHECK(surface.draw(state, cover({51 / 255.0f, 0, 1, 1})) == surface_width * surface_height);
    const Image image = surface.color();
    CHECK(std::vector(image.codes.begin(), image.codes.begin() + 4) == std::vector<std::uint32_t>{51, 0, 255, 255});
}

TEST_CASE("a surface in a format that the device lacks is rejected with the format's name") {
    const auto refusal = [](const char* profile, const SurfaceLayout& layout) -> std::string {
        try {
            const Surface surface{*find_profile(profile), layout};
        } catch (const Refused& refused) {
            return refused.what();
        }
        return "drawn";
    };
    CHECK(refusal("geforce3", {.color = Format::rgba32f, .width = 8, .height = 8}).find("float") != std::string::npos);
    CHECK(refusal("geforce3", {.depth = DepthFormat::d32f, .width = 8, .height = 8}) != "drawn");
    CHECK(refusal("geforce8", {.color = Format::r5g6b5, .width = 8, .height = 8}) != "drawn");
    CHECK(refusal("geforce3", {.color = Format::r5g6b5, .width = 8, .height = 8}) == "drawn");
}
