// Tests set-up on single triangles whose expected result is written by hand.
#include "rasterizer/set_up/setup.h"

#include <bit>
#include <catch2/catch.hpp>
#include <limits>
#include <utility>

#include "rasterizer/base/simd.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

constexpr float no_end = std::numeric_limits<float>::infinity();
constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

[[nodiscard]] ClipVertex at(float x, float y) { return {x, y, 0, 1, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0}}; }

// Counterclockwise in the window with y up.
[[nodiscard]] TriangleSoup one_triangle() {
    TriangleSoup soup;
    soup.vertices = {at(-.5f, -.5f), at(.5f, -.5f), at(0, .5f)};
    soup.indices = {0, 1, 2};
    soup.runs = {{0, 3, 0, 0, true, false}};
    return soup;
}

[[nodiscard]] SetupCounters counters_of(const TriangleSoup& soup, const RasterState& state,
                                        const RasterRules& rules = {}) {
    return set_up(soup, state, rules, 1).counters;
}

[[nodiscard]] bool same_bits(const SetupTriangle& a, const SetupTriangle& b) {
    bool same = a.p == b.p && a.primitive == b.primitive && a.front_facing == b.front_facing;
    for (std::size_t i = 0; i < 3; ++i) {
        using Bits = std::array<std::uint32_t, 2>;
        same = same && std::bit_cast<Bits>(a.unsnapped[i]) == std::bit_cast<Bits>(b.unsnapped[i]);
        same = same && std::bit_cast<std::uint64_t>(a.z[i]) == std::bit_cast<std::uint64_t>(b.z[i]);
        same = same && std::bit_cast<std::uint32_t>(a.inverse_w[i]) == std::bit_cast<std::uint32_t>(b.inverse_w[i]);
    }
    return same;
}

}  // namespace

TEST_CASE("a triangle with a component that is not finite is dropped and counted and named") {
    const RasterState state = scene_state(16, 16);
    for (const float bad : {no_number, no_end, -no_end})
        for (int field = 0; field < 7; ++field) {
            TriangleSoup soup = one_triangle();
            soup.indices = {0, 1, 2, 0, 1, 3};
            soup.runs[0].index_count = 6;
            soup.vertices.push_back(at(0, .25f));
            ClipVertex& v = soup.vertices[3];
            const std::array<float*, 7> fields{&v.x, &v.y, &v.z, &v.w, &v.front[2], &v.back[1], &v.texcoord[1]};
            *fields[static_cast<std::size_t>(field)] = bad;
            const Geometry geometry = set_up(soup, state, {}, 1);
            CHECK(geometry.triangles.size() == 1);
            CHECK(geometry.counters == SetupCounters{.triangles_in = 2, .non_finite = 1, .first_non_finite = 1});
        }
}

TEST_CASE("a triangle that becomes infinite after the division is also dropped and counted") {
    TriangleSoup soup = one_triangle();
    for (ClipVertex& v : soup.vertices) {
        v.w = 0x1p-60f;
        v.x *= v.w;
        v.y *= v.w;
        v.texcoord[0] = 0x1p100f;
    }
    CHECK(counters_of(soup, scene_state(16, 16)).non_finite == 1);
    for (ClipVertex& v : soup.vertices) v.texcoord[0] = 1;
    CHECK(set_up(soup, scene_state(16, 16), {}, 1).triangles.size() == 1);
}

TEST_CASE("facing is the winding in the window with y up or down and either front face and mirrored or not") {
    for (const YDirection y : {YDirection::up, YDirection::down})
        for (const FrontFace front : {FrontFace::counter_clockwise, FrontFace::clockwise})
            for (const bool mirrored : {false, true})
                for (const bool reversed : {false, true}) {
                    TriangleSoup soup = one_triangle();
                    soup.runs[0].mirrored = mirrored;
                    if (reversed) std::swap(soup.indices[1], soup.indices[2]);
                    RasterState state = scene_state(16, 16);
                    state.y_direction = y;
                    state.front_face = front;
                    const Geometry geometry = set_up(soup, state, {}, 1);
                    // The window's y increases with clip y for any order of rows in memory.
                    const bool expected = (front == FrontFace::counter_clockwise) != (mirrored != reversed);
                    REQUIRE(geometry.triangles.size() == 1);
                    CHECK(geometry.triangles[0].front_facing == expected);
                    CHECK(geometry.triangle(0).attribute[0][expected ? 0 : 1] == 1.0f);  // front red, back green
                }
}

