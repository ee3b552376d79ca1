// Tests the depth paths against rationals (rational.h) with every rounding in the rules of depth_quotient.h and
// depth_paths.h written out.
#include "rasterizer/values/depth_paths.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/values/quotient_triangles.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] RasterRules buffer_rules(const DepthHypothesis& hypothesis = {}) {
    return {.subpixel_bits = 4,
            .window_z = WindowZ::buffer_units,
            .depth_rounding = DepthRounding::floor,
            .hypothesis = hypothesis};
}

[[nodiscard]] float to_bits(float v, int bits) {
    if (bits >= 24 || v == 0) return v;
    const Rational size_of = abs(Rational{v});
    const int unit = floor_log2(size_of) - bits + 1;
    const Rational scaled = size_of * power(-unit);
    Integer code = floor(scaled);
    const Rational rest = scaled - Rational{code};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && (code & 1) != 0)) ++code;
    return nearest_float((v < 0 ? -Rational{code} : Rational{code}) * power(unit));
}

[[nodiscard]] float model_divide(float n, float d, DivideRule rule) {
    const Rational one = Rational{1} / Rational{d};
    const Rational near{nearest_float(one)};
    switch (rule) {
        case DivideRule::exact: return nearest_float(Rational{n} / Rational{d});
        case DivideRule::cut_reciprocal: return nearest_float(Rational{n} * truncate_to_bits(one, 24));
        case DivideRule::low_reciprocal: {
            const int unit = floor_log2(abs(near)) - 23;
            const bool is_power = abs(near) == power(unit + 23);  // below a power of two the unit is half as large
            const Rational step = power(is_power ? unit - 1 : unit);
            return nearest_float(Rational{n} * (near < 0 ? Rational{near + step} : Rational{near - step}));
        }
    }
    return 0;
}

[[nodiscard]] float model_coordinate(const std::array<Rational, 3>& b, const std::array<float, 3>& u,
                                     const std::array<float, 3>& inverse_w, const DepthHypothesis& h) {
    if (u[0] == u[1] && u[0] == u[2]) return to_bits(u[0], h.interpolant_bits);
    std::array<float, 3> product;
    for (std::size_t i = 0; i < 3; ++i) product[i] = nearest_float(Rational{u[i]} * Rational{inverse_w[i]});
    const float above = to_bits(nearest_float(plane_value(b, product)), h.interpolant_bits);
    if (inverse_w == std::array{1.0f, 1.0f, 1.0f}) return above;
    const float below = to_bits(nearest_float(plane_value(b, inverse_w)), h.interpolant_bits);
    return model_divide(above, below, h.divide);
}

// R in the units of r.
[[nodiscard]] float model_quotient(const QuotientTriangle& t, const Fragment& f, int bits, const DepthHypothesis& h) {
    const std::array<Rational, 3> b = barycentric(t.setup.p, f.x, f.y, bits);
    return model_divide(model_coordinate(b, t.r, t.setup.inverse_w, h), model_coordinate(b, t.q, t.setup.inverse_w, h),
                        h.divide);
}

[[nodiscard]] std::uint32_t model_floor(const Rational& v, std::uint32_t max) {
    if (v <= 0) return 0;
    return v >= max ? max : floor(v).convert_to<std::uint32_t>();
}

struct Tally {
    std::uint64_t fragments = 0, wrong = 0;
};

// Number of fragments whose compared R differs from the model's.
[[nodiscard]] Tally compare_quotients(std::uint64_t seed, const DepthHypothesis& hypothesis, DepthFormat format) {
    Tally tally;
    const int count = hypothesis == DepthHypothesis{} ? 30 : 10;
    for (const QuotientTriangle& t : random_quotient_triangles(seed, count, 4, max_code(format)))
        for (const Fragment& f : draw(quotient_geometry({t}, buffer_rules(hypothesis), format),
                                      {DepthPath::perspective_rq, format}, quotient_needs)
                                     .fragments) {
            const float r = model_quotient(t, f, 4, hypothesis);
            tally.wrong += f.reference_z != double{r} ||
                                   f.reference_code != model_floor(Rational{r}, max_code(format)) ||
                                   f.code != f.reference_code
                               ? 1
                               : 0;
            ++tally.fragments;
        }
    return tally;
}

}  // namespace

TEST_CASE(
    "the compared depth follows comparison 4: planes of r/w and q/w and 1/w and three divisions each rounded once",
    "[slow]") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
        const Tally tally = compare_quotients(901, {}, format);
        CHECK(tally.fragments > 500);
        CHECK(tally.wrong == 0);
    }
}

