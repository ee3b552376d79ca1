// Tests when rows may replace batches, at the limits, and that their results are equal there, against the scalar
// reference's batches and a plain loop.
#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/base/simd.h"
#include "rasterizer/walk/rows.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

constexpr std::uint32_t untouched = 0xdeadbeef;

// Codes after LESS, fragment by fragment, over a buffer of `clear`.
[[nodiscard]] std::vector<std::uint32_t> tested_one_by_one(const Geometry& g, const DepthRequest& depth,
                                                           const Rect& region, std::uint32_t clear, DepthDrawn& drawn) {
    std::vector<std::uint32_t> codes(region.area(), clear);
    constexpr FragmentNeeds code_only{false, true, false, false, false, false};
    for (const Fragment& f : draw(g, depth, code_only, region, g.all_triangles).fragments) {
        std::uint32_t& stored = codes[static_cast<std::size_t>((f.y - region.y0) * region.width() + f.x - region.x0)];
        ++drawn.fragments;
        if (f.code >= stored) continue;
        stored = f.code;
        ++drawn.passed;
    }
    codes.resize(codes.size() + row_padding, untouched);
    return codes;
}

}  // namespace

TEST_CASE("rows support every device setting that removes no fragment and a region of 128 pixels but not of 129") {
    const bool has_rows = strata::chosen_simd() >= strata::Simd::avx2;
    Geometry g = random_triangles(671, 4, 8, {{}, {}});
    const DepthRequest plain{};
    const auto suits = [&] { return row_walk_suits(g, plain, {3, 0, 3 + 128, 40}); };
    CHECK(suits() == has_rows);
    CHECK_FALSE(row_walk_suits(g, plain, {3, 0, 3 + 129, 40}));
    CHECK(row_walk_suits(g, plain, {0, 0, 1, 16384}) == has_rows);
    g.rules.z_clip = ZClip::per_fragment;
    CHECK_FALSE(suits());
    g.state.depth_clamp = true;  // then no fragment is clipped
    CHECK(suits() == has_rows);
    for (const int subpixel_bits : {4, 8}) {
        g.rules.subpixel_bits = subpixel_bits;
        CHECK(suits() == has_rows);
    }
    for (const DepthPath path : {DepthPath::window_z, DepthPath::perspective_rq, DepthPath::depth_replace,
                                 DepthPath::float32_plane, DepthPath::exact})
        CHECK_FALSE(row_walk_suits(g, {path, DepthFormat::d32f}, {0, 0, 8, 8}));
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        CHECK(row_walk_suits(g, {DepthPath::float32, format}, {0, 0, 8, 8}) == has_rows);
    for (const DepthFormat format : {DepthFormat::d16f, DepthFormat::d24f})  // no vector conversion
        CHECK_FALSE(row_walk_suits(g, {DepthPath::float32, format}, {0, 0, 8, 8}));
    g.rules.depth_rounding = DepthRounding::product_even;
    CHECK(row_walk_suits(g, {DepthPath::float32, DepthFormat::d32f}, {0, 0, 8, 8}) == has_rows);
    CHECK_FALSE(row_walk_suits(g, {DepthPath::float32, DepthFormat::d24}, {0, 0, 8, 8}));
}

TEST_CASE("rows are drawn only by vector instruction sets and the scalar reference uses batches") {
    const Geometry g = random_triangles(672, 4, 8, {{}, {}});
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope scope{simd};
        const bool expected = simd == strata::Simd::avx2 || simd == strata::Simd::avx512;
        CHECK(row_walk_suits(g, {}, {0, 0, 64, 40}) == expected);
    }
}

TEST_CASE("the widest region's rows give the result of its fragments for every format and rule", "[slow]") {
    std::uint64_t wrong = 0, passed = 0;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        for (const TieRule tie : {TieRule::top_left, TieRule::bottom_left, TieRule::top_right, TieRule::bottom_right})
            for (const bool floors : {false, true})
                for (const PlaneOrigin origin : {PlaneOrigin::snapped, PlaneOrigin::unsnapped}) {
                    RasterRules rules{.tie_rule = tie, .plane_origin = origin};
                    rules.depth_rounding = floors ? DepthRounding::floor : DepthRounding::nearest;
                    const Device device{rules, {DepthPath::float32, format}};
                    Geometry g = random_triangles(673, 60, 40, device);
                    g.state.viewport = {0, 0, 140, 40};
                    g.state.depth_near = floors ? 0.75f : 0.125f, g.state.depth_far = floors ? 0.25f : 0.875f;
                    g.state.scissor = Rect{4, 1, 130, 39};
                    const Rect region{2, 0, 130, 40};
                    if (!row_walk_suits(g, device.depth, region)) continue;
                    DepthDrawn expected, found;
                    const auto model = tested_one_by_one(g, device.depth, region, max_code(format), expected);
                    std::vector<std::uint32_t> codes(region.area(), max_code(format));
                    codes.resize(codes.size() + row_padding, untouched);
                    found = draw_depth_rows(g, g.all_triangles, device.depth, region, codes.data());
                    wrong += codes != model || found.fragments != expected.fragments || found.passed != expected.passed
                                 ? 1
                                 : 0;
                    passed += found.passed;
                }
    CHECK(wrong == 0);
    CHECK((passed > 10000 || strata::chosen_simd() < strata::Simd::avx2));
}
