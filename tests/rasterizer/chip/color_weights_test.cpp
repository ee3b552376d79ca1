// Tests the colour weights of the NV2A against rasterizer/reference/attributes.md 2.2, 2.4 and the remainder rule of
// rasterizer/reference/attributes.md 2.3 in rational arithmetic.
#include "rasterizer/chip/color_weights.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr int bits = 4;
constexpr RasterRules weights_rules{.subpixel_bits = bits, .color = ColorInterpolation::weights_8bit};
constexpr FragmentNeeds colors{false, false, false, true, false, false};

// The vertex that takes the remainder: the one of the largest exponent; the ties of section 3 as a table of the
// vertices that share it.
[[nodiscard]] std::size_t remainder_vertex(const std::array<Rational, 3>& b) {
    std::array<int, 3> exponent;
    for (std::size_t i = 0; i < 3; ++i) exponent[i] = b[i] == 0 ? -100000 : floor_log2(b[i]);
    const int largest = std::max({exponent[0], exponent[1], exponent[2]});
    const int shared =
        (exponent[0] == largest ? 1 : 0) | (exponent[1] == largest ? 2 : 0) | (exponent[2] == largest ? 4 : 0);
    constexpr std::array<std::size_t, 8> table{9, 0, 1, 0, 2, 2, 1, 2};
    return table[static_cast<std::size_t>(shared)];
}

[[nodiscard]] std::array<int, 4> model_color(const SetupTriangle& t, int x, int y, bool exact_weights) {
    std::array<Rational, 3> b = barycentric(t.p, x, y, bits);
    Rational area{abs(doubled_area(t.p[0], t.p[1], t.p[2]))};
    if (!exact_weights) {
        for (Rational& w : b) w = truncate_to_bits(w * area, 24);
        const Rational sum = b[0] + b[1] + b[2];
        const bool is_power = sum == power(floor_log2(sum));
        const Rational r = truncate_to_bits((is_power ? Rational{1} : 1 - power(-31)) / sum, 29);
        for (Rational& w : b) w = truncate_to_bits(w * r, 24);
        const std::size_t rest = remainder_vertex(b);
        b[rest] = 1 - b[(rest + 1) % 3] - b[(rest + 2) % 3];
    }
    const Integer w0 = floor(256 * b[0]), w2 = floor(256 * b[2]), w1 = 256 - w0 - w2;
    std::array<int, 4> result;
    for (std::size_t c = 0; c < 4; ++c) {
        std::array<Integer, 3> code;
        for (std::size_t i = 0; i < 3; ++i) code[i] = floor(Rational{t.attribute[i][c]} * 255 + Rational{1, 2});
        result[c] = floor(Rational{w0 * code[0] + w1 * code[1] + w2 * code[2] + 128, 256}).convert_to<int>();
    }
    return result;
}

[[nodiscard]] std::array<int, 4> codes_of(const Fragment& f) {
    std::array<int, 4> c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = floor(Rational{f.color[i]} * 255 + Rational{1, 2}).convert_to<int>();
    return c;
}

void set_color(SetupTriangle& t, std::size_t corner, std::array<float, 4> color) {
    std::ranges::copy(color, t.attribute[corner].begin());
}

}  // namespace

TEST_CASE("vertex colours are rounded to 8 bits before they are interpolated") {
    CHECK(to_color_code(0.5f) == 128);
    CHECK(to_color_code(1.5f / 255) == 2);
    CHECK(to_color_code(-0.25f) == 0);
    CHECK(to_color_code(2.0f) == 255);
    std::uint64_t wrong = 0;
    for (int k = 0; k <= 255; ++k) wrong += to_color_code(static_cast<float>(k) / 255.0f) != k ? 1 : 0;
    CHECK(wrong == 0);
}

// Greys of suite Depth_buffer on an NV2A, and 0.1 and 0.3 of other suites: the given value and the resulting code.
TEST_CASE("the code of a vertex colour depends on its 14 leading bits as in the captures") {
    constexpr std::pair<float, int> measured[] = {
        {0.1f, 25},           {0.3f, 76},           {0.5000001788f, 128}, {0.8725491166f, 222}, {0.8960894346f, 228},
        {0.9706394076f, 247}, {0.5980809330f, 152}, {0.8765106201f, 223}, {0.2921687067f, 74},  {0.3862950206f, 99},
        {0.4098265171f, 105}, {0.8059088168f, 206}, {0.8529711962f, 218}, {0.2725903690f, 70}};
    int wrong_with_13 = 0, wrong_with_15 = 0, wrong_with_all = 0;
    for (const auto& [color, code] : measured) {
        CHECK(to_color_code(color, 14) == code);
        wrong_with_13 += to_color_code(color, 13) != code;
        wrong_with_15 += to_color_code(color, 15) != code;
        wrong_with_all += to_color_code(color) != code;
    }
    CHECK(wrong_with_13 > 0);
    CHECK(wrong_with_15 > 0);
    CHECK(wrong_with_all > 0);
}

