// Tests polygon offset against o = m factor + r units in rational arithmetic, where m is the larger slope of the plane
// per pixel.
#include "rasterizer/set_up/polygon_offset.h"

#include <catch2/catch.hpp>
#include <limits>

#include "rasterizer/walk/tile_rasterizer.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] Rational model_slope(const std::array<SubpixelPoint, 3>& p, const std::array<float, 3>& z, int bits) {
    std::array<Rational, 3> x, y;
    for (std::size_t i = 0; i < 3; ++i) {
        x[i] = Rational{p[i].x} * power(-bits);
        y[i] = Rational{p[i].y} * power(-bits);
    }
    // Cramer's rule for z = a x + b y + c
    const Rational det = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    const Rational z1 = Rational{z[1]} - Rational{z[0]}, z2 = Rational{z[2]} - Rational{z[0]};
    const Rational a = (z1 * (y[2] - y[0]) - z2 * (y[1] - y[0])) / det;
    const Rational b = ((x[1] - x[0]) * z2 - (x[2] - x[0]) * z1) / det;
    return std::max(Rational{abs(a)}, Rational{abs(b)});
}

[[nodiscard]] double only_offset(const RasterState& state, const RasterRules& rules, const std::array<float, 3>& z) {
    return polygon_offset({{{0, 0}, {4096, 0}, {0, 4096}}}, z, state, rules);
}

}  // namespace

TEST_CASE("the slope of polygon offset is the larger window slope within 2^-49 of the rational one") {
    constexpr std::uint64_t seed = 81;
    Random random{seed};
    std::uint64_t wrong = 0;
    for (int n = 0; n < 2000; ++n) {
        const int bits = std::array{4, 8, 12}[static_cast<std::size_t>(n % 3)];
        const std::array p{random_point(random, 40, 40, bits, 100), random_point(random, 40, 40, bits, 100),
                           random_point(random, 40, 40, bits, 100)};
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        const std::array z{random_float(random, 0, 1), random_float(random, 0, 1), random_float(random, 0, 1)};
        const Rational exact = model_slope(p, z, bits);
        const Rational found{largest_slope(p, {z[0], z[1], z[2]}, bits)};
        // The tolerance is relative to the two products of a component, which may cancel.
        Rational reach = 0;
        for (std::size_t i = 1; i < 3; ++i)
            for (std::size_t k = 1; k < 3; ++k)
                reach = std::max(reach, Rational{abs(Rational{z[i]} - Rational{z[0]})} *
                                            std::max(std::abs(p[k].x - p[0].x), std::abs(p[k].y - p[0].y)));
        reach = reach * power(bits) / Rational{abs(doubled_area(p[0], p[1], p[2]))};
        wrong += abs(found - exact) > reach * power(-49) ? 1 : 0;
    }
    INFO("seed " << seed);
    CHECK(wrong == 0);
}

TEST_CASE("a unit is one code of a fixed-point format and 2^(e - 23) of a float one") {
    RasterState state;
    state.polygon_offset = {true, 0.0f, 3.0f};
    state.depth_format = DepthFormat::d16;
    CHECK(only_offset(state, {}, {0, .5f, 1}) == 3 * (1.0 / 65535));
    state.depth_format = DepthFormat::d24;
    CHECK(only_offset(state, {}, {0, .5f, 1}) == 3 * (1.0 / 16777215));
    CHECK(only_offset(state, {.window_z = WindowZ::buffer_units}, {0, 5, 1000}) == 3.0);
    CHECK(only_offset(state, {.offset_unit = OffsetUnit::two_codes}, {0, .5f, 1}) == 3 * (2.0 / 16777215));
    state.depth_format = DepthFormat::d32f;
    CHECK(only_offset(state, {}, {0, .5f, .25f}) == 3 * 0x1p-24);
    CHECK(only_offset(state, {}, {0, -.5f, .25f}) == 3 * 0x1p-24);
    CHECK(only_offset(state, {.offset_unit = OffsetUnit::two_codes}, {0, -.5f, .25f}) == 3 * 0x1p-24);
    CHECK(only_offset(state, {}, {0, .5f, 1}) == 3 * 0x1p-23);
    CHECK(only_offset(state, {}, {0, 0x1p-149f, 0}) == 3 * 0x1p-149);
    CHECK(only_offset(state, {}, {0, 0, 0}) == 3 * 0x1p-149);
    state.depth_format = DepthFormat::d24;
    CHECK(only_offset(state, {.offset_unit = OffsetUnit::float_exponent}, {0, .5f, .25f}) == 3 * 0x1p-24);
}

