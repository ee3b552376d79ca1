// Tests texture units at fragments against the rational plane: u (1/w) rounded, plane rounded, quotient rounded.
#include <catch2/catch.hpp>
#include <cmath>

#include "rasterizer/values/depth_paths.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

using namespace strata::rasterizer;

namespace {

constexpr std::size_t stride = 4 * texture_units;

// Triangles inside a viewport of 32 x 32 with any w and coordinates; unit 3's q is constant.
TriangleSoup soup_of(Random& random, int triangles, bool has_rq) {
    TriangleSoup soup;
    soup.extras = {.stride = stride + (has_rq ? 2 : 0), .has_rq = has_rq, .has_units = true, .values = {}};
    for (int i = 0; i < 3 * triangles; ++i) {
        const float w = random_float(random, 0.5f, 4.0f);
        soup.vertices.push_back(
            {.x = random_float(random, -1, 1) * w, .y = random_float(random, -1, 1) * w, .z = 0, .w = w});
        soup.indices.push_back(static_cast<std::uint32_t>(i));
        for (std::size_t e = 0; e < soup.extras.stride; ++e)
            soup.extras.values.push_back(random_float(random, -100, 100));
        soup.extras.values.back() = 2.5f;
    }
    soup.runs.push_back({.index_count = static_cast<std::uint32_t>(soup.indices.size())});
    return soup;
}

// Expected u at a pixel of a triangle: edge weights in integers, then the three roundings.
float expected(const Geometry& g, const TriangleRecord& t, const std::array<float, 3>& u, int x, int y) {
    const TriangleEdges edges{g.points(t), g.rules.tie_rule};
    const EdgeValues e = edges.at(pixel_centre(x, y, g.rules.subpixel_bits));
    if (u[0] == u[1] && u[0] == u[2]) return u[0];
    Rational dividend = 0, divisor = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const float w = g.corners[t.vertex[i]].inverse_w;
        dividend += Rational{e[i]} * Rational{nearest_float(Rational{u[i]} * Rational{w})} / Rational{edges.area()};
        divisor += Rational{e[i]} * Rational{w} / Rational{edges.area()};
    }
    return nearest_float(Rational{nearest_float(dividend)} / Rational{nearest_float(divisor)});
}

}  // namespace

TEST_CASE("the requested texture units are interpolated in perspective with three roundings", "[slow]") {
    Random random{501};
    for (const bool has_rq : {false, true}) {
        RasterState state;
        state.viewport = {0, 0, 32, 32};
        const Geometry g = set_up(soup_of(random, 12, has_rq), state, {}, 1);
        constexpr FragmentNeeds needs{.shader_z = false, .code = false, .color = false, .units = 0xf041};
        std::size_t wrong = 0, fragments = 0;
        TileRasterizer rasterizer{state.viewport};
        auto sink = [&](FragmentBatch& batch) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
                const TriangleRecord& t = g.triangles[batch.primitive[i]];
                for (const auto& [unit, c] : {std::pair{0u, 0u}, {1u, 2u}, {3u, 0u}, {3u, 1u}, {3u, 2u}, {3u, 3u}}) {
                    std::array<float, 3> u;
                    for (std::size_t k = 0; k < 3; ++k) u[k] = g.extras.units_of(t.vertex[k])[4 * unit + c];
                    wrong += batch.unit[unit][c][i] != expected(g, t, u, batch.x[i], batch.y[i]);
                }
                ++fragments;
            }
        };
        REQUIRE(g.triangles.size() == 12);  // nothing was clipped, so primitives are indices
        rasterizer.draw(g, g.all_triangles, {}, needs, BatchSink{sink});
        CHECK(fragments > 400);
        CHECK(wrong == 0);
    }
}

TEST_CASE("under another hypothesis texture units are interpolated like r and q") {
    Random random{502};
    RasterState state;
    state.viewport = {0, 0, 32, 32};
    RasterRules rules;
    rules.hypothesis.interpolant_bits = 18;
    rules.hypothesis.divide = DivideRule::cut_reciprocal;
    TriangleSoup soup = soup_of(random, 12, true);
    for (std::size_t v = 0; v < soup.vertices.size(); ++v)  // unit 2 has the r and q of depth
        for (std::size_t c : {0u, 1u}) {
            soup.extras.values[v * soup.extras.stride + c] =
                c == 1 ? 3.0f + static_cast<float>(v % 5) : static_cast<float>(v % 7);
            soup.extras.values[v * soup.extras.stride + 2 + 8 + 2 + c] = soup.extras.values[v * soup.extras.stride + c];
        }
    const Geometry g = set_up(std::move(soup), state, rules, 1);
    FragmentNeeds needs{.shader_z = false, .code = true, .color = false, .reference = true, .units = 0x0c00};
    std::size_t wrong = 0, fragments = 0;
    TileRasterizer rasterizer{state.viewport};
    auto sink = [&](FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i, ++fragments)
            wrong += double{divide(batch.unit[2][2][i], batch.unit[2][3][i], rules.hypothesis.divide)} !=
                     batch.reference_z[i];
    };
    rasterizer.draw(g, g.all_triangles, {DepthPath::float32, DepthFormat::d32f, DepthPath::perspective_rq}, needs,
                    BatchSink{sink});
    CHECK(fragments > 400);
    CHECK(wrong == 0);
}

