// Tests the NV2A's window z against a second implementation of rasterizer/reference/depth.md 4.4 in rational
// arithmetic, and against the counts of differing pixels in hardware captures of one scene
// (rasterizer/reference/chip-depth.md 2).
#include "rasterizer/chip/window_z.h"

#include <bit>
#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr int window_bits = 4;

// The weights, by a reciprocal without the two roundings to binary64 that precede its truncation.
[[nodiscard]] std::array<Rational, 3> model_weights(const std::array<Rational, 3>& e, const DepthHypothesis& h) {
    std::array<Rational, 3> b = e;
    if (h.weights == WeightRule::cut_edges)
        for (Rational& each : b) each = truncate_to_bits(each, 24);
    const Rational sum = b[0] + b[1] + b[2];  // for WeightRule::area it is the area
    const Rational low = h.weights == WeightRule::area || sum == power(floor_log2(sum))
                             ? Rational{1}
                             : 1 - h.reciprocal_deficit * power(-32);
    const Rational r = truncate_to_bits(low / sum, h.reciprocal_bits);
    for (Rational& each : b) each = truncate_to_bits(each * r, 24);
    return b;
}

// The sum, before it is truncated to 24 bits.
[[nodiscard]] Rational model_sum(const std::array<SubpixelPoint, 3>& p, const std::array<float, 3>& z, int x, int y,
                                 int subpixel_bits, const DepthHypothesis& h = {}) {
    std::array<Rational, 3> e = barycentric(p, x, y, subpixel_bits);
    std::array<int, 3> k;
    for (std::size_t i = 0; i < 3; ++i) {
        e[i] *= Rational{abs(doubled_area(p[0], p[1], p[2]))};
        k[i] = e[i] == 0 ? -1 : floor_log2(e[i]);
    }
    const std::array<Rational, 3> b = model_weights(e, h);
    const std::size_t reference = k[1] >= k[0] && k[1] >= k[2] ? 1 : (k[0] >= k[2] ? 0 : 2);
    const auto flushed = [](const Rational& v) { return abs(v) < power(-126) ? Rational{0} : v; };
    const Rational base = flushed(Rational{z[reference]});
    std::array<Rational, 3> product;
    int largest = base == 0 ? -100000 : floor_log2(abs(base));
    for (std::size_t i = 0; i < 3; ++i) {
        if (i == reference) continue;
        product[i] = b[i] * flushed(flushed(Rational{z[i]}) - base);
        if (product[i] != 0) largest = std::max(largest, floor_log2(abs(product[i])));
    }
    Rational sum = base;
    for (std::size_t i = 0; i < 3; ++i)
        if (i != reference && product[i] != 0) sum += truncate(product[i], largest - (h.sum_bits - 1));
    return sum;
}

[[nodiscard]] Integer model_window_z(const std::array<SubpixelPoint, 3>& p, const std::array<float, 3>& z, int x, int y,
                                     int subpixel_bits, const DepthHypothesis& h = {}) {
    return floor(truncate_to_bits(model_sum(p, z, x, y, subpixel_bits, h), 24));
}

[[nodiscard]] Geometry geometry_of(const std::vector<SetupTriangle>& triangles, int width, int height,
                                   DepthFormat format, int subpixel_bits = window_bits) {
    const RasterRules rules{
        .subpixel_bits = subpixel_bits, .window_z = WindowZ::buffer_units, .depth_rounding = DepthRounding::floor};
    Geometry geometry = window_geometry(triangles, width, height, rules);
    geometry.state.depth_format = format;
    return geometry;
}

struct Corner {
    int x, y;
    double z;
};

// A quad's two triangles as in the captures: (UL,UR,LR) and (UL,LR,LL).
[[nodiscard]] std::array<SetupTriangle, 2> quad(Corner ul, Corner ur, Corner lr, Corner ll) {
    const auto triangle = [](Corner a, Corner b, Corner c) {
        return window_triangle({{{a.x * 16, a.y * 16}, {b.x * 16, b.y * 16}, {c.x * 16, c.y * 16}}}, window_bits,
                               {a.z, b.z, c.z});
    };
    return {triangle(ul, ur, lr), triangle(ul, lr, ll)};
}

