// Tests values that random triangles rarely produce: edge values outside of a triangle and beyond 2^34, areas beyond
// 2^36, negligible terms of depth, infinities and NaN. Expected values are rationals truncated by the rules
// (rational.h), or come from corners at which only one term remains.
#include <catch2/catch.hpp>

#include "rasterizer/base/nv20_arithmetic.h"
#include "rasterizer/base/simd.h"
#include "rasterizer/chip/perspective_weights.h"
#include "rasterizer/chip/truncated_weights.h"
#include "rasterizer/chip/w_buffer.h"
#include "rasterizer/chip/window_z.h"
#include "rasterizer/coverage/float_spans.h"
#include "rasterizer/set_up/depth_bound.h"
#include "rasterizer/values/depth_paths.h"
#include "rasterizer/values/depth_quotient.h"
#include "tests/rasterizer/chip_scene.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata::rasterizer;

// A positive integer of up to `bits` bits.
[[nodiscard]] std::uint64_t random_whole(Random& random, int bits) { return (random() >> (64 - bits)) | 1u; }

[[nodiscard]] Rational signed_cut(const Rational& v, int bits) {
    return v < 0 ? Rational{-truncate_to_bits(-v, bits)} : v == 0 ? v : truncate_to_bits(v, bits);
}

const float infinity = std::numeric_limits<float>::infinity();
const float not_a_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("an edge value is truncated to 24 bits toward zero on either side of its edge for any magnitude") {
    Random random{71};
    std::size_t wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto size = static_cast<std::int64_t>(random_whole(random, random_int(random, 1, 62)));
        for (const std::int64_t e : {size, -size})
            wrong += Rational{truncated_edge(e)} != signed_cut(Rational{e}, 24) ? 1 : 0;
    }
    CHECK(truncated_edge(0) == 0.0);
    CHECK(wrong == 0);
}

TEST_CASE("weights by a truncated reciprocal are those of rationals for areas and edge values of up to 48 bits",
          "[slow]") {
    Random random{72};
    std::size_t wrong = 0, large = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::uint64_t area = random_whole(random, random_int(random, 8, 48));
        const std::uint64_t e = random() % (area + 1);
        const Rational r = truncate_to_bits(Rational{1} / Rational{area}, 28);
        const Rational expected = e == 0 ? Rational{0} : truncate_to_bits(Rational{e} * r, 24);
        wrong += Rational{value(TruncatedReciprocal{area}.weight(e))} != expected ? 1 : 0;
        const TruncatedWeights weights{static_cast<std::int64_t>(area),
                                       {.weights = WeightRule::area, .reciprocal_bits = 28}};
        const auto size = static_cast<std::int64_t>(e);
        const std::array<double, 3> b = weights.at({size, -size, 0});
        wrong += Rational{b[0]} != expected || b[1] != -b[0] || b[2] != 0.0 ? 1 : 0;
        large += e >= std::uint64_t{1} << 34 ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(large > 500);
}

