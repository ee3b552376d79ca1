// Tests the depth bounds of random triangles against their fragments: none is beyond its triangle's bound, and some
// come close.
#include "rasterizer/set_up/depth_bound.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "rasterizer/walk/tile_rasterizer.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

float greatest_z(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    float greatest = -std::numeric_limits<float>::infinity();
    auto look = [&](FragmentBatch& batch) {
        for (int i = 0; i < batch.count; ++i)
            greatest = std::max(greatest, batch.shader_z[static_cast<std::size_t>(i)]);
    };
    constexpr FragmentNeeds z_alone{true, false, false, false, false, false};
    TileRasterizer{geometry.state.viewport}.draw(geometry, triangles, {}, z_alone, BatchSink{look});
    return greatest;
}

// Over triangles that have fragments: their number, and how many bounds are before a fragment or close behind the last
// one.
struct BoundTally {
    int beyond = 0, close = 0, drawn = 0;
};

void compare_bounds(const Geometry& geometry, BoundTally& tally) {
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const float greatest = greatest_z(geometry, {&i, 1});
        const double bound = depth_bound(geometry, {&i, 1});
        if (greatest == -std::numeric_limits<float>::infinity()) continue;
        ++tally.drawn;
        tally.beyond += double{greatest} > bound ? 1 : 0;
        tally.close += bound - double{greatest} < 0.1 ? 1 : 0;
    }
}

}  // namespace

TEST_CASE("no fragment is behind the depth bound of its triangle and the bound is seldom far behind the fragments") {
    BoundTally tally;
    for (const SoupKind kind : {SoupKind::flat, SoupKind::perspective, SoupKind::needs_clipping})
        for (const PlaneOrigin origin : {PlaneOrigin::snapped, PlaneOrigin::unsnapped})
            for (const Snap snap : {Snap::nearest_even, Snap::toward_zero})
                for (const int bits : {4, 8}) {
                    const RasterRules rules{.subpixel_bits = bits, .snap = snap, .plane_origin = origin};
                    RasterState state = scene_state(61, 47);
                    state.polygon_offset = {kind == SoupKind::flat, 1.5f, 20.0f};
                    const Geometry geometry = set_up(random_soup(900, 80, kind), state, rules, 1);
                    compare_bounds(geometry, tally);
                }
    CHECK(tally.beyond == 0);
    CHECK(tally.drawn > 1000);
    CHECK(tally.close > tally.drawn / 2);
}

TEST_CASE("no fragment is behind the bound of a plane stepped in binary32 and few bounds are far behind") {
    BoundTally tally;
    for (const SoupKind kind : {SoupKind::flat, SoupKind::perspective, SoupKind::needs_clipping})
        for (const PlaneRule plane :
             {PlaneRule::reciprocal_area, PlaneRule::reciprocal_area_fused, PlaneRule::least_corner})
            for (const CoverageRule coverage : {CoverageRule::snapped_edges, CoverageRule::float_spans})
                for (const int width : {61, 1900}) {
                    const RasterRules rules{.coverage = coverage,
                                            .clip = ClipVolume::view_volume,
                                            .plane_origin = PlaneOrigin::unsnapped,
                                            .plane_rule = plane};
                    const Geometry geometry = set_up(random_soup(903, 48, kind), scene_state(width, 47), rules, 1);
                    compare_bounds(geometry, tally);
                }
    CHECK(tally.beyond == 0);
    CHECK(tally.drawn > 1000);
    CHECK(tally.close > tally.drawn / 3);
}

// Their area is a small difference of large products, so a slope is wrong by many units.
TEST_CASE("no fragment of a sliver is behind the bound of a plane stepped in binary32") {
    Random random{904};
    TriangleSoup soup;
    for (std::uint32_t i = 0; i < 3 * 200; ++i) {
        const float along = static_cast<float>(i % 3) - 1.0f;
        const auto beside = [&] { return random_float(random, -0.002f, 0.002f); };
        const float x = along * random_float(random, 0.3f, 0.9f), dx = beside(), dy = beside();
        soup.vertices.push_back({.x = x + dx, .y = x + dy, .z = random_float(random, -0.9f, 0.9f), .w = 1.0f});
        soup.indices.push_back(i);
    }
    soup.runs = {{.index_count = 3 * 200, .double_sided = true}};
    BoundTally tally;
    for (const PlaneRule plane :
         {PlaneRule::reciprocal_area, PlaneRule::reciprocal_area_fused, PlaneRule::least_corner}) {
        const RasterRules rules{
            .clip = ClipVolume::view_volume, .plane_origin = PlaneOrigin::unsnapped, .plane_rule = plane};
        compare_bounds(set_up(soup, scene_state(1900, 1900), rules, 1), tally);
    }
    CHECK(tally.beyond == 0);
    CHECK(tally.drawn > 300);
}

