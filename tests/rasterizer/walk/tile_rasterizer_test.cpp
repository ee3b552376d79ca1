// Tests that coverage and values depend only on the set-up triangle and the pixel.
#include "rasterizer/walk/tile_rasterizer.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "rasterizer/base/parallel.h"
#include "rasterizer/base/simd.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] std::vector<Device> devices() {
    const RasterRules geforce3_like{.subpixel_bits = 4,
                                    .snap = Snap::toward_zero,
                                    .z_clip = ZClip::per_fragment,
                                    .w_divide = WDivide::reciprocal,
                                    .window_z = WindowZ::buffer_units,
                                    .depth_path = DepthPath::window_z,
                                    .depth_rounding = DepthRounding::floor,
                                    .color = ColorInterpolation::weights_8bit};
    const RasterRules unsnapped{.plane_origin = PlaneOrigin::unsnapped};
    const RasterRules mesa_like{.clip = ClipVolume::view_volume,
                                .viewport = ViewportArithmetic::fused_given,
                                .plane_origin = PlaneOrigin::unsnapped,
                                .plane_rule = PlaneRule::reciprocal_area_fused};
    const RasterRules spans{.coverage = CoverageRule::float_spans,
                            .clip = ClipVolume::view_volume,
                            .plane_origin = PlaneOrigin::unsnapped,
                            .plane_rule = PlaneRule::least_corner};
    return {{{}, {DepthPath::float32, DepthFormat::d32f}},
            {{.subpixel_bits = 12}, {DepthPath::exact, DepthFormat::d24}},
            {unsnapped, {DepthPath::float32, DepthFormat::d24}},
            {geforce3_like, {DepthPath::window_z, DepthFormat::d24}},
            {mesa_like, {DepthPath::float32, DepthFormat::d32f}},
            {spans, {DepthPath::float32, DepthFormat::d32f}}};
}

[[nodiscard]] Geometry geometry_of(const TriangleSoup& soup, const Device& device, int width, int height,
                                   int threads = 1) {
    RasterState state = scene_state(width, height);
    state.depth_format = device.depth.format;
    return set_up(soup, state, device.rules, threads);
}

// All fragments tile by tile, on `threads` threads, sorted by pixel.
[[nodiscard]] std::vector<Fragment> tiled(Geometry geometry, const DepthRequest& depth, int tile_size, int threads) {
    bin_triangles(geometry, tile_size);
    std::vector<DrawResult> tiles(static_cast<std::size_t>(geometry.tiles_x) *
                                  static_cast<std::size_t>(geometry.tiles_y));
    strata::parallel_for(tiles.size(), threads, [&](std::size_t t) {
        tiles[t] = draw(geometry, depth, everything, tile_rect(geometry, t), geometry.bin(t));
    });
    std::vector<Fragment> all;
    for (const DrawResult& tile : tiles) {
        CHECK(tile.batches_are_sound);
        all.insert(all.end(), tile.fragments.begin(), tile.fragments.end());
    }
    return by_pixel(all);
}

struct Batches {
    std::vector<Fragment> fragments;
    std::vector<int> counts;
    friend bool operator==(const Batches&, const Batches&) = default;
};

[[nodiscard]] Batches batches_of(const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs,
                                 const Rect& region) {
    Batches batches;
    DrawResult result;
    TileRasterizer rasterizer{region};
    auto sink = [&](FragmentBatch& batch) {
        batches.counts.push_back(batch.count);
        append_batch(batch, region, needs, result);
    };
    rasterizer.draw(geometry, geometry.all_triangles, depth, needs, BatchSink{sink});
    batches.fragments = std::move(result.fragments);
    return batches;
}

}  // namespace