TEST_CASE("where the area is 256 edge values are the weights by the area's reciprocal for any remainder vertex") {
    const DepthHypothesis by_area{.weights = WeightRule::area, .reciprocal_bits = 28};
    const ColorWeights weights{{1, 1, 1}, {1, 1, 1}, 256, by_area, PerspectiveColor::edge_products};
    CHECK(weights.at({127, 129, 0}) == std::array{127, 129, 0});
    std::uint64_t wrong = 0;
    for (std::int32_t e0 = 0; e0 <= 256; ++e0)
        for (std::int32_t e1 = 0; e1 <= 256 - e0; ++e1) {
            const std::int32_t e2 = 256 - e0 - e1;
            wrong += weights.at({e0, e1, e2}) != std::array{e0, e1, e2} ? 1 : 0;
        }
    CHECK(wrong == 0);
}

TEST_CASE("interpolated colours are the 8-bit weights of the captures for triangles of every shape and winding",
          "[slow]") {
    constexpr std::uint64_t seed = 51;
    Random random{seed};
    std::uint64_t fragments = 0, wrong = 0, not_a_code = 0;
    for (int n = 0; n < 250; ++n) {
        std::array<SubpixelPoint, 3> p;
        const int outside = n % 4 == 0 ? 30000 : (n % 4 == 1 ? 300 : 2);
        for (SubpixelPoint& c : p) c = random_point(random, 14, 14, bits, outside);
        if (n % 5 == 0)  // corners at multiples of a pixel, so that weights tie
            for (SubpixelPoint& c : p) c = {random_int(random, 0, 14) * 16 + 8, random_int(random, 0, 14) * 16 + 8};
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        SetupTriangle t = window_triangle(p, bits);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto c = [&] { return random_float(random, 0, 1); };
            set_color(t, i, {c(), c(), c(), c()});
        }
        for (const Fragment& f : draw(window_geometry({t}, 14, 14, weights_rules), {}, colors).fragments) {
            ++fragments;
            const std::array<int, 4> found = codes_of(f);
            wrong += found != model_color(t, f.x, f.y, false) ? 1 : 0;
            for (std::size_t c = 0; c < 4; ++c)
                not_a_code += f.color[c] != static_cast<float>(found[c]) / 255.0f ? 1 : 0;
        }
    }
    INFO("seed " << seed << ", fragments " << fragments);
    CHECK(fragments > 5000);
    CHECK(wrong == 0);
    CHECK(not_a_code == 0);
}

TEST_CASE("a captured quad differs from exact weights at as many pixels as on the hardware", "[slow]") {
    // Color_mask_blend, second quad (rasterizer/reference/chip-depth.md 3.1): 374 of 8,520 pixels.
    const int x0 = 213 * 16, x1 = (213 + 71) * 16, y0 = 180 * 16, y1 = 300 * 16;
    SetupTriangle upper = window_triangle({{{x0, y0}, {x1, y0}, {x1, y1}}}, bits);
    SetupTriangle lower = window_triangle({{{x0, y0}, {x1, y1}, {x0, y1}}}, bits);
    const std::array<float, 4> red{1, 0, 0, 1}, green{0, 1, 0, 1}, blue{0, 0, 1, 1}, grey{.5f, .5f, .5f, 1};
    set_color(upper, 0, red);
    set_color(upper, 1, grey);
    set_color(upper, 2, blue);
    set_color(lower, 0, red);
    set_color(lower, 1, blue);
    set_color(lower, 2, green);
    std::uint64_t fragments = 0, differ = 0;
    for (const SetupTriangle& t : {upper, lower})
        for (const Fragment& f : draw(window_geometry({t}, 640, 480, weights_rules), {}, colors).fragments) {
            ++fragments;
            differ += codes_of(f) != model_color(t, f.x, f.y, true) ? 1 : 0;
        }
    CHECK(fragments == 8520);
    CHECK(differ == 374);
}

TEST_CASE("with unequal w the weights are perspective-correct within 1/256") {
    Random random{52};
    std::uint64_t fragments = 0, wrong = 0;
    for (int n = 0; n < 100; ++n) {
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 14, 14, bits, 2);
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        const auto w = [&] { return random_float(random, 0.1f, 3); };
        SetupTriangle t = window_triangle(p, bits, {}, {w(), w(), w()});
        set_color(t, 0, {1, 0, 0, 1});
        set_color(t, 1, {0, 1, 0, 1});
        set_color(t, 2, {0, 0, 1, 1});
        for (const Fragment& f : draw(window_geometry({t}, 14, 14, weights_rules), {}, colors).fragments) {
            const std::array<Rational, 3> b = barycentric(p, f.x, f.y, bits);
            const Rational sum = plane_value(b, t.inverse_w);
            ++fragments;
            for (std::size_t i = 0; i < 3; ++i) {
                const Rational exact = b[i] * Rational{t.inverse_w[i]} / sum;
                wrong +=
                    // two truncations of 1/256 and a rounding
                    abs(Rational{f.color[i]} - exact) > Rational{5, 512} ? 1 : 0;
            }
            wrong += f.color[3] != 1.0f ? 1 : 0;
        }
    }
    CHECK(fragments > 1000);
    CHECK(wrong == 0);
}