TEST_CASE("fewer bits of the interpolants affect texture units under any rule for divisions") {
    Random random{503};
    RasterState state;
    state.viewport = {0, 0, 32, 32};
    const TriangleSoup soup = soup_of(random, 12, false);
    const auto first_unit = [&](int bits, DivideRule rule) {
        RasterRules rules;
        rules.hypothesis.interpolant_bits = bits;
        rules.hypothesis.divide = rule;
        const Geometry g = set_up(soup, state, rules, 1);
        constexpr FragmentNeeds needs{.shader_z = false, .code = false, .color = false, .units = 0x0001};
        std::vector<float> values;
        auto sink = [&](FragmentBatch& batch) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                values.push_back(batch.unit[0][0][i]);
        };
        TileRasterizer{state.viewport}.draw(g, g.all_triangles, {}, needs, BatchSink{sink});
        return values;
    };
    const std::vector<float> plain = first_unit(24, DivideRule::exact);
    REQUIRE(plain.size() > 400);
    for (const int bits : {24, 16})
        for (const DivideRule rule : {DivideRule::exact, DivideRule::cut_reciprocal}) {
            if (bits == 24 && rule == DivideRule::exact) continue;
            const std::vector<float> other = first_unit(bits, rule);
            REQUIRE(other.size() == plain.size());
            std::size_t changed = 0, far = 0;
            for (std::size_t i = 0; i < plain.size(); ++i) {
                changed += other[i] != plain[i] ? 1 : 0;
                // Sums may cancel: the error is then relative to the greatest corner, 100 times the range of 1/w.
                far += std::abs(other[i] - plain[i]) > (bits == 16 ? 0x1p-5f : 0x1p-13f) ? 1 : 0;
            }
            CHECK(changed > plain.size() / 10);
            CHECK(far == 0);
        }
}

// The fog coordinate has the values of unit 0's s, and the secondary colour those of the colour.
TEST_CASE("a fog coordinate is interpolated like a texture coordinate, and a secondary colour like the colour") {
    Random random{502};
    RasterRules chip;
    chip.color = ColorInterpolation::weights_8bit;
    chip.interpolation = {.vertex_color_bits = 14,
                          .perspective_color = PerspectiveColor::cut_products,
                          .texture_coordinates = CoordinateRule::cut_weights,
                          .perspective_coordinates = PerspectiveCoordinates::cut_products};
    RasterState alone;
    alone.viewport = {0, 0, 32, 32};
    RasterState sampled = alone;
    sampled.sample = SamplePoint{6, 2};
    sampled.interpolation = Interpolation::centroid;
    sampled.sample_count = 4;
    sampled.samples = {{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
    for (const auto& [rules, state] : {std::pair{RasterRules{}, alone}, {chip, alone}, {RasterRules{}, sampled}}) {
        TriangleSoup soup = soup_of(random, 12, true);
        const VertexExtras given = soup.extras;
        soup.extras = {.stride = given.stride + 9,
                       .has_rq = true,
                       .has_fog = true,
                       .has_secondary = true,
                       .has_units = true,
                       .values = {}};
        for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
            ClipVertex& v = soup.vertices[i];
            for (std::size_t c = 0; c < color_channels; ++c) {
                v.front[c] = random_float(random, 0, 1);
                v.back[c] = random_float(random, 0, 1);
            }
            auto& values = soup.extras.values;
            const float* const own = given.of(i);
            values.insert(values.end(), own, own + 2);
            values.push_back(given.units_of(i)[0]);
            values.insert(values.end(), v.front.begin(), v.front.end());
            values.insert(values.end(), v.back.begin(), v.back.end());
            values.insert(values.end(), given.units_of(i), given.units_of(i) + 4 * texture_units);
        }
        const Geometry g = set_up(std::move(soup), state, rules, 1);
        constexpr FragmentNeeds needs{.shader_z = false, .code = false, .units = 1, .fog = true, .secondary = true};
        std::size_t wrong = 0, fragments = 0;
        TileRasterizer rasterizer{state.viewport};
        auto sink = [&](FragmentBatch& batch) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i, ++fragments) {
                wrong += batch.fog[i] != batch.unit[0][0][i] ? 1 : 0;
                for (std::size_t c = 0; c < color_channels; ++c)
                    wrong += batch.secondary[c][i] != batch.color[c][i] ? 1 : 0;
            }
        };
        rasterizer.draw(g, g.all_triangles, {}, needs, BatchSink{sink});
        CHECK(fragments > 100);
        CHECK(wrong == 0);
    }
}