TEST_CASE("every instruction set gives batches bit-identical to those of the scalar reference", "[slow]") {
    std::vector<Device> all = devices();
    const RasterRules unsnapped{.tie_rule = TieRule::bottom_left, .plane_origin = PlaneOrigin::unsnapped};
    all.push_back({unsnapped, {DepthPath::float32, DepthFormat::d32f}});
    all.push_back({{.subpixel_bits = 12, .tie_rule = TieRule::bottom_right}, {DepthPath::float32, DepthFormat::d24}});
    all.push_back({{.subpixel_bits = 4}, {DepthPath::float32, DepthFormat::d16}});
    for (const PlaneRule plane :
         {PlaneRule::reciprocal_area, PlaneRule::reciprocal_area_fused, PlaneRule::least_corner}) {
        const RasterRules steps{.plane_origin = PlaneOrigin::unsnapped,
                                .plane_rule = plane,
                                .perspective = PerspectiveDivide::reciprocal,
                                .depth_rounding = DepthRounding::product_even};
        all.push_back({steps, {DepthPath::float32, DepthFormat::d24}});
    }
    constexpr std::array<std::array<int, 2>, 6> sizes{
        {{2, 200}, {4, 100}, {8, 100}, {30, 24}, {300, 16}, {32767, 16}}};  // pixels, triangles
    constexpr FragmentNeeds depth_only{false, true, false, false, false, false};
    constexpr FragmentNeeds no_exact_code{true, true, false, true, true, true};
    std::size_t wrong = 0, fragments = 0;
    for (const Device& device : all)
        for (const auto& [size, count] : sizes) {
            const Geometry geometry = random_triangles(128 + static_cast<std::uint64_t>(size), count, size, device);
            for (const FragmentNeeds& needs : {depth_only, no_exact_code, everything})
                for (const Rect& region : {Rect{0, 0, 70, 40}, Rect{5, 3, 37, 35}}) {
                    const strata::SimdScope scalar_kernels{strata::Simd::scalar};
                    const Batches scalar_reference = batches_of(geometry, device.depth, needs, region);
                    fragments += scalar_reference.fragments.size();
                    for (const strata::Simd simd : strata::available_simd()) {
                        const strata::SimdScope kernels{simd};
                        wrong += batches_of(geometry, device.depth, needs, region) != scalar_reference ? 1 : 0;
                    }
                }
        }
    CHECK(fragments > 100'000);
    CHECK(wrong == 0);
}

TEST_CASE("fragments are the same for every tile size and region and number of threads", "[slow]") {
    for (const SoupKind kind : {SoupKind::perspective, SoupKind::needs_clipping})
        for (const Device& device : devices()) {
            const TriangleSoup soup = random_soup(121, 120, kind);
            const Geometry geometry = geometry_of(soup, device, 150, 90);
            const DrawResult literal = draw(geometry, device.depth, everything);
            CHECK(literal.batches_are_sound);
            REQUIRE(literal.fragments.size() > 5000);
            const std::vector<Fragment> expected = by_pixel(literal.fragments);
            for (const int tile_size : {8, 16, 32, 64, 128})
                CHECK(tiled(geometry, device.depth, tile_size, tile_size == 16 ? 2 : 1) == expected);
            CHECK(tiled(geometry_of(soup, device, 150, 90, 4), device.depth, 32, 4) == expected);
            std::vector<Fragment> parts;  // a division that does not follow tiles
            for (const Rect part :
                 {Rect{0, 0, 1, 90}, Rect{1, 0, 150, 37}, Rect{1, 37, 63, 90}, Rect{63, 37, 150, 90}}) {
                const DrawResult result = draw(geometry, device.depth, everything, part, geometry.all_triangles);
                parts.insert(parts.end(), result.fragments.begin(), result.fragments.end());
            }
            CHECK(by_pixel(parts) == expected);
        }
}

TEST_CASE("the arrays that a pass uses do not depend on those that it omits") {
    const Device device = devices()[1];
    const Geometry geometry = geometry_of(random_soup(122, 60, SoupKind::perspective), device, 100, 70);
    const auto all = draw(geometry, device.depth, everything).fragments;
    for (const FragmentNeeds& needs :
         {FragmentNeeds{false, true, false, false, false, false}, FragmentNeeds{true, false, false, false, true, false},
          FragmentNeeds{false, false, true, true, false, true}}) {
        const auto some = draw(geometry, device.depth, needs).fragments;
        REQUIRE(some.size() == all.size());
        std::uint64_t wrong = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            Fragment expected = all[i];
            if (!needs.shader_z) expected.shader_z = 0;
            if (!needs.code) expected.code = 0;
            if (!needs.exact_code) expected.exact_code = 0;
            if (!needs.color) expected.color = {};
            if (!needs.texcoord) expected.texcoord = {};
            if (!needs.facing) expected.front_facing = false;
            wrong += some[i] != expected ? 1 : 0;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("rotating a triangle's vertices changes nothing except depth and colour on GeForce3", "[slow]") {
    // Without clipping, because a fan depends on its first corner.
    TriangleSoup soup = random_soup(123, 150, SoupKind::perspective);
    TriangleSoup rotated = soup;
    for (std::size_t i = 0; i < soup.indices.size(); i += 3) {
        rotated.indices[i] = soup.indices[i + 1];
        rotated.indices[i + 1] = soup.indices[i + 2];
        rotated.indices[i + 2] = soup.indices[i];
    }
    const auto devices_here = devices();
    for (const std::size_t d : {std::size_t{0}, std::size_t{1}}) {
        const Device& device = devices_here[d];
        CHECK(draw(geometry_of(soup, device, 90, 90), device.depth).fragments ==
              draw(geometry_of(rotated, device, 90, 90), device.depth).fragments);
    }
    const Device& geforce3_like = devices_here[3];
    const auto first = draw(geometry_of(soup, geforce3_like, 90, 90), geforce3_like.depth).fragments;
    const auto second = draw(geometry_of(rotated, geforce3_like, 90, 90), geforce3_like.depth).fragments;
    REQUIRE(first.size() == second.size());
    std::uint64_t moved = 0, other_depth = 0, other_color = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        moved += first[i].x != second[i].x || first[i].y != second[i].y ? 1 : 0;
        other_depth += first[i].code != second[i].code ? 1 : 0;
        other_color += first[i].color != second[i].color ? 1 : 0;
    }
    CHECK(moved == 0);
    CHECK(other_depth > 0);
    CHECK(other_color > 0);
}

TEST_CASE("fragments of a pixel come in submission order in batches of one material each") {
    const Device device = devices()[0];
    const Geometry geometry = geometry_of(random_soup(124, 400, SoupKind::perspective), device, 60, 60);
    TileRasterizer rasterizer{geometry.state.viewport};
    std::map<std::uint32_t, std::uint32_t> latest;
    std::uint64_t wrong = 0, batches = 0, materials = 0;
    std::uint32_t material = 0;
    auto sink = [&](FragmentBatch& batch) {
        ++batches;
        materials += batch.material != material ? 1 : 0;
        material = batch.material;
        wrong += batch.count < 1 || batch.count > batch_capacity ? 1 : 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            const auto [place, is_new] = latest.try_emplace(batch.pixel[i], batch.primitive[i]);
            wrong += !is_new && place->second >= batch.primitive[i] ? 1 : 0;
            place->second = batch.primitive[i];
            wrong += (batch.primitive[i] < 200) != (batch.material == 7) ? 1 : 0;
        }
    };
    rasterizer.draw(geometry, geometry.all_triangles, device.depth, everything, BatchSink{sink});
    CHECK(batches > 100);
    CHECK(materials == 2);
    CHECK(wrong == 0);
}

TEST_CASE("a rasterizer that is used again gives the same fragments") {
    const Device device = devices()[0];
    const Geometry geometry = geometry_of(random_soup(125, 50, SoupKind::perspective), device, 60, 60);
    TileRasterizer rasterizer{geometry.state.viewport};
    std::array<DrawResult, 2> results;
    for (DrawResult& result : results) {
        auto sink = [&](FragmentBatch& batch) { append_batch(batch, geometry.state.viewport, everything, result); };
        rasterizer.draw(geometry, geometry.all_triangles, device.depth, everything, BatchSink{sink});
    }
    CHECK(results[0].fragments == results[1].fragments);
}

TEST_CASE("the scissor keeps the fragments inside and changes nothing else") {
    const Device device = devices()[0];
    Geometry geometry = geometry_of(random_soup(126, 50, SoupKind::perspective), device, 60, 60);
    std::vector<Fragment> expected;
    for (const Fragment& f : draw(geometry, device.depth).fragments)
        if (f.x >= 11 && f.x < 40 && f.y >= 7 && f.y < 33) expected.push_back(f);
    geometry.state.scissor = Rect{11, 7, 40, 33};
    CHECK(by_pixel(draw(geometry, device.depth).fragments) == by_pixel(expected));
    geometry.state.scissor = Rect{-5, 59, 1000, 1000};
    CHECK(draw(geometry, device.depth).fragments.size() <= 60u * 50);
    geometry.state.scissor = Rect{30, 30, 30, 40};
    CHECK(draw(geometry, device.depth).fragments.empty());
}

TEST_CASE("two triangles with the same vertices have the same depth in every sample as EQUAL passes require") {
    for (const Device& device : devices()) {
        TriangleSoup soup = random_soup(127, 40, SoupKind::perspective);
        const auto once = soup.indices;
        soup.indices.insert(soup.indices.end(), once.begin(), once.end());
        soup.runs = {{0, static_cast<std::uint32_t>(soup.indices.size()), 0, 0, true, false}};
        std::map<std::array<int, 3>, std::uint32_t> code;
        std::uint64_t different = 0, pairs = 0;
        for (const Fragment& f : draw(geometry_of(soup, device, 64, 64), device.depth).fragments) {
            const auto [place, is_new] = code.try_emplace({f.x, f.y, static_cast<int>(f.primitive % 40)}, f.code);
            pairs += is_new ? 0 : 1;
            different += place->second != f.code ? 1 : 0;
        }
        CHECK(pairs > 1000);
        CHECK(different == 0);
    }
}
