// Tests set-up of sixteen triangles at once against one triangle after the other by the scalar reference, and against
// edge functions in 64 bits at every centre of a box.
#include "rasterizer/set_up/plain_triangles.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/dense.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] bool same_words(const TriangleRecord& a, const TriangleRecord& b) {
    return a.vertex == b.vertex && a.primitive == b.primitive && a.material == b.material && a.box.x0 == b.box.x0 &&
           a.box.y0 == b.box.y0 && a.box.x1 == b.box.x1 && a.box.y1 == b.box.y1 && a.front_facing == b.front_facing &&
           a.is_tiny == b.is_tiny && a.special == b.special && a.covered == b.covered;
}

// For either winding: the edge value is positive, or 0 on a side that includes its ties.
[[nodiscard]] bool covers_by_model(std::array<SubpixelPoint, 3> p, SubpixelPoint centre, TieRule rule) {
    const auto side = [](SubpixelPoint a, SubpixelPoint b, SubpixelPoint c) {
        return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
               (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
    };
    if (side(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
    const bool takes_left = rule == TieRule::top_left || rule == TieRule::bottom_left;
    const bool takes_top = rule == TieRule::top_left || rule == TieRule::top_right;
    for (std::size_t i = 0; i < 3; ++i) {
        const SubpixelPoint a = p[i], b = p[(i + 1) % 3];
        const bool takes = a.y != b.y ? (b.y < a.y) == takes_left : (b.x > a.x) == takes_top;
        const std::int64_t e = side(a, b, centre);
        if (e < 0 || (e == 0 && !takes)) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("sixteen plain triangles at once give the records and counts of one after the other on every instruction set",
          "[slow]") {
    std::uint64_t wrong = 0, tiny = 0, others = 0;
    for (const DenseCase& dense : dense_cases()) {
        const auto set_up_by = [&](strata::Simd simd) {
            const strata::SimdScope kernels{simd};
            return set_up(dense.soup, dense.state, dense.rules, 2);
        };
        const Geometry expected = set_up_by(strata::Simd::scalar);
        for (const TriangleRecord& t : expected.triangles) ++(t.is_tiny ? tiny : others);
        for (const strata::Simd simd : strata::available_simd()) {
            const Geometry found = set_up_by(simd);
            wrong += found.counters == expected.counters ? 0 : 1;
            wrong += std::ranges::equal(found.triangles, expected.triangles, same_words) ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(tiny > 10'000);
    CHECK(others > 1'000);
}

TEST_CASE("sixteen triangles of float spans at once give the records of one after the other on every set", "[slow]") {
    std::uint64_t wrong = 0, uncovered = 0, kept = 0;
    for (DenseCase dense : dense_cases()) {
        dense.rules.coverage = CoverageRule::float_spans;
        if (dense.rules.tie_rule == TieRule::top_left) dense.soup = dense_soup(731, 7);
        if (dense.state.cull == CullFace::none) move_to_half_pixels(dense.soup);
        const auto set_up_by = [&](strata::Simd simd) {
            const strata::SimdScope kernels{simd};
            return set_up(dense.soup, dense.state, dense.rules, 2);
        };
        const Geometry expected = set_up_by(strata::Simd::scalar);
        uncovered += expected.counters.uncovered, kept += expected.triangles.size();
        for (const strata::Simd simd : strata::available_simd()) {
            const Geometry found = set_up_by(simd);
            wrong += found.counters == expected.counters ? 0 : 1;
            wrong += std::ranges::equal(found.triangles, expected.triangles, same_words) ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(uncovered > 10'000);
    CHECK(kept > 10'000);
}

TEST_CASE(
    "float spans with a side of infinite slope are set up singly and those with an infinite 1 / area not at all") {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 3 * TriangleGroup::size; ++i) indices.push_back(i % 3);
    std::array<WindowCorner, 3> corners{};
    corners[0].unsnapped = {1, 0};
    corners[1].unsnapped = {9, 0x1p-140f};
    corners[2].unsnapped = {5, 7};
    std::array<TriangleRecord, TriangleGroup::size> records;
    for (const strata::Simd simd : strata::available_simd()) {
        const strata::SimdScope kernels{simd};
        const SetUpPlainTriangles set_up_group = set_up_plain_spans();
        if (set_up_group == nullptr) continue;
        PlainFates fates;
        const PlainTriangleRules rules{.group = {{0, 0, 20, 20}, 8, TieRule::top_left}};
        const auto is_set_up = [&] {
            return set_up_group(rules, indices.data(), 0, corners, nullptr, records.data(), fates);
        };
        CHECK_FALSE(is_set_up());
        CHECK(fates.kept == 0);
        corners[1].unsnapped[1] = 0.5f;
        CHECK(is_set_up());
        CHECK(fates.kept == TriangleGroup::size);
        corners[1].unsnapped[1] = 0x1p-140f;
        const std::array<WindowPosition, 3> dot{{{0, 0}, {0x1p-65f, 0x1p-66f}, {0, 0x1p-65f}}};  // 1 / area is infinite
        std::array<WindowCorner, 3> dots{};
        for (std::size_t i = 0; i < 3; ++i) dots[i].unsnapped = dot[i];
        CHECK_FALSE(FloatSpans{dot}.is_drawn());
        CHECK(set_up_group(rules, indices.data(), 0, dots, nullptr, records.data(), fates));
        CHECK(fates.degenerate == TriangleGroup::size);
    }
}

TEST_CASE("a run whose indices are borrowed is set up like one with the soup's indices on every instruction set",
          "[slow]") {
    std::uint64_t wrong = 0, triangles = 0;
    for (const DenseCase& dense : dense_cases()) {
        TriangleSoup lent = dense.soup;
        std::vector<std::uint32_t> indices(lent.indices.begin(), lent.indices.end());
        for (TriangleRun& run : lent.runs) {
            const std::span<std::uint32_t> own{&indices[run.first_index], run.index_count};
            run.first_vertex = *std::ranges::min_element(own);
            for (std::uint32_t& i : own) i -= run.first_vertex;
            run.lent = own.data();
        }
        lent.indices.clear();
        for (const strata::Simd simd : strata::available_simd()) {
            const strata::SimdScope kernels{simd};
            const Geometry expected = set_up(dense.soup, dense.state, dense.rules, 1),
                           found = set_up(lent, dense.state, dense.rules, 2);
            wrong += found.counters == expected.counters ? 0 : 1;
            wrong += std::ranges::equal(found.triangles, expected.triangles, same_words) ? 0 : 1;
            triangles += found.triangles.size();
        }
        wrong += lent.runs[1].first_vertex == 0 ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(triangles > 10'000);
}

TEST_CASE(
    "a tiny triangle's record has the pixels that it covers and one that covers none has no record and is counted",
    "[slow]") {
    std::uint64_t wrong = 0, covered = 0, empty = 0;
    for (const DenseCase& dense : dense_cases()) {
        if (dense.state.cull != CullFace::none) continue;  // only culling leaves a small triangle without a record
        const Geometry g = set_up(dense.soup, dense.state, dense.rules, 1);
        std::vector<const TriangleRecord*> record(dense.soup.indices.size() / 3);
        for (const TriangleRecord& t : g.triangles) record[t.primitive] = &t;
        std::uint64_t uncovered = 0;
        for (std::size_t i = 0; i < record.size(); ++i) {
            std::array<SubpixelPoint, 3> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = g.corners[dense.soup.indices[3 * i + k]].p;
            const Rect box = intersection(centre_box(p, g.rules.subpixel_bits), g.state.viewport);
            const bool is_small = std::max(box.width(), box.height()) <= tiny_size;  // no corners here are far apart
            if (box.area() == 0 || Edge{p[0], p[1]}.at(p[2]) == 0) continue;
            wrong += record[i] != nullptr && record[i]->is_tiny != is_small ? 1 : 0;
            if (!is_small) continue;
            std::uint32_t bits = 0;
            for (int y = box.y0; y < box.y1; ++y)
                for (int x = box.x0; x < box.x1; ++x)
                    if (covers_by_model(p, pixel_centre(x, y, g.rules.subpixel_bits), g.rules.tie_rule))
                        bits |= 1u << ((y - box.y0) * tiny_size + (x - box.x0));
            wrong += (record[i] != nullptr ? record[i]->covered : 0u) != bits ? 1 : 0;
            uncovered += bits == 0 ? 1 : 0;
            covered += bits != 0 ? 1 : 0;
        }
        wrong += g.counters.uncovered != uncovered ? 1 : 0;
        empty += uncovered;
    }
    CHECK(wrong == 0);
    CHECK(covered > 5'000);
    CHECK(empty > 1'000);
}

TEST_CASE("a thin triangle that extends far beyond the viewport is not tiny even if it has few pixels inside") {
    TriangleSoup soup;
    for (const auto& [x, y] : std::array<std::array<float, 2>, 3>{{{0.98f, -0.01f}, {90.0f, 0.0f}, {90.0f, 0.01f}}})
        soup.vertices.push_back({.x = x, .y = y});
    soup.indices = {0, 1, 2};
    soup.runs = {{0, 3, 0, 0, true, false}};
    RasterState state;
    state.viewport = {0, 0, 100, 100};
    const Geometry g = set_up(soup, state, {.subpixel_bits = 8}, 1);
    REQUIRE(g.triangles.size() == 1);
    CHECK(g.triangles[0].box.x1 - g.triangles[0].box.x0 <= tiny_size);
    CHECK_FALSE(g.triangles[0].is_tiny);
}
