// Tests fragments recorded from rows against the batches of the scalar reference, appended one after the other.
#include "pipeline/fragments/record_rows.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "rasterizer/base/simd.h"
#include "rasterizer/walk/rows.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "tests/rasterizer/scene.h"
#include "tests/support/skip.h"

// A separate namespace: models of several tests use the same short names, and a unity build joins their files.
namespace strata::testing::record_rows_model {
namespace {

using namespace rasterizer;
using pipeline::TileFragments;

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;

FragmentNeeds needs_of(bool code, bool shader_z, bool color) {
    return {
        .shader_z = shader_z, .code = code, .exact_code = false, .color = color, .texcoord = false, .facing = false};
}

std::uint64_t by_batches(TileFragments& to, const Geometry& geometry, const DepthRequest& depth, const Rect& region) {
    Lanes<std::uint32_t> all;
    all.fill(~0u);
    std::uint64_t fragments = 0;
    auto sink = [&](const FragmentBatch& batch) {
        to.append(batch, all);
        fragments += static_cast<std::uint64_t>(batch.count);
    };
    TileRasterizer{region}.draw(geometry, geometry.all_triangles, depth,
                                {.shader_z = true, .code = true, .color = true}, BatchSink{sink});
    return fragments;
}

template <class T>
bool equal_bits(std::span<const T> a, std::span<const T> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

bool equal(const TileFragments& a, const TileFragments& b) {
    const FragmentNeeds& held = a.needs();
    return a.serves(held) && b.serves(held) && equal_bits(a.pixel(), b.pixel()) &&
           equal_bits(a.primitive(), b.primitive()) && (!held.code || equal_bits(a.code(), b.code())) &&
           (!held.shader_z || equal_bits(a.shader_z(), b.shader_z())) &&
           (!held.color || equal_bits(a.color(), b.color()));
}

const RasterRules unsnapped{.tie_rule = TieRule::bottom_left, .plane_origin = PlaneOrigin::unsnapped};

}  // namespace

TEST_CASE("rows record the fragments of batches with their order and values for any set of recorded values") {
    const std::vector<Device> devices{{{}, {DepthPath::float32, DepthFormat::d32f}},
                                      {{.subpixel_bits = 4}, {DepthPath::float32, DepthFormat::d16}},
                                      {unsnapped, {DepthPath::float32, DepthFormat::d24}}};
    // triangle size in pixels, number of triangles
    constexpr std::array<std::array<int, 2>, 4> sizes{{{3, 150}, {8, 80}, {30, 24}, {300, 16}}};
    std::size_t wrong = 0, compared = 0;
    for (const Device& device : devices)
        for (const auto& [size, count] : sizes)
            for (const bool is_flat : {false, true})
                for (const Rect& region : {Rect{0, 0, 70, 40}, Rect{5, 3, 37, 35}, Rect{69, 0, 70, 40}}) {
                    Geometry geometry =
                        rasterizer::random_triangles(811 + static_cast<std::uint64_t>(size), count, size, device);
                    for (ClipVertex& v : geometry.vertices)
                        if (is_flat) v.front = v.back = {0.5f, 0.25f, 0.125f, 0.75f};
                    const FragmentNeeds needs = needs_of(size != 8, size != 3, size != 30);
                    TileFragments expected;
                    std::uint64_t fragments = 0;
                    {
                        const SimdScope reference{Simd::scalar};
                        expected.start(needs, plenty);
                        fragments = by_batches(expected, geometry, device.depth, region);
                        expected.finish();
                    }
                    for (const Simd simd : available_simd()) {
                        const SimdScope kernels{simd};
                        if (!row_walk_suits(geometry, device.depth, region)) continue;
                        TileFragments found;
                        found.start(needs, plenty);
                        wrong += record_rows(found, geometry, geometry.all_triangles, device.depth, region) == fragments
                                     ? 0
                                     : 1;
                        found.finish();
                        wrong += equal(found, expected) ? 0 : 1;
                        ++compared;
                    }
                }
    CHECK((compared > 0 || chosen_simd() < Simd::avx2));
    CHECK(wrong == 0);
}

TEST_CASE("a record that rows exceed is emptied and its memory does not grow further") {
    if (chosen_simd() < Simd::avx2) return strata::test::skip("no AVX2: rows are not recorded");
    const DepthRequest depth{DepthPath::float32, DepthFormat::d32f};
    const Geometry geometry = rasterizer::random_triangles(5, 400, 60, {{}, depth});
    const Rect region{0, 0, 70, 40};
    const FragmentNeeds needs = needs_of(true, true, true);
    TileFragments record;
    record.start(needs, plenty);
    const std::uint64_t fragments = record_rows(record, geometry, geometry.all_triangles, depth, region);
    record.finish();
    REQUIRE(record.bytes() == fragments * TileFragments::bytes_of(needs));
    for (const std::uint64_t spared : {std::uint64_t{0}, std::uint64_t{1}, record.bytes() / 2}) {
        TileFragments limited;
        limited.start(needs, fragments * TileFragments::bytes_of(needs) - spared);
        CHECK(record_rows(limited, geometry, geometry.all_triangles, depth, region) == fragments);
        limited.finish();
        CHECK(limited.serves(needs) == (spared == 0));
        CHECK(limited.size() == (spared == 0 ? fragments : 0));
    }
}

}  // namespace strata::testing::record_rows_model
