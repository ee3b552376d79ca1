// Model: the fragments themselves: none of random triangles lies beyond the bound of its triangle, and some come close.
#include "rasterizer/set_up/depth_bound.h"

#include <catch2/catch.hpp>
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

}  // namespace

TEST_CASE("no fragment lies behind the depth bound of its triangle, and the bound is seldom far behind the fragments") {
    int beyond = 0, close = 0, drawn = 0;
    for (const SoupKind kind : {SoupKind::flat, SoupKind::perspective, SoupKind::needs_clipping})
        for (const PlaneOrigin origin : {PlaneOrigin::snapped, PlaneOrigin::unsnapped})
            for (const Snap snap : {Snap::nearest_even, Snap::toward_zero})
                for (const int bits : {4, 8}) {
                    const RasterRules rules{.subpixel_bits = bits, .snap = snap, .plane_origin = origin};
                    RasterState state = scene_state(61, 47);
                    state.polygon_offset = {kind == SoupKind::flat, 1.5f, 20.0f};
                    const Geometry geometry = set_up(random_soup(900, 80, kind), state, rules, 1);
                    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
                        const float greatest = greatest_z(geometry, {&i, 1});
                        const double bound = depth_bound(geometry, {&i, 1});
                        if (greatest == -std::numeric_limits<float>::infinity()) continue;
                        ++drawn;
                        beyond += double{greatest} > bound ? 1 : 0;
                        close += bound - double{greatest} < 0.1 ? 1 : 0;
                    }
                }
    CHECK(beyond == 0);
    CHECK(drawn > 1000);
    CHECK(close > drawn / 2);
}

TEST_CASE("the bound of several triangles is the greatest of theirs, and of none it is below every depth") {
    const Geometry geometry = set_up(random_soup(901, 20, SoupKind::perspective), scene_state(40, 40), {}, 1);
    double greatest = -std::numeric_limits<double>::infinity();
    CHECK(depth_bound(geometry, {}) == greatest);
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i)
        greatest = std::max(greatest, depth_bound(geometry, {&i, 1}));
    CHECK(depth_bound(geometry, geometry.all_triangles) >= greatest - 0x1p-18);
    CHECK(depth_bound(geometry, geometry.all_triangles) <= greatest + 0x1p-18);
}