TEST_CASE("a unit of differences is 1.01 / 65535 for D16 and else comes from depths and their differences") {
    const RasterRules rules{.offset_unit = OffsetUnit::differences};
    RasterState state;
    state.polygon_offset = {true, 0.0f, 3.0f};
    state.depth_format = DepthFormat::d16;
    CHECK(only_offset(state, rules, {0, .5f, 1}) == 3 * double{1.01f / 65535.0f});
    for (const DepthFormat format : {DepthFormat::d24, DepthFormat::d32f}) {
        state.depth_format = format;
        // Units of 0.5 and 0.25 of the middle depth, and of 0.75.
        CHECK(only_offset(state, rules, {.75f, .75f, .5f}) == 3 * 0x1p-24);
        state.clip_depth = ClipDepth::zero_to_one;
        CHECK(only_offset(state, rules, {.25f, .9f, .9f}) == 3 * 0x1p-24);  // 0.65
        CHECK(only_offset(state, rules, {.25f, .625f, .6f}) == 3 * 0x1p-25);
        CHECK(only_offset(state, rules, {.625f, .25f, .6f}) == 3 * 0x1p-24);
        state.depth_near = .875f;
        CHECK(only_offset(state, rules, {.25f, .9f, .9f}) == 3 * 0x1p-23);  // 1.525
        state.depth_near = 0.0f;
        state.clip_depth = ClipDepth::minus_one_to_one;
    }
}

TEST_CASE("a zero factor ignores a slope that is not finite") {
    RasterState state;
    state.depth_format = DepthFormat::d24;
    state.polygon_offset = {true, 0.0f, 1.0f};
    const std::array<SubpixelPoint, 3> sliver{{{0, 0}, {1 << 27, 0}, {1 << 26, 1}}};
    CHECK(polygon_offset(sliver, {-3e38f, 3e38f, 3e38f}, state, {.subpixel_bits = 12}) == 1.0 / 16777215);
}

TEST_CASE("polygon offset moves every fragment's depth by the same amount and nothing else") {
    Random random{82};
    const TriangleSoup soup = random_soup(83, 40, SoupKind::perspective);
    RasterState state = scene_state(32, 32);
    state.depth_format = DepthFormat::d24;
    const auto plain = draw(set_up(soup, state, {}, 1), {DepthPath::exact, DepthFormat::d24}, everything).fragments;
    state.polygon_offset = {true, 0.0f, 100.0f};
    const auto moved = draw(set_up(soup, state, {}, 1), {DepthPath::exact, DepthFormat::d24}, everything).fragments;
    REQUIRE(plain.size() == moved.size());
    std::uint64_t wrong = 0, compared = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        wrong += plain[i].x != moved[i].x || plain[i].y != moved[i].y || plain[i].color != moved[i].color ? 1 : 0;
        if (plain[i].code > 16777000) continue;
        ++compared;
        const std::uint32_t step = moved[i].code - plain[i].code;
        wrong += step < 99 || step > 101 ? 1 : 0;  // a rounding boundary may be between the two depths
    }
    CHECK(compared > 1000);
    CHECK(wrong == 0);
}

TEST_CASE("the offset is slope times factor plus units in the units of vertex z of every format and convention") {
    Random random{84};
    std::uint64_t wrong = 0, cases = 0;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16f})
        for (const WindowZ convention : {WindowZ::unit_interval, WindowZ::buffer_units})
            for (int n = 0; n < 200; ++n) {
                const std::array p{random_point(random, 40, 40, 4), random_point(random, 40, 40, 4),
                                   random_point(random, 40, 40, 4)};
                if (abs(doubled_area(p[0], p[1], p[2])) < 4096) continue;
                RasterState state;
                state.depth_format = format;
                state.polygon_offset = {true, random_float(random, -4, 4), random_float(random, -50, 50)};
                const bool scaled = convention == WindowZ::buffer_units && format != DepthFormat::d32f;
                // One code of the format: d16f has 65,535 of them up to 511.9375, regardless of their spacing.
                const Rational codes = format == DepthFormat::d24 ? 16777215 : 65535;
                const Rational depth_1 = !scaled                       ? Rational{1}
                                         : format == DepthFormat::d16f ? Rational{8191, 16}
                                                                       : codes;
                std::array<float, 3> z;
                for (float& each : z) each = random_float(random, 0.25f, 1) * nearest_float(depth_1);
                const float largest = std::max({z[0], z[1], z[2]});
                const Rational unit =
                    format == DepthFormat::d32f ? power(floor_log2(Rational{largest}) - 23) : Rational{depth_1 / codes};
                const Rational exact = model_slope(p, z, 4) * Rational{state.polygon_offset.factor} +
                                       unit * Rational{state.polygon_offset.units};
                const Rational found{polygon_offset(p, z, state, {.subpixel_bits = 4, .window_z = convention})};
                ++cases;
                wrong += abs(found - exact) > depth_1 * power(-40) ? 1 : 0;
            }
    CHECK(cases > 1000);
    CHECK(wrong == 0);
}