// Corners at 0, 2000 and 4000 on a diagonal, the last a subpixel off it: the area, 7.8 from products of 8,000,000, may
// be completely wrong in binary32, and so may the slope.
TEST_CASE("a sliver whose area is unknown in binary32 has no bound") {
    const std::uint32_t only = 0;
    for (const int beside : {1, 4000}) {
        const SetupTriangle sliver =
            window_triangle({{{0, 0}, {2000 << 8, 2000 << 8}, {4000 << 8, (4000 << 8) + beside}}}, 8, {0.0, 0.5, 0.25});
        const RasterRules rules{
            .subpixel_bits = 8, .plane_origin = PlaneOrigin::unsnapped, .plane_rule = PlaneRule::reciprocal_area};
        const Geometry geometry = window_geometry({sliver}, 4096, 4096, rules);
        CHECK(std::isinf(depth_bound(geometry, {&only, 1})) == (beside == 1));
    }
}

TEST_CASE("the bound of several triangles is their greatest and the bound of none is below every depth") {
    const Geometry geometry = set_up(random_soup(901, 20, SoupKind::perspective), scene_state(40, 40), {}, 1);
    double greatest = -std::numeric_limits<double>::infinity();
    CHECK(depth_bound(geometry, {}) == greatest);
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i)
        greatest = std::max(greatest, depth_bound(geometry, {&i, 1}));
    CHECK(depth_bound(geometry, geometry.all_triangles) >= greatest - 0x1p-18);
    CHECK(depth_bound(geometry, geometry.all_triangles) <= greatest + 0x1p-18);
}

TEST_CASE("the bound is a depth from 0 to 1 where vertex depth is in codes of a buffer") {
    int beyond = 0, far_off = 0, drawn = 0;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d16f, DepthFormat::d32f}) {
        RasterState state = scene_state(61, 47);
        state.depth_format = format;
        const TriangleSoup soup = random_soup(902, 60, SoupKind::perspective);
        const Geometry scaled = set_up(soup, state, {.window_z = WindowZ::buffer_units}, 1);
        const Geometry unit = set_up(soup, state, {}, 1);
        REQUIRE(scaled.triangles.size() == unit.triangles.size());
        for (std::uint32_t i = 0; i < scaled.triangles.size(); ++i) {
            const float greatest = greatest_z(scaled, {&i, 1});
            if (greatest == -std::numeric_limits<float>::infinity()) continue;
            ++drawn;
            const double bound = depth_bound(scaled, {&i, 1});
            beyond += double{greatest} > bound ? 1 : 0;
            far_off += std::abs(bound - depth_bound(unit, {&i, 1})) > 0x1p-20 ? 1 : 0;
        }
    }
    CHECK(beyond == 0);
    CHECK(far_off == 0);
    CHECK(drawn > 100);
}

TEST_CASE(
    "a plane through unsnapped corners is bounded by as far as truncation or rounding moves a corner along its slope") {
    // z = x / 16 per pixel: a fragment is outside of its corners by at most the snap distance, which a bound includes.
    for (const Snap snap : {Snap::toward_zero, Snap::nearest_even})
        for (const int bits : {4, 8}) {
            const RasterRules rules{.subpixel_bits = bits, .snap = snap, .plane_origin = PlaneOrigin::unsnapped};
            SetupTriangle t = window_triangle({{{0, 0}, {8 << bits, 0}, {0, 8 << bits}}}, bits, {0.0, 0.5, 0.0});
            const Geometry geometry = window_geometry({t}, 16, 16, rules);
            const std::uint32_t only = 0;
            const double subpixel = 1.0 / (1 << bits), reach = snap == Snap::toward_zero ? subpixel : subpixel / 2;
            const double bound = depth_bound(geometry, {&only, 1});
            CHECK(bound >= 0.5 + reach / 16);
            CHECK(bound <= 0.5 + reach / 16 + 0x1p-19);
        }
}