struct Difference {
    std::uint64_t fragments = 0, from_exact = 0, from_model = 0, beyond_one = 0;
};

[[nodiscard]] Difference differences(const SetupTriangle& t, DepthFormat format, bool with_model, int width = 640,
                                     int height = 480, int subpixel_bits = window_bits) {
    const Geometry geometry = geometry_of({t}, width, height, format, subpixel_bits);
    Difference d;
    const std::array<float, 3> z{static_cast<float>(t.z[0]), static_cast<float>(t.z[1]), static_cast<float>(t.z[2])};
    const FragmentNeeds codes{false, true, true, false, false, false};
    for (const Fragment& f : draw(geometry, {DepthPath::window_z, format}, codes).fragments) {
        ++d.fragments;
        d.from_exact += f.code != f.exact_code ? 1 : 0;
        d.beyond_one += f.code > f.exact_code + 1 || f.code + 1 < f.exact_code ? 1 : 0;
        if (!with_model) continue;
        const Integer max = format == DepthFormat::d16 ? 0xffff : 0xffffff;
        const Integer model = std::clamp(model_window_z(t.p, z, f.x, f.y, subpixel_bits), Integer{0}, max);
        d.from_model += Integer{f.code} != model ? 1 : 0;
    }
    return d;
}

constexpr std::array bottom_strip_z{12582910.0, 0.0};
constexpr std::array right_strip_z{1.0, 8388607.0};

}  // namespace

TEST_CASE("the strips of the captured scene differ from floor of exact at just as many pixels as on the hardware") {
    const auto [l, r] = bottom_strip_z;
    const auto bottom = quad({132, 430, l}, {492, 430, r}, {492, 435, r}, {132, 435, l});
    CHECK(differences(bottom[0], DepthFormat::d24, false).from_exact == 168);  // chip-depth.md 3.1, of 900 each
    CHECK(differences(bottom[1], DepthFormat::d24, false).from_exact == 182);
    const auto [top, low] = right_strip_z;
    const auto right = quad({502, 45, top}, {510, 45, top}, {510, 435, low}, {502, 435, low});
    CHECK(differences(right[0], DepthFormat::d24, false).from_exact == 178);  // of 1,560 each
    CHECK(differences(right[1], DepthFormat::d24, false).from_exact == 210);
}

TEST_CASE(
    "on the captured large quad the rule and floor of exact agree at 90 to 97 of 100 pixels and differ by at most 1") {
    const auto large =
        quad({128, 40, 11184809.0}, {512, 40, 11184809.0}, {512, 440, 16777214.0}, {128, 440, 16777214.0});
    for (const SetupTriangle& t : large) {
        const Difference d = differences(t, DepthFormat::d24, false);
        CHECK(d.fragments == 76800u);
        CHECK(d.from_exact > d.fragments * 3 / 100);
        CHECK(d.from_exact < d.fragments * 10 / 100);
        CHECK(d.beyond_one == 0);
    }
}

TEST_CASE("small quads of the captured grid are floor of exact because their weights are dyadic") {
    Random random{41};
    std::uint64_t wrong = 0;
    for (int n = 0; n < 300; ++n) {
        const int x = random_int(random, 0, 600), y = random_int(random, 0, 440);
        const double left = random_int(random, 0, 16777215), right = random_int(random, 0, 16777215);
        for (const SetupTriangle& t : quad({x, y, left}, {x + 8, y, right}, {x + 8, y + 8, right}, {x, y + 8, left}))
            wrong += differences(t, DepthFormat::d24, false).from_exact;
    }
    CHECK(wrong == 0);
}

