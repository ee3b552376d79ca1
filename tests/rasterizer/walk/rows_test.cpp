// Tests that a pass drawn by rows gives the result of fragments tested one after the other: the batches of the scalar
// reference and a plain loop over them.
#include "rasterizer/walk/rows.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/simd.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "tests/rasterizer/dense.h"

namespace {

using namespace strata::rasterizer;

struct Drawn {
    std::vector<std::uint32_t> codes;
    std::uint64_t fragments = 0, passed = 0;
    friend bool operator==(const Drawn&, const Drawn&) = default;
};

// Codes of every depth, and values after the last pixel that must not change.
[[nodiscard]] std::vector<std::uint32_t> stored_codes(const Rect& region, DepthFormat format) {
    Random random{97};
    std::vector<std::uint32_t> codes(region.area() + row_padding);
    for (std::uint32_t& code : codes)
        code = to_depth_code(random_float(random, 0.3f, 1.3f), format, DepthRounding::nearest);
    return codes;
}

[[nodiscard]] Drawn by_fragments(const Geometry& geometry, const DepthRequest& depth, const Rect& region) {
    Drawn drawn{stored_codes(region, depth.format)};
    auto sink = [&](const FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            ++drawn.fragments;
            if (batch.code[i] >= drawn.codes[batch.pixel[i]]) continue;
            drawn.codes[batch.pixel[i]] = batch.code[i];
            ++drawn.passed;
        }
    };
    TileRasterizer rasterizer{region};
    rasterizer.draw(geometry, geometry.all_triangles, depth, {.shader_z = false, .code = true, .color = false},
                    BatchSink{sink});
    return drawn;
}

[[nodiscard]] Drawn by_rows(const Geometry& geometry, const DepthRequest& depth, const Rect& region) {
    Drawn drawn{stored_codes(region, depth.format)};
    const auto [fragments, passed] =
        draw_depth_rows(geometry, geometry.all_triangles, depth, region, drawn.codes.data());
    drawn.fragments = fragments;
    drawn.passed = passed;
    return drawn;
}

// Every fifth plane is between two neighbouring floats, so that many of its values are ties or close to one.
void add_ties(Geometry& geometry) {
    for (std::size_t i = 0; i < geometry.triangles.size(); i += 5)
        for (std::size_t k = 0; k < 3; ++k)
            geometry.corners[geometry.triangles[i].vertex[k]].z = k == 0 ? 0.5f : 0.5f + 0x1p-24f;
}

}  // namespace

TEST_CASE("rows of depth give the codes and the counts of fragments tested one after the other") {
    const RasterRules unsnapped{.tie_rule = TieRule::bottom_left, .plane_origin = PlaneOrigin::unsnapped};
    const std::vector<Device> devices{{{}, {DepthPath::float32, DepthFormat::d32f}},
                                      {{.subpixel_bits = 4}, {DepthPath::float32, DepthFormat::d16}},
                                      {{.tie_rule = TieRule::top_right}, {DepthPath::float32, DepthFormat::d24}},
                                      {unsnapped, {DepthPath::float32, DepthFormat::d24}},
                                      {unsnapped, {DepthPath::float32, DepthFormat::d32f}}};
    constexpr std::array<std::array<int, 2>, 6> sizes{
        {{2, 200}, {4, 200}, {8, 100}, {30, 24}, {300, 16}, {32767, 16}}};  // pixels, triangles
    std::size_t wrong = 0, compared = 0;
    for (const Device& device : devices)
        for (const auto& [size, count] : sizes) {
            Geometry geometry = random_triangles(517 + static_cast<std::uint64_t>(size), count, size, device);
            add_ties(geometry);
            for (const Rect& region : {Rect{0, 0, 70, 40}, Rect{5, 3, 37, 35}, Rect{69, 0, 70, 40}}) {
                const strata::SimdScope scalar_reference{strata::Simd::scalar};
                CHECK_FALSE(row_walk_suits(geometry, device.depth, region));
                const Drawn expected = by_fragments(geometry, device.depth, region);
                for (const strata::Simd simd : strata::available_simd()) {
                    const strata::SimdScope kernels{simd};
                    CHECK(row_walk_suits(geometry, device.depth, region) == (simd >= strata::Simd::avx2));
                    if (simd < strata::Simd::avx2) continue;  // rows are not even compiled
                    wrong += by_rows(geometry, device.depth, region) != expected ? 1 : 0;
                    compared += expected.fragments;
                }
            }
        }
    CHECK((compared > 100'000 || strata::available_simd().back() < strata::Simd::avx2));
    CHECK(wrong == 0);
}

TEST_CASE("tiny triangles side by side give the result of one after the other within regions and scissors", "[slow]") {
    std::size_t wrong = 0, compared = 0;
    for (const DenseCase& dense : dense_cases()) {
        Geometry geometry = set_up(dense.soup, dense.state, dense.rules, 1);
        // At some vertices, depths of which 3/4 and 5/8 are half way between two neighbouring binary32.
        for (std::size_t v = 0; v < geometry.corners.size(); ++v)
            if (v / 64 % 3 == 0) geometry.corners[v].z = v % 3 == 0 ? 0.0f : 6'000'001 * 0x1p-23f;
        for (const DepthFormat format : {DepthFormat::d24, DepthFormat::d32f})
            // The last ones are outside of the scissor.
            for (const Rect& part :
                 {Rect{0, 0, 70, 40}, Rect{5, 3, 37, 35}, Rect{61, 0, 70, 40}, Rect{0, 34, 70, 40}}) {
                const Rect region = intersection(part, geometry.state.viewport);
                const DepthRequest depth{DepthPath::float32, format};
                const strata::SimdScope scalar_reference{strata::Simd::scalar};
                const Drawn expected = by_fragments(geometry, depth, region);
                for (const strata::Simd simd : strata::available_simd()) {
                    const strata::SimdScope kernels{simd};
                    if (!row_walk_suits(geometry, depth, region)) continue;
                    wrong += by_rows(geometry, depth, region) != expected ? 1 : 0;
                    compared += expected.fragments;
                }
            }
    }
    CHECK((compared > 100'000 || strata::available_simd().back() < strata::Simd::avx2));
    CHECK(wrong == 0);
}

TEST_CASE("rows are not drawn where batches support what rows do not") {
    const Device plain{{}, {DepthPath::float32, DepthFormat::d32f}};
    const Geometry geometry = random_triangles(5, 10, 8, plain);
    const Rect region{0, 0, 70, 40};
    const auto suits = [&](const auto& change) {
        Geometry changed = geometry;
        DepthRequest depth = plain.depth;
        Rect rect = region;
        change(changed, depth, rect);
        return row_walk_suits(changed, depth, rect);
    };
    CHECK(suits([](auto&, auto&, auto&) {}) == (strata::chosen_simd() >= strata::Simd::avx2));
    // an edge function may exceed 64 bits
    CHECK_FALSE(suits([](Geometry& g, auto&, auto&) { g.rules.subpixel_bits = 12; }));
    CHECK_FALSE(suits([](Geometry& g, auto&, auto&) { g.rules.z_clip = ZClip::per_fragment; }));
    CHECK_FALSE(suits([](auto&, DepthRequest& d, auto&) { d.path = DepthPath::exact; }));
    CHECK_FALSE(suits([](auto&, auto&, Rect& r) { r.x1 = max_row_pixels + 1; }));
}
