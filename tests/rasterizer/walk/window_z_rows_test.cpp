// Tests that rows of the chip's window z give the result of fragments tested one after the other: the batches of the
// scalar set, which run the code of WindowZ24, and a plain loop over them; window_z_test tests that code against
// rationals.
#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/base/simd.h"
#include "rasterizer/walk/rows.h"
#include "tests/rasterizer/chip_scene.h"
#include "tests/rasterizer/dense.h"

namespace {

using namespace strata::rasterizer;

struct ChipCodes {
    std::vector<std::uint32_t> codes;
    std::uint64_t fragments = 0, passed = 0;
    friend bool operator==(const ChipCodes&, const ChipCodes&) = default;
};

// Codes all over the format's range; those after the last pixel must not change.
[[nodiscard]] std::vector<std::uint32_t> any_codes(const Rect& region, DepthFormat format) {
    Random random{31};
    std::vector<std::uint32_t> codes(region.area() + row_padding);
    for (std::uint32_t& code : codes)
        code = static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(max_code(format)) + 1));
    return codes;
}

[[nodiscard]] ChipCodes tested_in_turn(const Geometry& g, const DepthRequest& depth, const Rect& region) {
    const strata::SimdScope scalar_reference{strata::Simd::scalar};
    ChipCodes found{any_codes(region, depth.format)};
    constexpr FragmentNeeds code_alone{false, true, false, false, false, false};
    for (const Fragment& f : draw(g, depth, code_alone, region, g.all_triangles).fragments) {
        std::uint32_t& stored =
            found.codes[static_cast<std::size_t>((f.y - region.y0) * region.width() + f.x - region.x0)];
        ++found.fragments;
        if (f.code >= stored) continue;
        stored = f.code;
        ++found.passed;
    }
    return found;
}

[[nodiscard]] ChipCodes drawn_as_rows(const Geometry& g, const DepthRequest& depth, const Rect& region) {
    ChipCodes found{any_codes(region, depth.format)};
    const DepthDrawn rows = draw_depth_rows(g, g.all_triangles, depth, region, found.codes.data());
    found.fragments = rows.fragments;
    found.passed = rows.passed;
    return found;
}

// Number of differences between rows and fragments, over the instruction sets that draw rows; `passed` sums the
// compared fragments.
[[nodiscard]] int differences(const Geometry& g, const DepthRequest& depth, const Rect& region, std::uint64_t& passed) {
    const ChipCodes expected = tested_in_turn(g, depth, region);
    int wrong = 0;
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope scope{simd};
        if (!depth_rows_suit(g, depth, region)) continue;
        wrong += drawn_as_rows(g, depth, region) == expected ? 0 : 1;
        passed += expected.passed;
    }
    return wrong;
}

[[nodiscard]] bool has_rows_here() { return strata::available_simd().back() >= strata::Simd::avx2; }

constexpr std::size_t large_every = 23;
// Cells of 45 pixels between the others: the edge values of their triangles have more than 24 bits.
void enlarge_some(TriangleSoup& soup) {
    for (std::size_t v = 0; v + 4 <= soup.vertices.size(); v += 4 * large_every) {
        soup.vertices[v + 1].x += 45 / 35.0f * soup.vertices[v + 1].w;
        soup.vertices[v + 2].y -= 45 / 20.0f * soup.vertices[v + 2].w;
    }
}

constexpr std::array<std::array<int, 2>, 6> sizes{{{2, 180}, {4, 180}, {8, 90}, {30, 36}, {300, 18}, {32767, 18}}};

}  // namespace