TEST_CASE("in the depth of a whole scene about 97 of 100 codes equal floor of exact at 24 bits", "[slow]") {
    Random random{42};
    Difference sum;
    for (int n = 0; n < 40; ++n) {  // triangles whose depths differ by a part of the range, as in a scene
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 640, 480, window_bits);
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        const double base = random_int(random, 0, 14000000);
        const auto z = [&] { return base + random_int(random, 0, 2000000); };
        const Difference d = differences(window_triangle(p, window_bits, {z(), z(), z()}), DepthFormat::d24, false);
        sum.fragments += d.fragments;
        sum.from_exact += d.from_exact;
    }
    INFO(sum.from_exact << " of " << sum.fragments);
    CHECK(sum.from_exact * 1000 > sum.fragments * 5);
    CHECK(sum.from_exact * 1000 < sum.fragments * 60);
}

TEST_CASE("D16 by the rule equals floor of exact on the captured quads") {
    const std::array<std::array<SetupTriangle, 2>, 3> quads{
        quad({132, 430, 49150.0}, {492, 430, 0.0}, {492, 435, 0.0}, {132, 435, 49150.0}),
        quad({502, 45, 1.0}, {510, 45, 1.0}, {510, 435, 32767.0}, {502, 435, 32767.0}),
        quad({128, 40, 43689.0}, {512, 40, 43689.0}, {512, 440, 65534.0}, {128, 440, 65534.0})};
    std::uint64_t fragments = 0, wrong = 0;
    for (const auto& q : quads)
        for (const SetupTriangle& t : q) {
            const Difference d = differences(t, DepthFormat::d16, false);
            fragments += d.fragments;
            wrong += d.from_exact;
        }
    CHECK(fragments == 153600u + 1800 + 3120);
    CHECK(wrong == 0);
}

TEST_CASE("window_z is the rule of the captures for triangles of every shape and winding and depth", "[slow]") {
    constexpr std::uint64_t seed = 43;
    Random random{seed};
    Difference sum;
    for (int n = 0; n < 400; ++n) {
        const int subpixel_bits = n % 8 == 7 ? 12 : window_bits;
        const int outside = n % 4 == 3 ? 30000 : (n % 4 == 2 ? 500 : 4);
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 12, 12, subpixel_bits, outside);
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        const auto z = [&]() -> double {
            switch (random_int(random, 0, 5)) {
                case 0: return 0.0;
                case 1: return random_float(random, 0, 0x1p-30f);
                case 2: return random_float(random, 0, 1);
                case 3: return random_int(random, 0, 16777215);
                case 4: return random_float(random, -20, 3);
                default: return random_float(random, 0, 16777215);
            }
        };
        const Difference d = differences(window_triangle(p, subpixel_bits, {z(), z(), z()}), DepthFormat::d24, true, 12,
                                         12, subpixel_bits);
        sum.fragments += d.fragments;
        sum.from_model += d.from_model;
    }
    INFO("seed " << seed << ", fragments " << sum.fragments);
    CHECK(sum.fragments > 3000);
    CHECK(sum.from_model == 0);
}

// A constant expression must not shift by more than an integer's width.
static_assert(WindowZ24{{0.0, 0.0, 0x1p-100}, 256}.value({64, 128, 64}) == 0x1p-102);
static_assert(WindowZ24{{0.0, 0x1p-140, 0.0}, 256}.value({128, 64, 64}) == 0.0);  // values below the normal range are 0
static_assert(WindowZ24{{-0x1p-120, 0.0, 0.0}, 256}.value({64, 128, 64}) == -0x1p-122);

TEST_CASE("where two corners have depth 0 the sum is the rule's for any small depth of the third one", "[slow]") {
    constexpr std::uint64_t seed = 46;
    Random random{seed};
    std::uint64_t fragments = 0, wrong = 0;
    for (int n = 0; n < 120; ++n) {
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 12, 12, window_bits, 40);
        if (doubled_area(p[0], p[1], p[2]) <= 0) std::swap(p[1], p[2]);
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        std::array<float, 3> z{};
        const int exponent = random_int(random, -126, 23);
        z[static_cast<std::size_t>(n % 3)] = random_float(random, -2, 2) * std::bit_cast<float>((exponent + 127) << 23);
        const TriangleEdges edges{p, TieRule::top_left};
        const WindowZ24 rule{{z[0], z[1], z[2]}, edges.area()};
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x) {
                const EdgeValues e = edges.at(pixel_centre(x, y, window_bits));
                if (std::min({e[0], e[1], e[2]}) < 0) continue;
                wrong += Rational{rule.value(e)} != truncate_to_bits(model_sum(p, z, x, y, window_bits), 24) ? 1 : 0;
                ++fragments;
            }
    }
    INFO("seed " << seed << ", fragments " << fragments);
    CHECK(fragments > 2000);
    CHECK(wrong == 0);
}

