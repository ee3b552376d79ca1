// Tests ordinary shadow mapping against the geometry of a floor, a blocker and a light, without a depth map in the
// model.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr int size = 64;
constexpr double floor_z = -0.5, blocker_z = 0.25, half = 0.25;
constexpr float ambient = 0.375f;

Mesh square(double half_side, double z) {
    Mesh mesh;
    const auto s = static_cast<float>(half_side), depth = static_cast<float>(z);
    mesh.positions = {{-s, -s, depth}, {s, -s, depth}, {s, s, depth}, {-s, s, depth}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// The eye looks along -z and sees x and y of the world from -1 to 1. `w`: the light's divisor, 1 or 3 - z.
DrawList floor_and_blocker(AlphaMode mode, bool perspective) {
    DrawList list;
    list.materials = {{.name = "white", .alpha_mode = AlphaMode::opaque, .double_sided = true, .unlit = true},
                      {.name = "black",
                       .front = {0, 0, 0, 1},
                       .back = {0, 0, 0, 1},
                       .alpha_mode = mode,
                       .double_sided = true,
                       .unlit = true}};
    list.meshes = {square(1, floor_z), square(half, blocker_z)};
    list.instances = {{.mesh = 0, .material = 0}, {.mesh = 1, .material = 1}};
    ShadowLight light;
    light.view = {1, 0, 0, 0, 0, 1, 0, 0, -0.4, 0.3, 1, 0, 0, 0, 0, 1};  // x - 0.4 z, y + 0.3 z: slanted light
    light.projection = perspective ? Matrix{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, 0, 3}
                                   : Matrix{0.7, 0, 0, 0, 0, 0.7, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
    light.size_px = 256;
    light.ambient = ambient;
    light.offset_units = 16;
    light.percentage_closer = false;
    list.light = light;
    return list;
}

const View from_above{.view = identity, .projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}};

struct Place {
    double x, y;
};
Place seen_by_light(double x, double y, double z, bool perspective) {
    const double w = perspective ? (3 - z) / 2 : 1 / 0.7;
    return {(x - 0.4 * z) / w, (y + 0.3 * z) / w};
}

// Positive inside the blocker's outline as the light sees it, in the light's clip space.
double inside(double x, double y, bool perspective) {
    const Place p = seen_by_light(x, y, floor_z, perspective);
    const Place low = seen_by_light(-half, -half, blocker_z, perspective),
                high = seen_by_light(half, half, blocker_z, perspective);
    return std::min({p.x - low.x, high.x - p.x, p.y - low.y, high.y - p.y});
}

}  // namespace

TEST_CASE("the floor is dark only where the blocker is between it and the light") {
    for (const bool perspective : {false, true})
        for (const char* profile : {"geforce3", "geforce8", "ideal"}) {
            strata::peeling::RenderOptions options;
            options.width = options.height = size;
            options.threads = 1;
            const DrawList list = floor_and_blocker(AlphaMode::opaque, perspective);
            const auto result = render(list, from_above, {profile, "unsorted"}, options);
            REQUIRE(result.outcome == strata::peeling::Outcome::done);
            std::size_t wrong = 0, dark = 0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const double wx = (x + 0.5) * 2 / size - 1, wy = 1 - (y + 0.5) * 2 / size;
                    if (std::max(std::abs(wx), std::abs(wy)) < half + 0.05) continue;  // the blocker itself
                    const double depth_inside = inside(wx, wy, perspective);
                    if (std::abs(depth_inside) < 2.0 / 256)
                        continue;  // within a texel of the map from the shadow's
                                   // border
                    const std::uint32_t code = result.frame.color.codes[result.frame.color.index(x, y)];
                    const bool is_float = result.frame.color.format == Format::rgba32f;
                    const float value = is_float ? std::bit_cast<float>(code) : static_cast<float>(code) / 255.0f;
                    wrong += std::abs(value - (depth_inside > 0 ? ambient : 1.0f)) > 0.003f;
                    dark += depth_inside > 0;
                }
            INFO(profile << (perspective ? ", perspective light" : ", parallel light"));
            CHECK(dark > 30);
            CHECK(wrong == 0);
        }
}

// The eye's first plane keeps what is right of the window's middle for the eye. It does not clip the light's view: the
// shadow of the blocker's left half still falls on the right half of the floor.
TEST_CASE("a clip plane of the eye clips the eye's view and not the light's map") {
    const DrawList list = floor_and_blocker(AlphaMode::opaque, false);
    strata::peeling::RenderOptions options;
    options.width = options.height = size;
    options.threads = 1;
    const auto whole = render(list, from_above, {"geforce8", "unsorted"}, options);
    options.raster.clip_planes[0] = {1, 0, 0, 0};
    options.raster.clip_plane_count = 1;
    const auto right = render(list, from_above, {"geforce8", "unsorted"}, options);
    REQUIRE(right.outcome == strata::peeling::Outcome::done);
    std::size_t unlike = 0, left = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const std::size_t at = whole.frame.color.index(x, y);
            if (x > size / 2) unlike += right.frame.color.codes[at] != whole.frame.color.codes[at] ? 1 : 0;
            if (x < size / 2 - 1) left += right.frame.color.codes[at] != 0 ? 1 : 0;
        }
    CHECK(unlike == 0);
    CHECK(left == 0);
}

TEST_CASE("transparent surfaces transmit light and colours in shadow are the same in every execution") {
    const DrawList list = floor_and_blocker(AlphaMode::blend, true);
    strata::peeling::RenderOptions options;
    options.width = options.height = size;
    options.threads = 1;
    options.execution = Execution::literal;
    const auto lit = render(list, from_above, {"geforce8", "dual"}, options);
    std::uint32_t darkest = 255;  // in the right half of the floor, where the shadow is expected
    for (int y = 0; y < size; ++y)
        for (int x = size * 3 / 4; x < size; ++x)
            darkest = std::min(darkest, lit.frame.color.codes[lit.frame.color.index(x, y)]);
    CHECK(darkest == 255);

    const DrawList opaque = floor_and_blocker(AlphaMode::opaque, true);
    options.alpha = 0.5f;
    for (const char* algorithm : {"dual", "front_to_back", "unsorted"}) {
        options.execution = Execution::literal;
        const auto expected = render(opaque, from_above, {"geforce8", algorithm}, options);
        CHECK(expected.frame.color != lit.frame.color);
        for (const Running& running : all_ways_of_running)
            for (const Effects effects : {Effects::needed, Effects::all}) {
                auto other = options;
                running.apply(other);
                other.effects = effects;
                CHECK(render(opaque, from_above, {"geforce8", algorithm}, other).frame.color == expected.frame.color);
            }
    }
}
