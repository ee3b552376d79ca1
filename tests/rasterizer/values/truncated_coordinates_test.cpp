// Tests texture coordinates by truncated weights against the rule of truncated_coordinates.h in rational arithmetic;
// the remainder of rasterizer/reference/attributes.md 2.3 is a table of ties.
#include "rasterizer/values/truncated_coordinates.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr int bits = 4;
constexpr int nowhere = -100000;  // stands in for the exponent of 0

[[nodiscard]] int exponent(const Rational& v) { return v == 0 ? nowhere : floor_log2(abs(v)); }

[[nodiscard]] std::array<Rational, 3> cut_shares(const std::array<SubpixelPoint, 3>& p, int x, int y) {
    std::array<Rational, 3> b = barycentric(p, x, y, bits);
    const Rational area{abs(doubled_area(p[0], p[1], p[2]))};
    Rational sum;
    for (Rational& share : b) sum += share = truncate_to_bits(share * area, 24);
    const Rational r = truncate_to_bits((sum == power(floor_log2(sum)) ? Rational{1} : 1 - power(-31)) / sum, 29);
    int largest = nowhere, shared = 0;
    for (Rational& share : b) {
        share = truncate_to_bits(share * r, 24);
        largest = std::max(largest, exponent(share));
    }
    for (std::size_t i = 0; i < 3; ++i) shared |= exponent(b[i]) == largest ? 1 << i : 0;
    // Indexed by the set of vertices that share the largest exponent.
    constexpr std::array<std::size_t, 8> remainder{9, 0, 1, 0, 2, 2, 1, 2};
    const std::size_t rest = remainder[static_cast<std::size_t>(shared)];
    b[rest] = 1 - b[(rest + 1) % 3] - b[(rest + 2) % 3];
    return b;
}

[[nodiscard]] Rational model(const std::array<SubpixelPoint, 3>& p, const std::array<Rational, 3>& u, int x, int y) {
    const std::array<Rational, 3> b = cut_shares(p, x, y);
    const Rational d0 = u[0] - u[1], d2 = u[2] - u[1];
    const int k = std::max({exponent(u[1]), exponent(b[0]) + exponent(d0), exponent(b[2]) + exponent(d2)});
    return truncate_to_bits(truncate(u[1], k - 23) + truncate(b[0] * d0, k - 23) + truncate(b[2] * d2, k - 23), 24);
}

// Result of the implementation at a pixel's centre.
[[nodiscard]] float coordinate(const std::array<SubpixelPoint, 3>& p, const std::array<float, 3>& u, int x, int y) {
    const TriangleEdges edges{p, TieRule::top_left};
    const auto px = static_cast<std::uint16_t>(x), py = static_cast<std::uint16_t>(y);
    const double unused = 0;
    float out = 0;
    truncated_coordinates(u, {1, 1, 1}, {&edges, bits, &px, &py, &unused, &unused, 1, true}, DepthHypothesis{}, &out);
    return out;
}

[[nodiscard]] bool is_inside(const std::array<SubpixelPoint, 3>& p, int x, int y) {
    const EdgeValues e = TriangleEdges{p, TieRule::top_left}.at(pixel_centre(x, y, bits));
    return e[0] >= 0 && e[1] >= 0 && e[2] >= 0;
}

}  // namespace

TEST_CASE(
    "texture coordinates are three terms truncated to a common unit by weights of which all but one are truncated") {
    Random random{78};
    std::uint64_t compared = 0, wrong = 0;
    for (int n = 0; n < 80; ++n) {
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 14, 14, bits, n % 3 == 0 ? 300 : 2);
        if (doubled_area(p[0], p[1], p[2]) <= 0) continue;
        std::array<float, 3> u{};
        for (float& each : u) each = static_cast<float>(random_int(random, -(1 << 20), 1 << 20)) / 4096.0f;
        const std::array<Rational, 3> exact{Rational{u[0]}, Rational{u[1]}, Rational{u[2]}};
        for (int y = 0; y < 14; ++y)
            for (int x = 0; x < 14; ++x) {
                if (!is_inside(p, x, y)) continue;
                ++compared;
                wrong += Rational{coordinate(p, u, x, y)} != model(p, exact, x, y);
            }
    }
    CHECK(compared > 500);
    CHECK(wrong == 0);
}

// 640 x 480 pixels and 256 x 256 texels, as in the captures' checkerboards: row 15 k has t = 8 k. The corner of t = 256
// that is not the base takes the remainder or gets a low weight.
TEST_CASE("an integer coordinate is slightly too low where another vertex takes the remainder as on the chip") {
    const std::array<SubpixelPoint, 3> upper_right{{{8, 8}, {10248, 8}, {10248, 7688}}};
    const std::array<float, 3> t{0, 0, 256};
    const auto is_low = [&](int x, int y) { return coordinate(upper_right, t, x, y) < static_cast<float>(y / 15 * 8); };
    for (const int x : {180, 319, 480, 639}) CHECK(is_low(x, 135));
    for (const int x : {320, 479}) CHECK_FALSE(is_low(x, 135));
    CHECK(is_low(481, 240));
    CHECK_FALSE(is_low(480, 240));
    CHECK_FALSE(is_low(400, 285));
    const std::array<SubpixelPoint, 3> lower_left{{{8, 8}, {10248, 7688}, {8, 7688}}};
    for (const int y : {15, 135, 240, 465})
        CHECK(coordinate(lower_left, {0, 256, 256}, 10, y) >= static_cast<float>(y / 15 * 8));
}

TEST_CASE("a coordinate that all corners share is unchanged and infinities are allowed") {
    const std::array<SubpixelPoint, 3> p{{{0, 0}, {160, 0}, {0, 160}}};
    CHECK(coordinate(p, {0.1f, 0.1f, 0.1f}, 2, 3) == 0.1f);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    CHECK(coordinate(p, {0, 0, infinity}, 2, 3) == infinity);
    CHECK(coordinate(p, {1e38f, -1e38f, 1e38f}, 2, 3) < 1e38f);
    CHECK(coordinate(p, {0, 1e-45f, 0}, 2, 3) >= 0.0f);
}

TEST_CASE("coordinates are summed this way only for equal w and only if the rules say so") {
    const RasterRules chip{.interpolation = {.texture_coordinates = CoordinateRule::cut_weights}};
    CHECK(truncates_coordinates(chip, std::array{0.5f, 0.5f, 0.5f}));
    CHECK_FALSE(truncates_coordinates(chip, std::array{0.5f, 0.5f, 0.25f}));
    CHECK_FALSE(truncates_coordinates(chip, std::array{0.5f, 0.25f, 0.5f}));
    CHECK_FALSE(truncates_coordinates(RasterRules{}, std::array{1.0f, 1.0f, 1.0f}));
}