TEST_CASE("GeForce3 depth depends on the order of a triangle's vertices") {
    const std::array<SubpixelPoint, 3> p{{{128 * 16, 40 * 16}, {512 * 16, 40 * 16}, {512 * 16, 440 * 16}}};
    const std::array z{11184809.0, 11184809.0, 16777214.0};
    const FragmentNeeds codes{false, true, false, false, false, false};
    const auto drawn = [&](std::size_t a, std::size_t b, std::size_t c) {
        const SetupTriangle t = window_triangle({p[a], p[b], p[c]}, window_bits, {z[a], z[b], z[c]});
        return draw(geometry_of({t}, 640, 480, DepthFormat::d24), {DepthPath::window_z, DepthFormat::d24}, codes)
            .fragments;
    };
    const auto first = drawn(0, 1, 2), turned = drawn(1, 2, 0);
    REQUIRE(first.size() == turned.size());
    CHECK(first != turned);
}

TEST_CASE("every other rule of the depth sum changes many codes as its hypothesis says", "[slow]") {
    Random random{45};
    constexpr auto area = WeightRule::area, cut_edges = WeightRule::cut_edges;
    for (const DepthHypothesis& varied : {DepthHypothesis{.weights = area, .reciprocal_bits = 28},
                                          DepthHypothesis{.weights = area, .reciprocal_bits = 24},
                                          DepthHypothesis{.weights = area, .reciprocal_bits = 30},
                                          DepthHypothesis{.weights = area, .reciprocal_bits = 26, .sum_bits = 26},
                                          DepthHypothesis{.weights = cut_edges, .reciprocal_bits = 24},
                                          DepthHypothesis{.weights = cut_edges, .reciprocal_deficit = 8},
                                          DepthHypothesis{.weights = cut_edges, .sum_bits = 24}}) {
        std::uint64_t fragments = 0, wrong = 0, changed = 0;
        for (int n = 0; n < 12; ++n) {
            std::array<SubpixelPoint, 3> p;
            for (SubpixelPoint& c : p) c = random_point(random, 24, 24, window_bits, 200);
            if (doubled_area(p[0], p[1], p[2]) <= 0) std::swap(p[1], p[2]);
            if (doubled_area(p[0], p[1], p[2]) == 0) continue;
            std::array<float, 3> z;
            for (float& each : z) each = random_float(random, 8388608.0f, 16777215.0f);
            const SetupTriangle t = window_triangle(p, window_bits, {z[0], z[1], z[2]});
            Geometry geometry = geometry_of({t}, 24, 24, DepthFormat::d24);
            const auto given = draw(geometry, {DepthPath::window_z, DepthFormat::d24}, {.color = false}).fragments;
            geometry.rules.hypothesis = varied;
            const auto found = draw(geometry, {DepthPath::window_z, DepthFormat::d24}, {.color = false}).fragments;
            for (std::size_t i = 0; i < found.size(); ++i) {
                const Integer model = model_window_z(p, z, found[i].x, found[i].y, window_bits, varied);
                wrong += Integer{found[i].code} != model ? 1 : 0;
                changed += found[i].code != given[i].code ? 1 : 0;
            }
            fragments += found.size();
        }
        INFO(varied.reciprocal_bits << " and " << varied.sum_bits << " bits, " << fragments << " fragments");
        CHECK(fragments > 500);
        CHECK(wrong == 0);
        CHECK((changed > 0 || varied.reciprocal_bits >= 27));
    }
}
