// Tests colours with unequal w against the rule of color_weights.h in rational arithmetic, with every rounding to 53
// bits and every truncation written out.
#include <catch2/catch.hpp>

#include "rasterizer/chip/color_weights.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr int shade_bits = 4;

// v >= 0 rounded to 53 bits, to nearest, ties to even.
[[nodiscard]] Rational to_53_bits(const Rational& v) {
    if (v == 0) return v;
    const Rational unit = power(floor_log2(v) - 52), scaled = v / unit;
    Integer code = floor(scaled);
    const Rational rest = scaled - Rational{code};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && (code & 1) != 0)) ++code;
    return Rational{code} * unit;
}

using Shares = std::array<Rational, 3>;

// Edge values at a centre: the value opposite each corner, in square subpixels.
[[nodiscard]] EdgeValues values_of_edges(const SetupTriangle& t, int x, int y) {
    const Shares b = barycentric(t.p, x, y, shade_bits);
    EdgeValues e{};
    for (std::size_t i = 0; i < 3; ++i)
        e[i] = Integer{numerator(Rational{b[i] * Rational{abs(doubled_area(t.p[0], t.p[1], t.p[2]))}})}
                   .convert_to<std::int64_t>();
    return e;
}

// The chip's reciprocal r of the sum as binary64: slightly low unless the sum is a power of two, truncated to 29 bits.
[[nodiscard]] Rational low_reciprocal(const Rational& sum) {
    const Rational held = to_53_bits(sum), exact = to_53_bits(Rational{1} / held);
    return held == power(floor_log2(held)) ? exact : truncate_to_bits(to_53_bits(exact * (1 - power(-31))), 29);
}

// By the rule of the w buffer, with every step truncated.
[[nodiscard]] Shares cut_shares_of(const EdgeValues& e, const std::array<float, 3>& w) {
    Shares p;
    int largest = -9999;
    for (std::size_t i = 0; i < 3; ++i) {
        p[i] = truncate_to_bits(Rational{e[i]}, 24) * truncate_to_bits(Rational{1} / Rational{w[i]}, 24);
        if (p[i] != 0) largest = std::max(largest, floor_log2(p[i]));
    }
    // Complete products, aligned to 29 bits of the largest, are added; the weights use 25 bits of each.
    Rational sum{0};
    for (const Rational& each : p) sum += Rational{floor(Rational{each / power(largest - 28)})} * power(largest - 28);
    const Rational r = low_reciprocal(sum);
    for (Rational& each : p) each = truncate_to_bits(truncate_to_bits(each, 25) * r, 24);
    return p;
}

[[nodiscard]] Shares perspective_shares(const EdgeValues& e, const std::array<float, 3>& w,
                                        const std::array<float, 3>& inverse_w, PerspectiveColor rule) {
    if (rule == PerspectiveColor::cut_products) return cut_shares_of(e, w);
    const bool by_weights = rule == PerspectiveColor::weight_products;
    Shares cut;
    for (std::size_t i = 0; i < 3; ++i) cut[i] = truncate_to_bits(Rational{e[i]}, 24);
    const Rational reciprocal = low_reciprocal(cut[0] + cut[1] + cut[2]);
    Shares p;
    for (std::size_t i = 0; i < 3; ++i) {
        p[i] = Rational{e[i]};
        if (by_weights) p[i] = truncate_to_bits(cut[i] * reciprocal, 24);
        p[i] = to_53_bits(p[i] * Rational{inverse_w[i]});
        if (by_weights) p[i] = truncate_to_bits(p[i], 24);
    }
    Rational r = to_53_bits(Rational{1} / to_53_bits(to_53_bits(p[0] + p[1]) + p[2]));
    if (by_weights) r = truncate_to_bits(r, 28);
    for (Rational& each : p) each = truncate_to_bits(to_53_bits(each * r), 24);
    return p;
}

