// Tests that invalid states and soups are rejected with the name of the fault, and that all accepted ones are drawn.
#include "rasterizer/set_up/check_input.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "rasterizer/base/input_error.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

// The error message for the changed input; "" if it is accepted.
template <class Thing>
std::string refused(Thing thing, const std::function<void(Thing&)>& change) {
    change(thing);
    try {
        check(thing);
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "";
}
std::string state(const std::function<void(RasterState&)>& change) { return refused(scene_state(16, 8), change); }
std::string soup(const std::function<void(TriangleSoup&)>& change) {
    return refused(random_soup(951, 4, SoupKind::flat), change);
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("a raster state is rejected with the name of its first wrong field") {
    CHECK(state([](RasterState&) {}).empty());
    CHECK(state([](RasterState& s) { s.viewport.x1 = 32769; }) ==
          "raster state: viewport.x1: expected 0 to 32768, found 32769");
    CHECK(state([](RasterState& s) { s.viewport.y0 = -1; }) ==
          "raster state: viewport.y0: expected 0 to 32768, found -1");
    CHECK(state([](RasterState& s) {
              s.viewport = {9, 0, 8, 8};
          }) == "raster state: viewport.x1: expected 9 to 32768, found 8");
    CHECK(state([](RasterState& s) { s.scissor = Rect{0, 0, 1 << 30, -(1 << 30)}; }).empty());
    CHECK(state([](RasterState& s) {
              s.scissor = Rect{0, std::numeric_limits<int>::min(), 4, 4};
          }) == "raster state: scissor.y0: expected -1073741824 to 1073741824, found -2147483648");
    CHECK(state([](RasterState& s) { s.depth_near = not_a_number; }) ==
          "raster state: depth_near: expected a finite number, found nan");
    CHECK(state([](RasterState& s) { s.depth_far = infinity; }) ==
          "raster state: depth_far: expected a finite number, found inf");
    CHECK(state([](RasterState& s) { s.polygon_offset.factor = -infinity; }) ==
          "raster state: polygon_offset.factor: expected a finite number, found -inf");
    CHECK(state([](RasterState& s) { s.polygon_offset.units = not_a_number; }).find("polygon_offset.units") !=
          std::string::npos);
    CHECK(state([](RasterState& s) { s.clip_plane_count = 7; }) ==
          "raster state: clip_plane_count: expected 0 to 6, found 7");
    CHECK(state([](RasterState& s) { s.clip_plane_count = -1; }) ==
          "raster state: clip_plane_count: expected 0 to 6, found -1");
    CHECK(state([](RasterState& s) {
              s.clip_plane_count = 3;
              s.clip_planes[2].c = not_a_number;
          }) == "raster state: clip_planes[2]: expected a finite number, found nan");
    CHECK(state([](RasterState& s) { s.clip_planes[2].c = not_a_number; }).empty());  // this clip plane is not enabled
    CHECK(state([](RasterState& s) { s.cull = static_cast<CullFace>(4); }) ==
          "raster state: cull: expected one of none, front, back, front_and_back, found 4");
    CHECK(state([](RasterState& s) { s.depth_format = static_cast<DepthFormat>(200); }) ==
          "raster state: depth_format: expected one of d16, d24, d32f, d16f, d24f, found 200");
}

TEST_CASE("a soup with numbers out of range is rejected with the first of them") {
    CHECK(soup([](TriangleSoup&) {}).empty());
    CHECK(soup([](TriangleSoup& s) { s.indices[7] = 12; }) ==
          "triangle soup: indices[7]: expected less than 12, found 12");
    CHECK(soup([](TriangleSoup& s) { s.vertices.clear(); }) ==
          "triangle soup: indices[0]: expected less than 0, found 0");
    CHECK(soup([](TriangleSoup& s) { s.runs[1].index_count = 5; }) ==
          "triangle soup: runs[1].index_count: expected a multiple of 3, found 5");
    CHECK(soup([](TriangleSoup& s) { s.runs[1].first_index = 0xffffffff; }) ==
          "triangle soup: runs[1]: expected an end within 12 indices, found 4294967301");
    // 4097 runs of the same 2^20 triangles.
    CHECK(soup([](TriangleSoup& s) {
              s.indices.assign(std::size_t{3} << 20, 0);
              s.runs.assign(4097, {.first_index = 0, .index_count = 3u << 20});
          }) == "triangle soup: runs: expected 0 to 4294967295, found 4296015872");
    CHECK(soup([](TriangleSoup& s) {
              s.order = {3, 0, 4};
          }) == "triangle soup: order[2]: expected less than 4, found 4");
    CHECK(soup([](TriangleSoup& s) { s.extras = {.stride = 1, .has_rq = true, .values = {}}; }) ==
          "triangle soup: extras.stride: expected 2 to 27, found 1");
    CHECK(soup([](TriangleSoup& s) { s.extras = {.stride = 28, .values = {}}; }) ==
          "triangle soup: extras.stride: expected 0 to 27, found 28");
    CHECK(soup([](TriangleSoup& s) {
              s.extras = {.stride = 2, .has_rq = true, .values = {1, 2, 3}};
          }) == "triangle soup: extras.values: expected 2 numbers for each of 12 vertices, found 3");
}

TEST_CASE("a soup or a state with any of its values changed is rejected by set_up or drawn") {
    constexpr std::uint64_t seed = 952;
    Random random{seed};
    int refusals = 0, drawn = 0;
    const auto word = [&]() -> std::uint32_t {
        switch (random_int(random, 0, 3)) {
            case 0: return static_cast<std::uint32_t>(random());
            case 1: return static_cast<std::uint32_t>(random_int(random, 0, 40));
            case 2: return 0x7fc00000;
            default: return 0xffffffff;
        }
    };
    for (int n = 0; n < 4000; ++n) {
        TriangleSoup s = random_soup(seed + static_cast<std::uint64_t>(n), 6, SoupKind::needs_clipping);
        RasterState raster = scene_state(16, 16);
        const auto pick = [&](std::size_t size) { return random() % size; };
        switch (random_int(random, 0, 9)) {
            case 0: s.indices[pick(s.indices.size())] = word(); break;
            case 1: s.runs[pick(2)].first_index = word(); break;
            case 2: s.runs[pick(2)].index_count = word(); break;
            case 3: s.order = {word(), word()}; break;
            case 4: s.vertices[pick(s.vertices.size())].x = std::bit_cast<float>(word()); break;
            case 5: s.vertices.resize(pick(s.vertices.size())); break;
            case 6: s.extras = {.stride = pick(20), .has_rq = pick(2) == 0, .values = {}}; break;
            case 7: raster.depth_near = std::bit_cast<float>(word()); break;
            case 8: raster.clip_plane_count = random_int(random, -2, 9); break;
            default: raster.viewport.x0 = static_cast<int>(word() >> random_int(random, 0, 31)); break;
        }
        try {
            Geometry geometry = set_up(s, raster, {}, 1);
            bin_triangles(geometry, 8);
            for (const DepthFormat format : {DepthFormat::d24, DepthFormat::d32f})
                static_cast<void>(draw(geometry, {DepthPath::float32, format}, {.color = true, .texcoord = true}));
            ++drawn;
        } catch (const strata::InputError&) {
            ++refusals;
        }
    }
    INFO("seed " << seed << ": " << refusals << " refused, " << drawn << " drawn");
    CHECK(refusals > 1000);
    CHECK(drawn > 1000);
}

TEST_CASE("tile sizes that the walks do not support are rejected") {
    Geometry geometry = set_up(random_soup(953, 4, SoupKind::flat), scene_state(16, 8), {}, 1);
    for (const int size : {-8, 0, 4, 24, 256})
        CHECK_THROWS_WITH(bin_triangles(geometry, size),
                          "bins: tile_size: expected 8, 16, 32, 64 or 128, found " + std::to_string(size));
}