TEST_CASE("an offset beyond 2^64 is 2^64 with its sign") {
    RasterState state;
    state.depth_format = DepthFormat::d24;
    state.polygon_offset = {true, 0.0f, 1e30f};
    CHECK(only_offset(state, {}, {0, 0, 0}) == 0x1p64);
    state.polygon_offset = {true, -1e20f, 0.0f};
    CHECK(only_offset(state, {.window_z = WindowZ::buffer_units}, {0, 1e7f, 0}) == -0x1p64);
}

TEST_CASE("set-up adds a triangle's offset to the depth of its three corners and not to shared vertices") {
    TriangleSoup soup = random_soup(85, 60, SoupKind::perspective);
    for (TriangleRun& run : soup.runs) run.double_sided = true;
    for (std::size_t i = 3; i < soup.indices.size(); i += 3) soup.indices[i] = soup.indices[i - 1];
    RasterState state = scene_state(48, 48);
    const Geometry plain = set_up(soup, state, {}, 1);
    state.polygon_offset = {true, 1.25f, -7.0f};
    const Geometry moved = set_up(soup, state, {}, 1);
    REQUIRE(moved.triangles.size() == plain.triangles.size());
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < plain.triangles.size(); ++i) {
        const std::array<double, 3> z = plain.depths(i), found = moved.depths(i);
        const std::array<float, 3> corners{static_cast<float>(z[0]), static_cast<float>(z[1]),
                                           static_cast<float>(z[2])};
        const double offset = polygon_offset(plain.points(plain.triangles[i]), corners, state, {});
        for (std::size_t k = 0; k < 3; ++k) {
            wrong += found[k] != z[k] + offset || offset == 0.0 ? 1 : 0;
            const std::uint32_t v = plain.triangles[i].vertex[k];
            wrong += moved.corners[v].z != plain.corners[v].z ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("set-up leaves the depths of a run without offset, of whole and of clipped triangles") {
    TriangleSoup soup = random_soup(86, 60, SoupKind::perspective);
    REQUIRE(soup.runs.size() == 2);
    for (std::size_t i = 0; i < soup.vertices.size(); i += 7) soup.vertices[i].x *= 4;
    RasterState state = scene_state(48, 48);
    state.polygon_offset = {true, 1.25f, -7.0f};
    for (const PlaneRule plane : {PlaneRule::exact, PlaneRule::reciprocal_area, PlaneRule::greatest_w}) {
        RasterRules rules;
        rules.plane_rule = plane;
        rules.clip = ClipVolume::view_volume;
        soup.runs[0].without_offset = false;
        const Geometry all = set_up(soup, state, rules, 1);
        soup.runs[0].without_offset = true;
        const Geometry some = set_up(soup, state, rules, 1);
        REQUIRE(all.counters.clipped > 0);
        REQUIRE(some.triangles.size() == all.triangles.size());
        std::uint64_t wrong = 0, kept = 0;
        for (std::size_t i = 0; i < some.triangles.size(); ++i) {
            const TriangleRecord& t = some.triangles[i];
            const bool is_kept = t.material == soup.runs[0].material;
            std::array<double, 3> given{};
            for (std::size_t k = 0; k < 3; ++k) given[k] = some.corners[t.vertex[k]].z;
            wrong += some.depths(i) != (is_kept ? given : all.depths(i)) || t.takes_offset() == is_kept ? 1 : 0;
            kept += is_kept ? 1 : 0;
        }
        CHECK(wrong == 0);
        CHECK(kept > 10);
        CHECK(some.triangles.size() - kept > 10);
    }
}

namespace {

// A triangle in clip space (w is 1) and its offset in a frame of 64 x 64 pixels, a pixel, and the bits of the depths
// that softpipe, llvmpipe and llvmpipe without fused multiply-add stored there in D32F.
struct DrawnOffset {
    std::array<std::array<float, 3>, 3> corner;
    PolygonOffset offset;
    int x, y;
    std::array<std::uint32_t, 3> bits;
};
constexpr std::array<std::array<float, 3>, 3> nearer{{{-0.153320312f, -0.798828125f, 0.593171656f},
                                                      {0.684570312f, -0.025390625f, -0.218021035f},
                                                      {0.390625f, -0.928710938f, -0.0185421109f}}};
constexpr std::array<std::array<float, 3>, 3> farther{{{0.725585938f, 0.935546875f, 0.42545253f},
                                                       {-0.390625f, -0.345703125f, -0.021379292f},
                                                       {0.506835938f, -0.80078125f, -0.499646097f}}};
constexpr std::array<std::array<float, 3>, 3> drawn_by_both{{{0.426757812f, 0.975585938f, 0.381504476f},
                                                             {-0.973632812f, 0.04296875f, -0.411935419f},
                                                             {0.698242188f, 0.0634765625f, 0.607899249f}}};
constexpr std::array<std::array<float, 3>, 3> steep{{{0.875976562f, -0.794921875f, -0.776670873f},
                                                     {0.140625f, -0.048828125f, -0.394258887f},
                                                     {0.806640625f, -0.25f, 0.53358835f}}};
constexpr DrawnOffset drawn_offsets[]{
    {nearer, {true, 0, -96}, 50, 38, {0x3edfd362u, 0x3edfd361u, 0x3edfd362u}},
    {nearer, {true, 0, -96}, 47, 39, {0x3ef8f786u, 0x3ef8f783u, 0x3ef8f783u}},
    {farther, {true, 1.84968996f, 0}, 52, 10, {0x3f2a48bdu, 0x3f2a48bdu, 0x3f2a48bdu}},
    {farther, {true, 1.84968996f, 0}, 49, 11, {0x3f2afdfeu, 0x3f2afdfeu, 0x3f2afdffu}},
    {drawn_by_both, {true, -2.33459544f, -96}, 46, 12, {0x3f304d29u, 0x3f304d29u, 0x3f304d29u}},
    {drawn_by_both, {true, -2.33459544f, -96}, 43, 13, {0x3f293cc1u, 0x3f293cc1u, 0x3f293cc2u}},
    {steep, {true, -2.13501453f, 0}, 50, 38, {0x3efa0478u, 0x3efa047bu, 0x3efa047bu}},
    {steep, {true, -2.13501453f, 0}, 47, 39, {0x3eafa38du, 0x3eafa38fu, 0x3eafa38fu}}};

[[nodiscard]] RasterRules mesa_rules(PlaneRule rule) {
    RasterRules rules;
    rules.clip = ClipVolume::view_volume;
    rules.w_divide = WDivide::reciprocal;
    rules.plane_origin = PlaneOrigin::unsnapped;
    rules.plane_rule = rule;
    rules.offset_unit = OffsetUnit::two_codes;
    if (rule == PlaneRule::least_corner) rules.coverage = CoverageRule::float_spans;
    return rules;
}

// The depth that the rasterizer returns at one pixel; NaN where it draws nothing.
[[nodiscard]] float depth_at(const DrawnOffset& drawn, const RasterRules& rules) {
    TriangleSoup soup;
    for (const auto& [x, y, z] : drawn.corner) {
        ClipVertex v{};
        v.x = x, v.y = y, v.z = z, v.w = 1;
        soup.vertices.push_back(v);
        soup.indices.push_back(static_cast<std::uint32_t>(soup.indices.size()));
    }
    soup.runs.push_back({.first_index = 0, .index_count = 3});
    RasterState state = scene_state(64, 64);
    state.polygon_offset = drawn.offset;
    const Geometry geometry = set_up(soup, state, rules, 1);
    float found = std::numeric_limits<float>::quiet_NaN();
    auto look = [&](const FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
            if (batch.pixel[i] == static_cast<std::uint32_t>(drawn.y * 64 + drawn.x)) found = batch.shader_z[i];
    };
    TileRasterizer(state.viewport)
        .draw(geometry, geometry.all_triangles, {}, {.shader_z = true, .code = false, .color = false}, BatchSink{look});
    return found;
}

}  // namespace

TEST_CASE("with stepped planes the offset gives bit for bit the depths that the drivers stored") {
    for (const DrawnOffset& drawn : drawn_offsets) {
        INFO("pixel " << drawn.x << ", " << drawn.y << ", factor " << drawn.offset.factor);
        CHECK(std::bit_cast<std::uint32_t>(depth_at(drawn, mesa_rules(PlaneRule::least_corner))) == drawn.bits[0]);
        CHECK(std::bit_cast<std::uint32_t>(depth_at(drawn, mesa_rules(PlaneRule::reciprocal_area_fused))) ==
              drawn.bits[1]);
        CHECK(std::bit_cast<std::uint32_t>(depth_at(drawn, mesa_rules(PlaneRule::reciprocal_area))) == drawn.bits[2]);
    }
}