// The vertex that takes the remainder to 1: that of the largest exponent.
[[nodiscard]] std::size_t vertex_of_the_rest(const Shares& b) {
    std::array<int, 3> exponent;
    for (std::size_t i = 0; i < 3; ++i) exponent[i] = b[i] == 0 ? -9999 : floor_log2(b[i]);
    const int largest = std::max({exponent[0], exponent[1], exponent[2]});
    const bool has0 = exponent[0] == largest, has1 = exponent[1] == largest, has2 = exponent[2] == largest;
    if (has0 && has1 && has2) return 2;
    if (has0 && has1) return 0;
    if (has0 && has2) return 2;
    if (has1 && has2) return 1;
    return has0 ? 0 : has1 ? 1 : 2;
}

[[nodiscard]] std::array<int, 4> shaded(const SetupTriangle& t, Shares b, int leading_bits) {
    const std::size_t rest = vertex_of_the_rest(b);
    b[rest] = 1 - b[(rest + 1) % 3] - b[(rest + 2) % 3];
    const Integer w0 = floor(256 * b[0]), w2 = floor(256 * b[2]), w1 = 256 - w0 - w2;
    std::array<int, 4> codes;
    for (std::size_t c = 0; c < 4; ++c) {
        std::array<Integer, 3> v;
        for (std::size_t i = 0; i < 3; ++i)
            v[i] = floor(truncate_to_bits(Rational{t.attribute[i][c]}, leading_bits) * 255 + Rational{1, 2});
        codes[c] = floor(Rational{w0 * v[0] + w1 * v[1] + w2 * v[2] + 128, 256}).convert_to<int>();
    }
    return codes;
}

[[nodiscard]] std::array<float, 3> w_of(const std::array<float, 3>& inverse_w) {
    return {1.0f / inverse_w[0], 1.0f / inverse_w[1], 1.0f / inverse_w[2]};
}

[[nodiscard]] SetupTriangle colored_triangle(Random& random, int n) {
    while (true) {
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 14, 14, shade_bits, n % 3 == 0 ? 2000 : 3);
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        SetupTriangle t = window_triangle(p, shade_bits);
        for (std::size_t i = 0; i < 3; ++i) {
            t.inverse_w[i] = random_float(random, 0.05f, 4);
            t.w[i] = 1.0f / t.inverse_w[i];
            for (float& u : t.attribute[i]) u = random_float(random, 0, 1);
        }
        if (n % 4 == 0)
            t.inverse_w[1] = t.inverse_w[0], t.w[1] = t.w[0];  // two of three are equal, which still counts as unequal
        return t;
    }
}

}  // namespace

TEST_CASE("with unequal w colours are weighted by products with 1/w that are truncated or rounded as specified",
          "[slow]") {
    for (const PerspectiveColor rule :
         {PerspectiveColor::edge_products, PerspectiveColor::weight_products, PerspectiveColor::cut_products}) {
        Random random{651};
        std::uint64_t fragments = 0, wrong = 0;
        for (int n = 0; n < 45; ++n) {
            const SetupTriangle t = colored_triangle(random, n);
            RasterRules rules{.subpixel_bits = shade_bits, .color = ColorInterpolation::weights_8bit};
            rules.interpolation.perspective_color = rule;
            rules.interpolation.vertex_color_bits = n % 2 == 0 ? 14 : 24;
            for (const Fragment& f : draw(window_geometry({t}, 14, 14, rules), {}, everything).fragments) {
                const auto expected = shaded(
                    t, perspective_shares(values_of_edges(t, f.x, f.y), t.w, t.inverse_w, rule), n % 2 == 0 ? 14 : 24);
                ++fragments;
                for (std::size_t c = 0; c < 4; ++c)
                    wrong += f.color[c] != static_cast<float>(expected[c]) / 255.0f ? 1 : 0;
            }
        }
        CHECK(fragments > 800);
        CHECK(wrong == 0);
    }
}