TEST_CASE("single-sided runs are culled by facing and double-sided ones never") {
    TriangleSoup soup = one_triangle();
    for (const CullFace cull : {CullFace::none, CullFace::front, CullFace::back, CullFace::front_and_back})
        for (const bool double_sided : {false, true})
            for (const bool mirrored : {false, true}) {
                soup.runs[0].double_sided = double_sided;
                soup.runs[0].mirrored = mirrored;
                RasterState state = scene_state(16, 16);
                state.cull = cull;
                const bool by_face = mirrored ? cull == CullFace::back : cull == CullFace::front;
                const bool culled = !double_sided && (by_face || cull == CullFace::front_and_back);
                CHECK(counters_of(soup, state).culled == (culled ? 1u : 0u));
            }
}

TEST_CASE("a triangle with zero area after snapping is degenerate such as a line or one below a subpixel") {
    const RasterState state = scene_state(16, 16);
    TriangleSoup soup = one_triangle();
    soup.vertices = {at(-1, 1), at(-.5f, .5f), at(0, 0)};
    CHECK(counters_of(soup, state).degenerate == 1);
    soup.vertices = {at(0, 0), at(0x1p-13f, 0), at(0, 0x1p-13f)};
    CHECK(counters_of(soup, state).degenerate == 1);
    CHECK(counters_of(soup, state, {.subpixel_bits = 12}).degenerate == 0);
}

TEST_CASE("a triangle between pixel centres or beyond the viewport is outside") {
    const RasterState state = scene_state(16, 16);
    TriangleSoup soup = one_triangle();
    soup.vertices = {at(0, 0), at(.05f, 0), at(0, .05f)};
    CHECK(counters_of(soup, state).outside == 1);
    soup.vertices = {at(1.5f, 0), at(2, 0), at(2, .5f)};
    CHECK(counters_of(soup, state).outside == 1);
}

TEST_CASE("an order permutes submission and keeps the index of the source") {
    TriangleSoup soup = random_soup(91, 10, SoupKind::flat);
    for (TriangleRun& run : soup.runs) run.double_sided = true;
    const Geometry listed = set_up(soup, scene_state(64, 64), {}, 1);
    REQUIRE(listed.triangles.size() == 10);
    soup.order = {9, 3, 5, 0, 1, 2, 4, 8, 7, 6};
    soup.vertices[5 * 3 + 1].x = no_number;
    const Geometry ordered = set_up(soup, scene_state(64, 64), {}, 1);
    REQUIRE(ordered.triangles.size() == 9);
    CHECK(ordered.counters.first_non_finite == 5);
    for (const SetupTriangle& t : triangles_of(ordered)) {
        const std::uint32_t source = soup.order[t.primitive];
        CHECK(t.p == listed.triangle(source).p);
        CHECK(t.material == (source < 5 ? 7u : 8u));
    }
}

TEST_CASE("the result of set-up does not depend on the number of threads") {
    TriangleSoup soup = random_soup(92, 20000, SoupKind::needs_clipping);
    soup.vertices[30001].y = no_number;
    const RasterState state = scene_state(64, 64);
    const Geometry one = set_up(soup, state, {}, 1);
    CHECK(one.counters.clipped > 1000);
    CHECK(one.counters.first_non_finite == 10000);
    for (const int threads : {2, 4}) {
        const Geometry many = set_up(soup, state, {}, threads);
        CHECK(many.counters == one.counters);
        REQUIRE(many.triangles.size() == one.triangles.size());
        std::uint64_t different = 0;
        for (std::size_t i = 0; i < one.triangles.size(); ++i) {
            const SetupTriangle a = one.triangle(i), b = many.triangle(i);
            different += a.p != b.p || a.z != b.z || a.inverse_w != b.inverse_w || a.attribute != b.attribute ||
                                 a.primitive != b.primitive || a.front_facing != b.front_facing ||
                                 a.unsnapped != b.unsnapped
                             ? 1
                             : 0;
        }
        CHECK(different == 0);
    }
}