TEST_CASE("fewer bits of the interpolants and divisions by a reciprocal change the values that their hypothesis states",
          "[slow]") {
    for (const int bits : {16, 17, 20, 23})
        CHECK(compare_quotients(902, {.interpolant_bits = bits}, DepthFormat::d24).wrong == 0);
    for (const DivideRule rule : {DivideRule::cut_reciprocal, DivideRule::low_reciprocal})
        CHECK(compare_quotients(903, {.divide = rule}, DepthFormat::d24).wrong == 0);
    CHECK(compare_quotients(904, {.interpolant_bits = 18, .divide = DivideRule::low_reciprocal}, DepthFormat::d24)
              .wrong == 0);
}

TEST_CASE("with full double interpolants R is the true quotient of the vertex products within a relative 2^-45") {
    std::uint64_t fragments = 0, far = 0;
    for (const QuotientTriangle& t : random_quotient_triangles(905, 60, 4, 0xffffff)) {
        const RasterRules rules = buffer_rules({.interpolant_bits = full_double});
        for (const Fragment& f : draw(quotient_geometry({t}, rules, DepthFormat::d24),
                                      {DepthPath::perspective_rq, DepthFormat::d24}, quotient_needs)
                                     .fragments) {
            const std::array<Rational, 3> b = barycentric(t.setup.p, f.x, f.y, 4);
            std::array<Rational, 3> r, q;
            for (std::size_t i = 0; i < 3; ++i) {
                r[i] = Rational{t.r[i]} * Rational{t.setup.inverse_w[i]};
                q[i] = Rational{t.q[i]} * Rational{t.setup.inverse_w[i]};
            }
            const Rational exact = plane_value(b, r) / plane_value(b, q);
            far += abs(Rational{f.reference_z} - exact) > power(-45) * 0x1000000 ? 1 : 0;
            ++fragments;
        }
    }
    CHECK(fragments > 150);
    CHECK(far == 0);
}

TEST_CASE("depth replace stores the depth that perspective_rq compares and drops fragments outside of the depth range",
          "[slow]") {
    struct Case {
        DepthFormat format;
        RasterRules rules;
        double units;
    };
    for (const auto& [format, rules, units] :
         {Case{DepthFormat::d16, buffer_rules(), 65535.0}, Case{DepthFormat::d24, buffer_rules(), 16777215.0},
          Case{DepthFormat::d32f, {.subpixel_bits = 4}, 1.0}, Case{DepthFormat::d24, {.subpixel_bits = 4}, 1.0}}) {
        std::uint64_t kept = 0, dropped = 0, wrong = 0;
        for (const QuotientTriangle& t : random_quotient_triangles(906, 30, 4, units)) {
            const Geometry geometry = quotient_geometry({t}, rules, format);
            const DepthRequest replaced{DepthPath::depth_replace, format, DepthPath::perspective_rq};
            const auto stored = draw(geometry, replaced, quotient_needs).fragments;
            const auto coverage = draw(geometry, replaced, coverage_only).fragments;
            for (const Fragment& f : stored) wrong += f.code != f.reference_code ? 1 : 0;
            std::uint64_t inside = 0;
            const auto all = draw(geometry, {DepthPath::perspective_rq, format}, quotient_needs).fragments;
            for (const Fragment& f : all) {
                const float r = model_quotient(t, f, 4, {});
                inside += r >= 0 && double{r} <= units ? 1 : 0;
            }
            wrong += stored.size() != inside || coverage.size() != inside ? 1 : 0;
            kept += inside;
            dropped += all.size() - inside;
        }
        CHECK(kept > 300);
        CHECK(dropped > 10);
        CHECK(wrong == 0);
    }
}

TEST_CASE("with depth clamp a replaced depth outside the range is clamped and not dropped") {
    for (const QuotientTriangle& t : random_quotient_triangles(907, 20, 4, 65535)) {
        Geometry geometry = quotient_geometry({t}, buffer_rules(), DepthFormat::d16);
        geometry.state.depth_clamp = true;
        const auto replaced = draw(geometry, {DepthPath::depth_replace, DepthFormat::d16}, quotient_needs).fragments;
        CHECK(replaced == draw(geometry, {DepthPath::perspective_rq, DepthFormat::d16}, quotient_needs).fragments);
    }
}