TEST_CASE("perspective weights have the sign of the edge value times w") {
    Random random{73};
    std::size_t wrong = 0;
    for (int i = 0; i < 500; ++i) {
        std::array<float, 3> w{}, turned_w{};
        EdgeValues e{}, turned_e{};
        for (std::size_t k = 0; k < 3; ++k) {
            w[k] = random_float(random, 0.25f, 9);
            e[k] = random_int(random, 1, 1 << 28);
            const bool is_turned = random_int(random, 0, 1) != 0;
            turned_w[k] = is_turned ? -w[k] : w[k];
            turned_e[k] = is_turned ? -e[k] : e[k];
        }
        wrong += PerspectiveWeights{w, {}}.at(e) != PerspectiveWeights{turned_w, {}}.at(turned_e) ? 1 : 0;
        // Beyond a side: that side's weight is negative, and the sum stays 1.
        const auto k = static_cast<std::size_t>(i % 3);
        e[k] = -(*std::ranges::min_element(e) / 8 + 1);
        w[k] = 9;
        const std::array<double, 3> b = PerspectiveWeights{w, {}}.truncated_at(e);
        wrong +=
            b[k] < 0 && b[(k + 1) % 3] > 0 && b[(k + 2) % 3] > 0 && std::abs(b[0] + b[1] + b[2] - 1) < 1e-6 ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("depths start from the corner of the edge value with the largest magnitude") {
    CHECK(reference_vertex({-(1 << 20), 5, 7}) == 0);
    CHECK(reference_vertex({5, -(1 << 20), 7}) == 1);
    CHECK(reference_vertex({5, 7, -(1 << 20)}) == 2);
}

TEST_CASE("a difference of depths is exact and 0 for equal ones") {
    const Dyadic none = difference(3.0f, 3.0f);
    CHECK(none.magnitude == 0);
    const Dyadic far = difference(0x1p60f, -0x1p60f);
    CHECK(far.magnitude == 1);
    CHECK(far.exponent == 61);
    const Dyadic both_zero = difference(0.0f, -0.0f);
    CHECK(both_zero.magnitude == 0);
}

TEST_CASE("terms of a depth far below the largest contribute nothing and a depth of zero terms is 0") {
    // Weights of powers of two: 1/2, 1/4 and 1/4 of an area of 2^20. Differences too far apart for binary64's products.
    const std::int64_t area = 1 << 20;
    const WindowZ24 apart{{0.0, 1.0, 0x1p-110}, area};
    CHECK(apart.value({area / 2, area / 4, area / 4}) == 0.25);  // plus 2^-112, which is truncated
    CHECK(apart.value({area, 0, 0}) == 0.0);                     // at the corner of depth 0
    CHECK(apart.value({0, area, 0}) == 1.0);
    CHECK(apart.value({0, 0, area}) == 0x1p-110);
    const WindowZ24 close{{0x1p-110, 0x1p-112, 0x1p60}, area};
    CHECK(close.value({area / 2, area / 2, 0}) == 0x1p-111 + 0x1p-113);
    CHECK(close.value({area / 4, area / 4, area / 2}) == 0x1p59);
}

TEST_CASE("NV20's product is IEEE's if a factor is infinite or NaN and so are its reciprocals of infinity and zero") {
    CHECK(nv20::multiply(infinity, 2.0f) == infinity);
    CHECK(nv20::multiply(2.0f, -infinity) == -infinity);
    CHECK(std::isnan(nv20::multiply(not_a_number, 2.0f)));
    CHECK(nv20::reciprocal(infinity) == 0.0f);
    CHECK(nv20::reciprocal(-infinity) == 0.0f);
    CHECK(std::isnan(nv20::reciprocal(not_a_number)));
    CHECK(nv20::reciprocal(-0.0f) == -infinity);
}

TEST_CASE("truncated divisions leave zeros and infinities and NaN unchanged") {
    for (const float v : {0.0f, -0.0f, infinity, -infinity}) {
        CHECK(std::bit_cast<std::uint32_t>(toward_zero(v)) == std::bit_cast<std::uint32_t>(v));
        CHECK(std::bit_cast<std::uint32_t>(round_mantissa(v, 16)) == std::bit_cast<std::uint32_t>(v));
    }
    CHECK(std::isnan(toward_zero(not_a_number)));
    CHECK(std::isnan(round_mantissa(not_a_number, 20)));
    CHECK(toward_zero(1.0f) == 1.0f - 0x1p-24f);
    CHECK(toward_zero(-1.0f) == -1.0f + 0x1p-24f);
    CHECK(divide(1.0f, infinity, DivideRule::low_reciprocal) == 0.0f);
    CHECK(divide(1.0f, 0.0f, DivideRule::low_reciprocal) == infinity);
}

TEST_CASE("two combined needs include what either of them needs value by value") {
    constexpr bool FragmentNeeds::*values[]{
        &FragmentNeeds::shader_z, &FragmentNeeds::code,   &FragmentNeeds::exact_code, &FragmentNeeds::color,
        &FragmentNeeds::texcoord, &FragmentNeeds::facing, &FragmentNeeds::reference};
    const auto needs_of = [&](unsigned bits) {
        FragmentNeeds needs;
        for (unsigned k = 0; k < 7; ++k) needs.*values[k] = (bits >> k & 1) != 0;
        needs.units = static_cast<UnitMask>(bits << 3);
        return needs;
    };
    std::size_t wrong = 0;
    for (unsigned a = 0; a < 128; ++a)
        for (unsigned b = 0; b < 128; ++b) wrong += (needs_of(a) | needs_of(b)) == needs_of(a | b) ? 0 : 1;
    CHECK(wrong == 0);
}

TEST_CASE("a w buffer's slope is taken along the axis in which w changes from the first row that has pixels") {
    // 1/w = 1/8 + x/64 in pixels, so its axis is x. Corners are on the window's 1/16 pixels; the top one is at x = 4.
    constexpr int bits = 4;
    const auto inverse_w = [](double x) { return 1.0 / 8 + x / 64; };
    const auto triangle = [&](const std::array<std::array<int, 2>, 3>& pixels) {
        std::array<SubpixelPoint, 3> p;
        std::array<float, 3> inverse;
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = {pixels[i][0] << bits, pixels[i][1] << bits};
            inverse[i] = static_cast<float>(inverse_w(pixels[i][0]));
        }
        return window_triangle(p, bits, {1, 2, 3}, inverse);
    };
    const SetupTriangle along_x = triangle({{{4, 0}, {12, 8}, {0, 8}}});
    RasterRules rules{.subpixel_bits = bits};
    for (const WSlope slope : {WSlope::first_quad, WSlope::last_quad}) {
        rules.hypothesis.w_slope = slope;
        const int start = 4, second = slope == WSlope::first_quad ? start | 1 : start | 3;
        const double expected = std::fabs(1 / inverse_w(second + 0.5) - 1 / inverse_w(second - 0.5));
        CHECK(w_slope(along_x, along_x.w, {0, 0, 16, 16}, rules) == Approx(expected).epsilon(1e-5));
    }
    // A needle whose first rows contain no centre: the slope is that of a lower row, and of w along x there, too.
    SetupTriangle needle = triangle({{{4, 0}, {5, 16}, {4, 16}}});
    const double at_second = std::fabs(1 / inverse_w(5.5) - 1 / inverse_w(4.5));
    rules.hypothesis.w_slope = WSlope::first_quad;
    CHECK(w_slope(needle, needle.w, {0, 0, 16, 16}, rules) == Approx(at_second).epsilon(1e-5));
}

TEST_CASE("r and q of vertices follow the clip volume's convention of z") {
    const auto rows = [](ClipDepth clip) {
        TriangleSoup soup;
        soup.vertices.resize(1);
        soup.vertices[0].z = 0.25f;
        soup.vertices[0].w = 0.5f;
        RasterState state;
        state.clip_depth = clip;
        state.depth_near = 0.25f;
        state.depth_far = 0.75f;
        add_rq(soup, state, {});
        return std::vector<float>(soup.extras.values.begin(), soup.extras.values.end());
    };
    // depth = n + (f - n) z/w of Direct3D's volume, 1/4 + 1/2 * 1/2; OpenGL's z/w of 1/2 is at 3/4 of the range.
    CHECK(rows(ClipDepth::zero_to_one) == std::vector<float>{0.5f * 0.5f, 0.5f});
    CHECK(rows(ClipDepth::minus_one_to_one) == std::vector<float>{0.625f * 0.5f, 0.5f});
}

TEST_CASE("a triangle of floats without an area covers nothing and a reversed order has no depth bound") {
    const FloatSpans line{{{{0, 0}, {4, 4}, {8, 8}}}};
    CHECK_FALSE(line.is_drawn());
    int visited = 0;
    line.visit({0, 0, 16, 16}, [&](int, int, int) { ++visited; });
    CHECK(visited == 0);
    const FloatSpans drawn{{{{0, 0}, {8, 0}, {0, 8}}}};
    drawn.visit({0, 0, 16, 16}, [&](int, int, int) { ++visited; });
    CHECK(visited > 0);
    Geometry geometry = random_triangles(5, 6, 20, {});
    const double bound = depth_bound(geometry, geometry.all_triangles);
    CHECK(std::isfinite(bound));
    geometry.state.depth_order = DepthOrder::greater;
    CHECK(depth_bound(geometry, geometry.all_triangles) == std::numeric_limits<double>::infinity());
}

TEST_CASE("corners whose unsnapped positions are on a line use the plane of the snapped ones whether large or small") {
    for (const int reach : {2, 40}) {
        std::vector<SetupTriangle> triangles;
        for (int i = 0; i < 5; ++i) {
            const int x = (4 + 7 * i) << 8, y = 3 << 8, far = reach << 8;
            SetupTriangle t =
                window_triangle({{{x, y}, {x + far, y}, {x, y + far}}}, 8, {0.25, 0.5, 0.75}, {1, 0.5f, 2});
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t a = 0; a < attribute_count; ++a) t.attribute[k][a] = static_cast<float>(k + a) / 16.0f;
            triangles.push_back(t);
        }
        const RasterRules snapped{.subpixel_bits = 8};
        RasterRules unsnapped = snapped;
        unsnapped.plane_origin = PlaneOrigin::unsnapped;
        Geometry expected = window_geometry(triangles, 70, 50, snapped),
                 on_a_line = window_geometry(triangles, 70, 50, unsnapped);
        for (Geometry* const g : {&expected, &on_a_line})
            for (std::size_t i = 0; i < g->corners.size(); ++i)
                g->corners[i].unsnapped = {static_cast<float>(i % 3), static_cast<float>(2 * (i % 3))};
        for (const strata::Simd simd : strata::available_simd()) {
            const strata::SimdScope kernels{simd};
            const DrawResult found = draw(on_a_line), model = draw(expected);
            INFO("reach " << reach << ", set " << static_cast<int>(simd));
            CHECK(model.fragments.size() >= 5);
            CHECK(found.fragments == model.fragments);
        }
        CHECK(depth_bound(on_a_line, on_a_line.all_triangles) >= 0.75);  // the slope is undefined, the corners are not
    }
}

