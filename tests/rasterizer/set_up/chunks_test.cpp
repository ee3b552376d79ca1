// Tests set-up in chunks against each triangle set up alone. Vertices and triangles are processed in chunks, and
// clipping adds vertices per chunk.
#include <catch2/catch.hpp>

#include "rasterizer/set_up/geometry.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

constexpr std::size_t chunked_stride = 3;

// Triangles with shared vertices, of which about half cross a clip plane; three extras per vertex.
[[nodiscard]] TriangleSoup chunked_soup(int triangles) {
    Random random{636};
    TriangleSoup soup;
    soup.extras.stride = chunked_stride;
    for (int i = 0; i < triangles; ++i) {
        soup.vertices.push_back(random_vertex(random, SoupKind::needs_clipping));
        for (std::size_t e = 0; e < chunked_stride; ++e) soup.extras.values.push_back(random_float(random, -9, 9));
        for (int k = 0; k < 3; ++k)
            soup.indices.push_back(static_cast<std::uint32_t>(random_int(random, std::max(0, i - 40), i)));
    }
    const auto third = static_cast<std::uint32_t>(triangles / 3 * 3), all = static_cast<std::uint32_t>(triangles * 3);
    soup.runs = {{0, third, 5, 0, true, false}, {third, all - third, 6, 1, false, true}};
    return soup;
}

// A soup with only triangle `number`.
[[nodiscard]] TriangleSoup only_triangle(const TriangleSoup& soup, std::uint32_t number) {
    TriangleSoup one;
    one.extras.stride = chunked_stride;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t v = soup.indices[3 * number + k];
        one.vertices.push_back(soup.vertices[v]);
        one.indices.push_back(k);
        one.extras.values.insert(one.extras.values.end(), soup.extras.of(v), soup.extras.of(v) + chunked_stride);
    }
    TriangleRun run = soup.runs[3 * number < soup.runs[0].index_count ? 0 : 1];
    run.first_index = 0, run.index_count = 3;
    one.runs = {run};
    return one;
}

[[nodiscard]] bool same_triangle(const Geometry& a, std::size_t i, const Geometry& b, std::size_t k) {
    const SetupTriangle s = a.triangle(i), t = b.triangle(k);
    bool same = s.p == t.p && s.unsnapped == t.unsnapped && s.z == t.z && s.inverse_w == t.inverse_w &&
                s.attribute == t.attribute && s.material == t.material && s.front_facing == t.front_facing;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t e = 0; e < chunked_stride; ++e)
            same = same && a.extras.of(a.triangles[i].vertex[c])[e] == b.extras.of(b.triangles[k].vertex[c])[e];
    return same;
}

}  // namespace

TEST_CASE("a soup of many triangles is set up like its triangles one by one including new corners and counts") {
    constexpr std::uint32_t count = 3000;  // in three chunks
    const TriangleSoup soup = chunked_soup(count);
    for (const bool offset : {false, true}) {
        RasterState state = scene_state(64, 64);
        state.polygon_offset = {offset, 1.5f, 3.0f};
        const Geometry all = set_up(soup, state, {.guard_band_px = 200}, 2);
        SetupCounters sum;
        std::size_t at = 0, wrong = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Geometry one = set_up(only_triangle(soup, i), state, {.guard_band_px = 200}, 1);
            sum.triangles_in += one.counters.triangles_in, sum.culled += one.counters.culled;
            sum.clipped += one.counters.clipped, sum.outside += one.counters.outside;
            sum.degenerate += one.counters.degenerate, sum.non_finite += one.counters.non_finite;
            for (std::size_t k = 0; k < one.triangles.size(); ++k, ++at) {
                if (at >= all.triangles.size()) break;
                wrong += same_triangle(all, at, one, k) && all.triangles[at].primitive == i ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
        CHECK(at == all.triangles.size());
        CHECK(all.counters == sum);
        CHECK(all.counters.clipped > 500);
        CHECK(all.vertices.size() > soup.vertices.size() + 500);
        CHECK(all.corners.size() == all.vertices.size());
        CHECK(all.extras.values.size() == chunked_stride * all.vertices.size());
        for (std::uint32_t i = 0; i < all.all_triangles.size(); ++i) wrong += all.all_triangles[i] != i ? 1 : 0;
        CHECK(wrong == 0);
    }
}

TEST_CASE("the first triangle that is not finite is the first in submission order whichever chunk finds it") {
    TriangleSoup soup = random_soup(637, 5000, SoupKind::flat);
    const auto spoil = [&](std::size_t triangle) {
        soup.vertices[3 * triangle].z = std::numeric_limits<float>::infinity();
    };
    spoil(4321);
    CHECK(set_up(soup, scene_state(32, 32), {}, 2).counters.first_non_finite == 4321);
    spoil(2500);
    spoil(2501);
    const SetupCounters counters = set_up(soup, scene_state(32, 32), {}, 2).counters;
    CHECK(counters.first_non_finite == 2500);
    CHECK(counters.non_finite == 3);
    CHECK(counters.triangles_in == 5000);
}
