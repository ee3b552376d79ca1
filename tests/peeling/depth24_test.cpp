// Tests that a device whose 24-bit depth buffers hold binary32 (rasterizer/reference/depth.md 2.10) draws the same as
// with a 32-bit float buffer.
#include <catch2/catch.hpp>

#include "pipeline/region/surface.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

using namespace strata::testing;
using namespace strata::pipeline;

TEST_CASE("a 24-bit buffer of binary32 behaves like a float depth buffer and one of codes does not") {
    const TriangleScene scene = random_triangles(91, 20);
    const auto drawn = [&](const DeviceProfile& profile, DepthFormat format, const char* algorithm) {
        strata::peeling::RenderOptions options;
        options.width = 24;
        options.height = 20;
        options.threads = 1;
        options.depth = format;
        strata::peeling::Renderer renderer{scene.list, scene.view, profile, options};
        CHECK(renderer.depth_format() == profile.stored(format));
        return renderer.render(*strata::peeling::find_algorithm(algorithm));
    };
    DeviceProfile codes = *find_profile("swiftshader");
    codes.depth24 = Depth24::codes;
    for (const char* algorithm : {"front_to_back", "dual", "a_buffer"}) {
        INFO(algorithm);
        const auto kept = drawn(*find_profile("swiftshader"), DepthFormat::d24, algorithm);
        const auto floats = drawn(codes, DepthFormat::d32f, algorithm);
        const auto fixed = drawn(codes, DepthFormat::d24, algorithm);
        CHECK(kept.frame.color == floats.frame.color);
        CHECK(kept.frame.depth == floats.frame.depth);
        CHECK(kept.frame.depth.format == Format::d32f);
        // The depths of dual peeling are written by its program.
        CHECK((fixed.frame.depth.format == Format::d24) == (std::string_view{algorithm} != "dual"));
    }
    const auto d16 = drawn(*find_profile("swiftshader"), DepthFormat::d16, "front_to_back");
    CHECK(d16.frame.depth.format == Format::d16);
    DeviceProfile without = *find_profile("swiftshader");
    without.has_d24 = false;
    CHECK(without.stored(DepthFormat::d24) == DepthFormat::d24);
    CHECK(without.depth_buffer({}) == DepthFormat::d32f);
    without.has_d24 = true;
    without.has_d32f = false;
    CHECK(without.depth_buffer({}) == DepthFormat::d32f);
    without.depth24 = Depth24::codes;
    CHECK(without.depth_buffer({}) == DepthFormat::d24);
}

TEST_CASE("a surface with a 24-bit buffer of binary32 holds the float's bits") {
    Surface surface{*find_profile("swiftshader"), {.depth = DepthFormat::d24, .width = 8, .height = 8}};
    surface.clear_depth(std::bit_cast<std::uint32_t>(1.0f));
    strata::rasterizer::TriangleSoup soup;
    for (const auto& [x, y] : {std::pair{-8.0f, -8.0f}, std::pair{40.0f, -8.0f}, std::pair{-8.0f, 40.0f}})
        soup.vertices.push_back({.x = x, .y = y, .z = 0.3f});
    soup.indices = {0, 1, 2};
    DrawState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    CHECK(surface.draw(state, soup) == 64);
    CHECK(surface.depth().format == Format::d32f);
    CHECK(surface.depth().codes[9] == std::bit_cast<std::uint32_t>(0.3f));
}