TEST_CASE("every value of a fragment is independent of the other requested values for every path and format",
          "[slow]") {
    std::size_t wrong = 0, compared = 0;
    const auto compare = [&](const Geometry& g, const DepthRequest& depth) {
        FragmentNeeds all = everything;
        all.facing = false;
        const std::vector<Fragment> whole = draw(g, depth, all).fragments;
        for (unsigned bits = 0; bits < 32; ++bits) {
            const FragmentNeeds needs{(bits & 1) != 0, (bits & 2) != 0,  (bits & 4) != 0,
                                      (bits & 8) != 0, (bits & 16) != 0, false};
            std::vector<Fragment> expected = whole;
            for (Fragment& f : expected) {
                if (!needs.shader_z) f.shader_z = 0;
                if (!needs.code) f.code = 0;
                if (!needs.exact_code) f.exact_code = 0;
                if (!needs.color) f.color = {};
                if (!needs.texcoord) f.texcoord = {};
            }
            wrong += draw(g, depth, needs).fragments == expected ? 0 : 1;
            ++compared;
        }
    };
    for (const DepthFormat format :
         {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16f, DepthFormat::d24f}) {
        for (const DepthPath path : {DepthPath::float32, DepthPath::float32_plane, DepthPath::exact}) {
            const Device device{{.subpixel_bits = 8}, {path, format}};
            compare(random_triangles(91, 24, 12, device), device.depth);
        }
        if (format == DepthFormat::d32f) continue;
        for (const DepthPath path : {DepthPath::window_z, DepthPath::w_buffer})
            for (const bool has_offset : {false, true}) {
                const Device device{chip_rules(), {path, format}};
                Geometry g = chip_triangles(92, 24, 12, device);
                g.state.depth_clamp = true;
                g.state.w_scale =
                    path == DepthPath::w_buffer && has_offset ? 1e9f : 3.0f;  // beyond the range, or within
                if (has_offset) g.state.polygon_offset = {true, 0.0f, 2.0f};
                compare(g, device.depth);
            }
    }
    CHECK(wrong == 0);
    CHECK(compared == (5 * 3 + 4 * 2 * 2) * 32);
}