TEST_CASE("weights at or next to a multiple of 1/256 fall on the correct side for any rule of products", "[slow]") {
    // Edge values whose products with 1/w are k / 256 of their sum, which is `odd` times a power of two, so r is
    // inexact.
    std::uint64_t wrong = 0, cases = 0, unlike = 0, not_whole = 0;
    for (const std::int64_t odd : {3, 7, 13, 1021, 65537})
        for (const auto& inverse_w :
             {std::array{1.0f, 2.0f, 4.0f}, std::array{4.0f, 1.0f, 1.0f}, std::array{0.5f, 0.75f, 1.5f}})
            for (int k0 = 1; k0 < 256; k0 += 9)
                for (int k2 = 1; k0 + k2 < 256; k2 += 13) {
                    const std::array<int, 3> k{k0, 256 - k0 - k2, k2};
                    EdgeValues e{};
                    for (std::size_t i = 0; i < 3; ++i)
                        e[i] = static_cast<std::int64_t>(static_cast<double>(12 * odd * k[i]) / inverse_w[i]);
                    std::array<std::array<std::int32_t, 3>, 3> found;
                    for (const PerspectiveColor rule :
                         {PerspectiveColor::edge_products, PerspectiveColor::weight_products,
                          PerspectiveColor::cut_products}) {
                        Shares b = perspective_shares(e, w_of(inverse_w), inverse_w, rule);
                        const std::size_t rest = vertex_of_the_rest(b);
                        b[rest] = 1 - b[(rest + 1) % 3] - b[(rest + 2) % 3];
                        auto& w = found[static_cast<std::size_t>(rule)];
                        w = ColorWeights{w_of(inverse_w), inverse_w, e[0] + e[1] + e[2], {}, rule}.at(e);
                        ++cases;
                        wrong += Integer{w[0]} != floor(256 * b[0]) || Integer{w[2]} != floor(256 * b[2]) ||
                                         w[0] + w[1] + w[2] != 256
                                     ? 1
                                     : 0;
                        not_whole += w[0] != k0 || w[2] != k2 ? 1 : 0;
                    }
                    unlike += found[0] != found[1] ? 1 : 0;
                }
    CHECK(wrong == 0);
    CHECK(cases > 3000);
    CHECK(unlike > cases / 20);
    CHECK(not_whole > cases / 20);
}

// The upper side of Depth_buffer_fixed_function's wide quad (rasterizer/reference/chip-geometry.md 5.4) passes through
// pixel centres between two corners of w = 135.666...; at every third pixel 256 b is an integer. The capture has these
// codes of green and blue there.
TEST_CASE("weights that are integers on a side of equal w give the codes of the capture") {
    const std::array<float, 3> w{386.0f / 3.0f + 7.0f, 386.0f / 3.0f + 7.0f, 200.0f};
    const std::array<float, 3> inverse{1.0f / w[0], 1.0f / w[1], 1.0f / w[2]};
    constexpr std::int64_t side = 384, area = side * side * 256;
    const ColorWeights weights{w, inverse, area, DepthHypothesis{}, PerspectiveColor::cut_products};
    int wrong = 0, whole = 0;
    for (std::int64_t x = 1; x < side; ++x) {
        if (256 * x % side != 0) continue;
        ++whole;
        const auto at = static_cast<std::int32_t>(256 * x / side);  // weight of the second corner
        // If the second corner's weight is the greater one, that corner takes the remainder, and the first one's weight
        // is truncated.
        const std::array<std::int32_t, 3> seen =
            2 * x <= side ? std::array{256 - at, at, 0} : std::array{255 - at, at + 1, 0};
        wrong += weights.at({(side - x) * side * 256, x * side * 256, 0}) != seen ? 1 : 0;
    }
    CHECK(whole == 127);
    CHECK(wrong == 0);
}

TEST_CASE("a vertex colour keeps as many leading bits as the hypothesis says and the rest is truncated before 8 bits",
          "[slow]") {
    Random random{653};
    std::uint64_t wrong = 0;
    for (int n = 0; n < 4000; ++n) {
        const float c = n % 3 == 0 ? random_float(random, 0, 0x1p-6f) : random_float(random, 0, 1);
        for (int leading = 9; leading <= 24; ++leading) {
            const Integer code = floor(truncate_to_bits(Rational{c}, leading) * 255 + Rational{1, 2});
            wrong += Integer{to_color_code(c, leading)} != code ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    for (const int leading : {9, 14, 24}) {
        CHECK(to_color_code(1.0f, leading) == 255);
        CHECK(to_color_code(0.0f, leading) == 0);
        CHECK(to_color_code(std::numeric_limits<float>::quiet_NaN(), leading) == 0);
        CHECK(to_color_code(std::numeric_limits<float>::infinity(), leading) == 255);
    }
}