TEST_CASE("rows of the chip's window z give the codes and counts of fragments in every format and size and state",
          "[slow]") {
    std::uint64_t passed = 0;
    int wrong = 0;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d16f, DepthFormat::d24f})
        for (const int subpixel_bits : {4, 8})
            for (int state = 0; state < 4; ++state) {
                RasterRules rules = chip_rules();
                rules.subpixel_bits = subpixel_bits;
                rules.plane_origin = state == 1 ? PlaneOrigin::unsnapped : PlaneOrigin::snapped;
                const Device device{rules, {DepthPath::window_z, format}};
                for (const auto& [size, count] : sizes) {
                    Geometry g = chip_triangles(11 + static_cast<std::uint64_t>(size), count, size, device);
                    g.state.depth_clamp = state == 1;
                    if (state == 2) g.state.depth_near = 0.8f, g.state.depth_far = 0.3f;
                    if (state == 3) g.state.polygon_offset = {true, 1.5f, -3.0f};
                    for (const Rect& region : {Rect{0, 0, 70, 40}, Rect{5, 3, 37, 35}})
                        wrong += differences(g, device.depth, region, passed);
                }
            }
    CHECK(wrong == 0);
    CAPTURE(passed);  // by each instruction set that draws rows, of which a build may have fewer
    CHECK((passed > 100'000 || !has_rows_here()));
}

TEST_CASE("tiny triangles side by side have the chip's window z of each and its range in every format", "[slow]") {
    std::uint64_t passed = 0;
    int wrong = 0;
    for (DenseCase dense : dense_cases()) {
        if (dense.state.cull == CullFace::back)
            enlarge_some(dense.soup);
        else
            move_to_half_pixels(dense.soup);
        RasterRules rules = chip_rules();
        rules.subpixel_bits = dense.rules.subpixel_bits;
        rules.tie_rule = dense.rules.tie_rule;
        rules.plane_origin = dense.rules.plane_origin;
        if (dense.state.cull == CullFace::none)
            rules.hypothesis.sum_bits = 25, rules.hypothesis.reciprocal_bits = 26,
            rules.hypothesis.reciprocal_deficit = 8;
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d16f, DepthFormat::d24f}) {
            Geometry g = set_up(dense.soup, dense.state, rules, 1);
            g.state.depth_format = format;
            if (dense.state.cull == CullFace::front) g.state.depth_near = 0.2f, g.state.depth_far = 0.9f;
            g.state.depth_clamp = dense.state.cull == CullFace::back;
            // Cells of four corners; some groups have triangles of one kind, some a single one among others.
            Random random{61};
            for (std::size_t v = 0; v + 4 <= g.corners.size(); v += 4) {
                const std::size_t span = v / 400 % 15;
                const bool is_plain = v / 4 % large_every == 0 || (span >= 8 && v / 4 % 29 != 0);
                const auto z = chip_depths(random, format, static_cast<int>(is_plain ? 8 : span % 8));
                for (std::size_t k = 0; k < 4; ++k) g.corners[v + k].z = static_cast<float>(z[k % 3]);
            }
            for (const Rect& part : {Rect{0, 0, 70, 40}, Rect{5, 3, 37, 35}, Rect{20, 11, 27, 18}})
                wrong += differences(g, {DepthPath::window_z, format}, intersection(part, g.state.viewport), passed);
        }
    }
    CHECK(wrong == 0);
    CHECK((passed > 100'000 || !has_rows_here()));
}

TEST_CASE("rows of the chip's window z follow every width of its reciprocal and its sum", "[slow]") {
    std::uint64_t passed = 0;
    int wrong = 0;
    for (int reciprocal_bits = 24; reciprocal_bits <= 30; reciprocal_bits += 2)
        for (int sum_bits = 24; sum_bits <= 29; ++sum_bits)
            for (const int deficit : {0, 3, 8}) {
                RasterRules rules = chip_rules();
                rules.hypothesis.reciprocal_bits = reciprocal_bits;
                rules.hypothesis.sum_bits = sum_bits;
                rules.hypothesis.reciprocal_deficit = deficit;
                const Device device{rules, {DepthPath::window_z, DepthFormat::d24}};
                for (const int size : {6, 400})
                    wrong += differences(chip_triangles(5, 30, size, device), device.depth, {0, 0, 70, 40}, passed);
            }
    CHECK(wrong == 0);
    CHECK((passed > 100'000 || !has_rows_here()));
}

TEST_CASE("rows support only the chip's window z and no other rule for it or weights by the area or window positions") {
    const Device device{chip_rules(), {DepthPath::window_z, DepthFormat::d24}};
    const Geometry geometry = chip_triangles(3, 10, 8, device);
    const auto suits = [&](const auto& change) {
        Geometry changed = geometry;
        change(changed);
        return depth_rows_suit(changed, device.depth, {0, 0, 70, 40});
    };
    CHECK(suits([](Geometry&) {}) == (strata::chosen_simd() >= strata::Simd::avx2));
    CHECK_FALSE(suits([](Geometry& g) { g.rules.hypothesis.window_z = WindowZRule::exact; }));
    CHECK_FALSE(suits([](Geometry& g) { g.rules.hypothesis.weights = WeightRule::area; }));
    CHECK_FALSE(suits([](Geometry& g) { g.state.window_positions = true; }));
    CHECK_FALSE(suits([](Geometry& g) { g.rules.subpixel_bits = 12; }));
    CHECK_FALSE(row_walk_suits(geometry, device.depth, {0, 0, 70, 40}));  // sums and recorded fragments require float32
}
