// Tests that a surface keeps its own copy of the profile: later changes of the caller's profile change no pixel.
#include "pipeline/region/surface.h"

#include <catch2/catch.hpp>

using namespace strata::pipeline;

namespace {

// Half of grey 101 over half of 50: 75.5, which the profile's blend rounding rounds up or truncates.
std::uint8_t blended(Surface& surface) {
    surface.clear_color({50, 50, 50, 255});
    strata::rasterizer::TriangleSoup soup;
    for (const auto& [x, y] : {std::pair{-8.0f, -8.0f}, std::pair{40.0f, -8.0f}, std::pair{-8.0f, 40.0f}})
        soup.vertices.push_back({.x = x,
                                 .y = y,
                                 .front = {101 / 255.0f, 101 / 255.0f, 101 / 255.0f, 0.5f},
                                 .back = {101 / 255.0f, 101 / 255.0f, 101 / 255.0f, 0.5f}});
    soup.indices = {0, 1, 2};
    DrawState state;
    state.blend = blend_mode::over;
    CHECK(surface.draw(state, soup) == 64);
    return static_cast<std::uint8_t>(surface.color().codes[0]);
}

}  // namespace

TEST_CASE("the image of a narrow surface has 8-bit codes with the missing bits filled in") {
    for (const Format format : {Format::r5g6b5, Format::x1r5g5b5, Format::x8r8g8b8, Format::rgba8}) {
        Surface surface{*find_profile("geforce3"), {.color = format, .width = 8, .height = 8}};
        surface.clear_color({255, 255, 255, 255});
        CHECK(surface.color().format == Format::rgba8);
    }
}

TEST_CASE("a surface draws with the profile that it was made with even if that is changed or destroyed") {
    const DeviceProfile& geforce3 = *find_profile("geforce3");
    auto profile = std::make_unique<DeviceProfile>(geforce3);
    Surface surface{*profile, {.width = 8, .height = 8}};
    const std::uint8_t before = blended(surface);
    profile->blend_rounding =
        geforce3.blend_rounding == BlendRounding::nearest ? BlendRounding::truncate : BlendRounding::nearest;
    CHECK(blended(surface) == before);
    Surface changed{*profile, {.width = 8, .height = 8}};
    CHECK(blended(changed) != before);  // the two roundings differ here
    profile.reset();
    CHECK(blended(surface) == before);
    Surface moved = std::move(surface);
    CHECK(blended(moved) == before);
}