TEST_CASE("a compared depth has the exact bits of the depth that a pass storing by that path would store", "[slow]") {
    constexpr std::array paths{DepthPath::window_z, DepthPath::perspective_rq, DepthPath::float32,
                               DepthPath::float32_plane, DepthPath::exact};
    for (const WindowZRule rule : {WindowZRule::chip, WindowZRule::exact, WindowZRule::float32}) {
        std::vector<QuotientTriangle> triangles = random_quotient_triangles(910, 40, 4, 0xffffff);
        const Geometry geometry = quotient_geometry(triangles, buffer_rules({.window_z = rule}), DepthFormat::d24);
        std::uint64_t pairs = 0, wrong = 0, unlike = 0;
        for (const DepthPath stored : paths)
            for (const DepthPath compared : paths) {
                const auto both = draw(geometry, {stored, DepthFormat::d24, compared}, quotient_needs).fragments;
                const auto alone = draw(geometry, {compared, DepthFormat::d24}, quotient_needs).fragments;
                for (std::size_t i = 0; i < both.size(); ++i) {
                    wrong +=
                        both[i].reference_code != alone[i].code || alone[i].reference_code != alone[i].code ? 1 : 0;
                    const auto floored = model_floor(Rational{both[i].reference_z}, 0xffffff);
                    unlike += floored != both[i].reference_code ? 1 : 0;
                }
                pairs += both.size();
            }
        CHECK(pairs > 15000);
        CHECK(wrong == 0);
        CHECK(unlike < pairs / 10000);  // for path exact, whose binary64 value may be on the other side of an integer
    }
}

TEST_CASE(
    "window_z from the exact plane is path exact and from binary32 the plane rounded once and then rounded down") {
    std::uint64_t fragments = 0, wrong = 0;
    for (const QuotientTriangle& t : random_quotient_triangles(911, 60, 4, 0xffffff)) {
        const auto by = [&](WindowZRule rule, DepthPath path) {
            return draw(quotient_geometry({t}, buffer_rules({.window_z = rule}), DepthFormat::d24),
                        {path, DepthFormat::d24}, quotient_needs)
                .fragments;
        };
        const auto exact = by(WindowZRule::exact, DepthPath::window_z), truth = by(WindowZRule::chip, DepthPath::exact);
        for (std::size_t i = 0; i < exact.size(); ++i) wrong += exact[i].code != truth[i].code ? 1 : 0;
        for (const Fragment& f : by(WindowZRule::float32, DepthPath::window_z)) {
            const float z = nearest_float(plane_value(barycentric(t.setup.p, f.x, f.y, 4), t.setup.z));
            wrong += f.code != model_floor(Rational{z}, 0xffffff) ? 1 : 0;
            ++fragments;
        }
    }
    CHECK(fragments > 150);
    CHECK(wrong == 0);
}

TEST_CASE("r and q are clipped with their vertex and drop a triangle if they are not finite over w") {
    RasterState state = scene_state(16, 16);
    TriangleSoup soup;
    soup.vertices = {
        {.x = -1, .y = -1, .z = 0, .w = 1}, {.x = 1, .y = -1, .z = 0, .w = 1}, {.x = 0, .y = 3, .z = 4, .w = 2}};
    soup.indices = {0, 1, 2};
    soup.runs = {{0, 3, 0, 0, true, false}};
    add_rq(soup, state, {});
    CHECK(soup.extras.values == std::vector<float>{0.5f, 1, 0.5f, 1, 3, 2});  // (z + w) / 2
    for (const ClipVolume volume : {ClipVolume::guard_band, ClipVolume::view_volume}) {
        const Geometry clipped = set_up(soup, state, {.clip = volume}, 1);  // clipped where z = w, at t = 1/3
        REQUIRE(clipped.counters.clipped == 1);
        REQUIRE(clipped.extras.values.size() == 2 * clipped.vertices.size());
        CHECK(clipped.vertices.size() > 3);
        for (std::size_t i = 0; i < clipped.vertices.size(); ++i) {
            const ClipVertex& v = clipped.vertices[i];
            CHECK(clipped.extras.of(i)[1] == Approx(v.w));
            CHECK(clipped.extras.of(i)[0] == Approx((v.z + v.w) / 2));
        }
    }
    soup.extras.values[0] = 0x1p120f;
    soup.vertices[0].w = 0x1p-20f;
    soup.vertices[0].x = soup.vertices[0].y = 0;
    CHECK(set_up(soup, state, {}, 1).counters.non_finite == 1);
}