TEST_CASE("every instruction set sets up vertices to the same bits with any invalid values among them", "[slow]") {
    TriangleSoup soup = random_soup(93, 2000, SoupKind::needs_clipping);
    Random random{94};
    for (int i = 0; i < 300; ++i) {
        const std::array values{no_number, no_end, -no_end, 0.0f, -0.0f, 0x1p-70f, 0x1p127f, -0x1p100f};
        ClipVertex& v = soup.vertices[random() % soup.vertices.size()];
        const std::array<float*, 8> fields{&v.x,        &v.y,       &v.z,           &v.w,
                                           &v.front[1], &v.back[3], &v.texcoord[0], &v.texcoord[1]};
        *fields[random() % fields.size()] = values[random() % values.size()];
    }
    for (std::size_t i = 0; i < 60;
         ++i) {  // in view but too near the eye; or near, with an attribute that 1 / w makes infinite
        ClipVertex* const v = &soup.vertices[3 * 33 * i];
        const float w = i % 2 == 0 ? 0x1p-70f : 0x1p-40f;
        for (std::size_t k = 0; k < 3; ++k) v[k] = {k == 1 ? w : 0, k == 2 ? w : 0, 0, w, {}, {}, {}};
        if (i % 2 == 1) (i % 4 == 1 ? v->texcoord[1] : v->back[2]) = 0x1p100f;
    }
    RasterState state = scene_state(200, 130);
    TriangleSoup with_extras = soup;  // r and q of every vertex, some of them too large over w
    with_extras.extras = {.stride = 2, .has_rq = true, .values = {}};
    for (const ClipVertex& v : soup.vertices)
        with_extras.extras.values.insert(with_extras.extras.values.end(), {random() % 20 == 0 ? no_end : v.z, v.w});
    const auto compare = [&](const RasterRules& rules, const TriangleSoup& given, std::uint64_t least_dropped) {
        const strata::SimdScope scalar_reference{strata::Simd::scalar};
        const Geometry scalar = set_up(given, state, rules, 1);
        CHECK(scalar.counters.non_finite > least_dropped);
        CHECK(scalar.triangles.size() > 700);
        for (const strata::Simd simd : strata::available_simd()) {
            const strata::SimdScope kernels{simd};
            const Geometry other = set_up(given, state, rules, 1);
            CHECK(other.counters == scalar.counters);
            REQUIRE(other.triangles.size() == scalar.triangles.size());
            std::size_t different = 0;
            for (std::size_t i = 0; i < scalar.triangles.size(); ++i)
                different += same_bits(scalar.triangle(i), other.triangle(i)) ? 0 : 1;
            CHECK(different == 0);
        }
    };
    for (const WDivide divide : {WDivide::quotient, WDivide::reciprocal, WDivide::nv20})
        for (const Snap snap : {Snap::toward_zero, Snap::nearest_even})
            for (const ViewportArithmetic viewport : {ViewportArithmetic::separate, ViewportArithmetic::fused})
                for (const TriangleSoup* each : {&std::as_const(soup), &std::as_const(with_extras)})
                    compare({.snap = snap, .w_divide = divide, .viewport = viewport}, *each, each == &soup ? 100 : 200);
    state.clip_depth = ClipDepth::zero_to_one;
    state.y_direction = YDirection::down;
    compare({.window_z = WindowZ::buffer_units}, soup, 100);
}

TEST_CASE("an empty soup is an empty geometry") {
    const Geometry geometry = set_up({}, scene_state(16, 16), {}, 2);
    CHECK(geometry.triangles.empty());
    CHECK(draw(geometry).fragments.empty());
}
