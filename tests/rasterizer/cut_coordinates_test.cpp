// The model: nv2a-depth.md section 1 over rationals, the sum not floored but cut to binary32.
#include "rasterizer/cut_coordinates.h"

#include <catch2/catch.hpp>

#include "rational.h"
#include "support.h"

namespace {

using namespace strata::rasterizer;

constexpr int bits = 4;

[[nodiscard]] Rational weighted_sum(const std::array<SubpixelPoint, 3>& p, const std::array<Rational, 3>& u, int x, int y) {
    const std::array<Rational, 3> share = barycentric(p, x, y, bits);
    const Rational area{abs(doubled_area(p[0], p[1], p[2]))}, r = cut_to_bits(Rational{1} / area, 28);
    std::array<int, 3> k{};
    for (std::size_t i = 0; i < 3; ++i) k[i] = share[i] == 0 ? -1000 : floor_log2(share[i] * area);
    const std::size_t one = k[1] >= k[0] && k[1] >= k[2] ? 1 : (k[0] >= k[2] ? 0 : 2);
    Rational sum = u[one];
    int largest = u[one] == 0 ? -1000 : floor_log2(abs(u[one]));
    std::array<Rational, 2> product;
    for (std::size_t n = 0; n < 2; ++n) {
        const std::size_t j = (one + 1 + n) % 3;
        product[n] = cut_to_bits(share[j] * area * r, 24) * (u[j] - u[one]);
        if (product[n] != 0) largest = std::max(largest, floor_log2(abs(product[n])));
    }
    for (const Rational& each : product) sum += cut(each, largest - 28);
    return cut_to_bits(sum, 24);
}

}  // namespace

TEST_CASE("coordinates by cut weights are sums like those of window depth, cut to binary32") {
    constexpr std::uint64_t seed = 77;
    Random random{seed};
    std::uint64_t compared = 0, wrong = 0;
    for (int n = 0; n < 60; ++n) {
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 14, 14, bits, n % 3 == 0 ? 300 : 2);
        if (doubled_area(p[0], p[1], p[2]) <= 0) continue;
        std::array<float, 3> u{};
        std::array<Rational, 3> exact;
        for (std::size_t i = 0; i < 3; ++i) {
            u[i] = static_cast<float>(random_int(random, 0, 1 << 20)) / 4096.0f;
            exact[i] = Rational{u[i]};
        }
        const TriangleEdges edges{p, TieRule::top_left};
        for (int y = 0; y < 14; ++y)
            for (int x = 0; x < 14; ++x) {
                const std::uint16_t px = static_cast<std::uint16_t>(x), py = static_cast<std::uint16_t>(y);
                const EdgeValues e = edges.at(pixel_centre(px, py, bits));
                if (e[0] < 0 || e[1] < 0 || e[2] < 0) continue;
                const double unused = 0;
                float out = 0;
                cut_coordinates(u, {0.5f, 0.5f, 0.5f}, {&edges, bits, &px, &py, &unused, &unused, 1, true}, {}, &out);
                ++compared;
                wrong += Rational{out} == weighted_sum(p, exact, x, y) ? 0 : 1;
            }
    }
    CHECK(compared > 500);
    CHECK(wrong == 0);
}

TEST_CASE("a coordinate that all corners share comes out as it is") {
    const std::array<SubpixelPoint, 3> p{{{0, 0}, {160, 0}, {0, 160}}};
    const TriangleEdges edges{p, TieRule::top_left};
    const std::uint16_t x = 2, y = 3;
    const double unused = 0;
    float out = 0;
    cut_coordinates({0.1f, 0.1f, 0.1f}, {1.0f, 0.5f, 0.25f}, {&edges, bits, &x, &y, &unused, &unused, 1, true}, {}, &out);
    CHECK(out == 0.1f);
}
