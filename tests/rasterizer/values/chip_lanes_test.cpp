// Tests the SIMD kernels of the chip's interpolators against the scalar set, which runs their definitions;
// window_z_test, color_weights_test and truncated_coordinates_test test the definitions against rationals and captures.
#include "rasterizer/values/chip_lanes.h"

#include <bit>
#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/chip_scene.h"

namespace {

using namespace strata::rasterizer;

// All values of a batch of chip fragments, as bits.
[[nodiscard]] std::vector<std::uint32_t> words_of_batches(const Geometry& g, const DepthRequest& depth,
                                                          const FragmentNeeds& needs) {
    std::vector<std::uint32_t> words;
    auto sink = [&](const FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            words.insert(words.end(), {batch.pixel[i], batch.primitive[i]});
            if (needs.code) words.push_back(batch.code[i]);
            if (needs.shader_z) words.push_back(std::bit_cast<std::uint32_t>(batch.shader_z[i]));
            if (needs.reference) words.push_back(batch.reference_code[i]);
            for (std::size_t c = 0; needs.color && c < 4; ++c)
                words.push_back(std::bit_cast<std::uint32_t>(batch.color[c][i]));
            for (std::size_t c = 0; needs.texcoord && c < 2; ++c)
                words.push_back(std::bit_cast<std::uint32_t>(batch.texcoord[c][i]));
            for (std::size_t k = 0; k < 16; ++k)
                if (names(needs.units, k / 4, k % 4))
                    words.push_back(std::bit_cast<std::uint32_t>(batch.unit[k / 4][k % 4][i]));
        }
    };
    TileRasterizer rasterizer{g.state.viewport};
    rasterizer.draw(g, g.all_triangles, depth, needs, BatchSink{sink});
    return words;
}

// r, q and sixteen coordinates per vertex: ordinary ones, equal ones, zeros of both signs, tiny, huge and infinite
// ones.
void add_units(Geometry& g, std::uint64_t seed) {
    Random random{seed};
    g.extras = {.stride = 18, .has_rq = true, .has_units = true, .values = {}};
    constexpr std::array special{0.0f, -0.0f, 1.0f, 0x1p-149f, -0x1p-120f, 0x1p-101f, 0x1p99f, -0x1.fffffep127f};
    for (std::size_t v = 0; v < g.vertices.size(); ++v)
        for (std::size_t k = 0; k < 18; ++k) {
            const std::size_t kind = k < 2 ? 0 : (v / 3 + k) % 8;
            const float common = random_float(random, 0.25f, 4.0f);
            const auto pick = static_cast<std::size_t>(random_int(random, 0, 7));
            const float infinite = pick == 0 ? std::numeric_limits<float>::infinity() : common;
            g.extras.values.push_back(kind < 4    ? common - (kind == 1 ? 2.0f : 0.0f)
                                      : kind < 6  ? special[pick]
                                      : kind == 6 ? special[v / 3 % 8]
                                                  : infinite);
        }
}

// Number of instruction sets on which some value differs from the scalar one.
[[nodiscard]] int differing_draws(const Geometry& g, const DepthRequest& depth, const FragmentNeeds& needs,
                                  std::uint64_t& compared) {
    std::vector<std::uint32_t> expected;
    {
        const strata::SimdScope scalar_reference{strata::Simd::scalar};
        CHECK(chip_kernels() == nullptr);
        expected = words_of_batches(g, depth, needs);
    }
    int wrong = 0;
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope scope{simd};
        wrong += words_of_batches(g, depth, needs) == expected ? 0 : 1;
        compared += expected.size();
    }
    return wrong;
}

constexpr FragmentNeeds chip_needs{false, true, false, true, true, false, false, 0xffff};

}  // namespace

TEST_CASE("all values of the chip's kernels are bit-identical to its definitions on every instruction set", "[slow]") {
    std::uint64_t compared = 0;
    int wrong = 0;
    constexpr std::array<std::array<int, 2>, 4> triangles{{{3, 120}, {9, 60}, {40, 30}, {20000, 18}}};
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d16f, DepthFormat::d24f})
        for (const int subpixel_bits : {4, 8, 12})
            for (const auto& [size, count] : triangles) {
                RasterRules rules = chip_rules();
                rules.subpixel_bits = subpixel_bits;
                const Device device{rules, {DepthPath::window_z, format}};
                Geometry g = chip_triangles(71 + static_cast<std::uint64_t>(size), count, size, device);
                add_units(g, 9);
                g.state.depth_clamp = subpixel_bits == 8;
                if (subpixel_bits == 4) g.state.polygon_offset = {true, -0.5f, 2.0f};
                wrong += differing_draws(g, device.depth, chip_needs, compared);
                FragmentNeeds more = chip_needs;
                more.shader_z = true;
                more.reference = subpixel_bits == 8;
                const DepthRequest quotient{DepthPath::window_z, format, DepthPath::perspective_rq};
                wrong += differing_draws(g, more.reference ? quotient : device.depth, more, compared);
            }
    CHECK(wrong == 0);
    CHECK(compared > 5'000'000);
}

TEST_CASE("weights and products and planes that the chip's kernels do not support are computed by the definitions",
          "[slow]") {
    std::uint64_t compared = 0;
    int wrong = 0;
    for (const int kind : {0, 1, 2, 3, 4}) {
        RasterRules rules = chip_rules();
        if (kind == 0) rules.hypothesis.weights = WeightRule::area;
        if (kind == 1) rules.interpolation.perspective_color = PerspectiveColor::edge_products;
        if (kind == 2) rules.interpolation.perspective_color = PerspectiveColor::weight_products;
        if (kind == 3) rules.interpolation.perspective_coordinates = PerspectiveCoordinates::exact_plane;
        if (kind == 4) rules.plane_origin = PlaneOrigin::unsnapped;
        const Device device{rules, {DepthPath::window_z, DepthFormat::d24}};
        for (const int size : {5, 500}) {
            Geometry g = chip_triangles(17, 60, size, device);
            add_units(g, 10);
            wrong += differing_draws(g, device.depth, chip_needs, compared);
        }
    }
    CHECK(wrong == 0);
    CHECK(compared > 500'000);
}

TEST_CASE("corners are narrow exactly where every product of a weight and a difference is exact in binary64") {
    const auto is_narrow = [](double a, double b, double c) {
        return NarrowWindowZ{WindowZCorners{{a, b, c}, 0.0}, {}}.is_narrow;
    };
    CHECK(is_narrow(1.0, 1.0 + 0x1p-23, 2.0));
    CHECK(is_narrow(0x1p28, 1.0, 0x1p28));          // 2^28 - 1 has 28 bits
    CHECK(is_narrow(0x1p29, 1.0, 0x1p29));          // 2^29 - 1 has 29
    CHECK_FALSE(is_narrow(0x1p30, 1.0, 0x1p30));    // 2^30 - 1 has 30
    CHECK_FALSE(is_narrow(0x1p30, 0x1p30, 1.0));    // for any order of corners
    CHECK_FALSE(is_narrow(0x1p100, 0x1p-20, 0.0));  // binary64 cannot represent the difference
    CHECK(is_narrow(0x1p100, 0x1p-140, 0x1p100));   // values below the least depth count as 0
}
