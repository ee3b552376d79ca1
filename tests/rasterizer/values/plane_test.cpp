// Tests exact planes against rationals and their rounding by definition (rational.h); depth codes are floor(V) or
// floor(V + 1/2) of them.
#include "rasterizer/values/plane.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

struct Tally {
    std::uint64_t fragments = 0, wrong_float = 0, wrong_code = 0, fallbacks = 0;
};

[[nodiscard]] std::uint32_t model_code(const Rational& depth, DepthFormat format, DepthRounding rounding) {
    const Integer max = (Integer{1} << (format == DepthFormat::d16 ? 16 : 24)) - 1;
    const Integer code =
        floor(depth * Rational{max} + (rounding == DepthRounding::nearest ? Rational{1, 2} : Rational{0}));
    return (code < 0 ? Integer{0} : (code > max ? max : code)).convert_to<std::uint32_t>();
}

void compare(const SetupTriangle& triangle, const RasterRules& rules, DepthFormat format, int size, Tally& tally) {
    Geometry geometry = window_geometry({triangle}, size, size, rules);
    geometry.state.depth_format = format;
    const DrawResult result = draw(geometry, {DepthPath::exact, format}, everything);
    tally.fallbacks += result.exact_fallbacks;
    const Rational units = rules.window_z == WindowZ::buffer_units
                               ? (Integer{1} << (format == DepthFormat::d16 ? 16 : 24)) - 1
                               : Integer{1};
    for (const Fragment& f : result.fragments) {
        const Rational depth = plane_value(barycentric(triangle.p, f.x, f.y, rules.subpixel_bits), triangle.z) / units;
        ++tally.fragments;
        if (std::bit_cast<std::uint32_t>(nearest_float(depth)) != std::bit_cast<std::uint32_t>(f.shader_z))
            ++tally.wrong_float;
        if (f.code != model_code(depth, format, rules.depth_rounding) || f.exact_code != f.code) ++tally.wrong_code;
    }
}

[[nodiscard]] std::array<SubpixelPoint, 3> random_corners(Random& random, int size, int bits, int outside) {
    std::array<SubpixelPoint, 3> p;
    do {
        for (SubpixelPoint& c : p) c = random_point(random, size, size, bits, outside);
    } while (doubled_area(p[0], p[1], p[2]) == 0);
    return p;
}

// z in depth units: 0 ordinary, 1 steep from tiny values, 2 cancelling around 0, 3 few bits (ties), 4 nearly constant.
[[nodiscard]] float random_z(Random& random, int kind) {
    switch (kind) {
        case 0: return random_float(random, 0, 1);
        case 1: return (random() & 1) != 0 ? random_float(random, 0, 0x1p-40f) : random_float(random, 0.9f, 1);
        case 2: return random_float(random, -1, 1);
        case 3: return static_cast<float>(random_int(random, 0, 16)) / 16.0f;
        default: return 0.7f + static_cast<float>(random_int(random, 0, 3)) * 0x1p-24f;
    }
}

}  // namespace

TEST_CASE(
    "float32 and exact depth are the rational plane rounded once for every subpixel setting and up to the guard band",
    "[slow]") {
    constexpr std::uint64_t seed = 21;
    Random random{seed};
    Tally tally;
    for (const int bits : {4, 8, 12})
        for (const int outside : {0, 50, 32000})
            for (int kind = 0; kind < 5; ++kind)
                for (int n = 0; n < 24; ++n) {
                    const auto z = [&] { return double{random_z(random, kind)}; };
                    const SetupTriangle t =
                        window_triangle(random_corners(random, 24, bits, outside), bits, {z(), z(), z()});
                    const RasterRules rules{
                        .subpixel_bits = bits,
                        .depth_rounding = n % 2 == 0 ? DepthRounding::floor : DepthRounding::nearest};
                    compare(t, rules, n % 3 == 0 ? DepthFormat::d16 : DepthFormat::d24, 24, tally);
                }
    INFO("seed " << seed << ", fragments " << tally.fragments << ", fallbacks " << tally.fallbacks);
    CHECK(tally.fragments > 30000);
    CHECK(tally.wrong_float == 0);
    CHECK(tally.wrong_code == 0);
}

TEST_CASE("depth in buffer units is divided and rounded once for shader_z and for the code", "[slow]") {
    constexpr std::uint64_t seed = 22;
    Random random{seed};
    Tally tally;
    for (const int bits : {4, 8, 12})
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24})
            for (int n = 0; n < 60; ++n) {
                const float units = format == DepthFormat::d16 ? 65535.0f : 16777215.0f;
                const auto z = [&] { return double{random_z(random, n % 5) * units}; };
                const SetupTriangle t = window_triangle(random_corners(random, 24, bits, 10), bits, {z(), z(), z()});
                const RasterRules rules{.subpixel_bits = bits,
                                        .window_z = WindowZ::buffer_units,
                                        .depth_rounding = n % 2 == 0 ? DepthRounding::floor : DepthRounding::nearest};
                compare(t, rules, format, 24, tally);
            }
    INFO("seed " << seed << ", fragments " << tally.fragments << ", fallbacks " << tally.fallbacks);
    CHECK(tally.wrong_float == 0);
    CHECK(tally.wrong_code == 0);
}

TEST_CASE("planes through rounding boundaries reach the exact arithmetic and give correct results") {
    // z increases by one code per pixel from an integer, or by half a unit in the last place of a float: every pixel is
    // a tie.
    Tally tally;
    const int bits = 8, unit = 1 << bits, half = unit / 2;
    const std::array<SubpixelPoint, 3> corners{{{half, half}, {half + 16 * unit, half}, {half, half + 16 * unit}}};
    const RasterRules codes{
        .subpixel_bits = bits, .window_z = WindowZ::buffer_units, .depth_rounding = DepthRounding::floor};
    compare(window_triangle(corners, bits, {100.0, 116.0, 1700.0}), codes, DepthFormat::d24, 16, tally);
    compare(window_triangle(corners, bits, {100.5, 116.5, 1700.5}),
            RasterRules{.subpixel_bits = bits, .window_z = WindowZ::buffer_units}, DepthFormat::d24, 16, tally);
    const std::uint64_t by_codes = tally.fallbacks;
    CHECK(by_codes > 100);
    const double half_ulp = 0x1p-25;
    compare(window_triangle(corners, bits, {0.5, 0.5 + 16 * half_ulp, 0.5 + 160 * half_ulp}), {.subpixel_bits = bits},
            DepthFormat::d24, 16, tally);
    CHECK(tally.fallbacks > by_codes + 50);
    CHECK(tally.wrong_float == 0);
    CHECK(tally.wrong_code == 0);
}

TEST_CASE("values next to a tie are rounded to their own side for any triangle", "[slow]") {
    // z = base + x step exactly, a tie at every second or every pixel; then one vertex moves by a few units of 2^-52 of
    // it.
    constexpr std::uint64_t seed = 24;
    Random random{seed};
    Tally floats, codes;
    for (const int bits : {4, 8, 12})
        for (int n = 0; n < 60; ++n) {
            const std::array p = random_corners(random, 24, bits, n % 2 == 0 ? 2 : 30);
            const auto plane = [&](double base, double step, double hair) {
                std::array<double, 3> z;
                for (std::size_t i = 0; i < 3; ++i)
                    z[i] = base + (p[i].x - (1 << (bits - 1))) * step * (1.0 / (1 << bits));
                z[static_cast<std::size_t>(n % 3)] += hair * random_int(random, -2, 2);
                return window_triangle(p, bits, z);
            };
            compare(plane(0.75, 0x1p-25, 0x1p-53), {.subpixel_bits = bits}, DepthFormat::d24, 24, floats);
            compare(plane(0.5 - 12 * 0x1p-10, 0x1p-10, 0.0), {.subpixel_bits = bits},
                    n % 2 == 0 ? DepthFormat::d16 : DepthFormat::d24, 24,
                    codes);  // 0.5 is half way between two codes
            const DepthRounding rounding = n % 4 < 2 ? DepthRounding::floor : DepthRounding::nearest;
            const double base = rounding == DepthRounding::floor ? 5000.0 : 5000.5;
            compare(plane(base, 3.0, 0x1p-40),
                    {.subpixel_bits = bits, .window_z = WindowZ::buffer_units, .depth_rounding = rounding},
                    DepthFormat::d24, 24, codes);
        }
    INFO("seed " << seed);
    CHECK(floats.fallbacks > 5000);
    CHECK(codes.fallbacks > 10000);
    CHECK(floats.wrong_float + codes.wrong_float == 0);
    CHECK(floats.wrong_code + codes.wrong_code == 0);
}

TEST_CASE("complete cancellation gives +0 and almost complete cancellation the correct tiny value") {
    Tally tally;
    const int bits = 4, unit = 16, half = 8;
    const std::array<SubpixelPoint, 3> corners{{{half, half}, {half + 8 * unit, half}, {half, half + 8 * unit}}};
    for (const double tiny :
         {0.0, 0x1p-149, 0x1p-140, 0x1p-60}) {  // z is zero along x = 4 except for the third corner's part
        const SetupTriangle t = window_triangle(corners, bits, {-1.0, 1.0, -1.0 + tiny});
        compare(t, {.subpixel_bits = bits}, DepthFormat::d24, 8, tally);
        compare(window_triangle(corners, bits, {-1.0, 1.0, tiny}), {.subpixel_bits = bits}, DepthFormat::d24, 8, tally);
    }
    CHECK(tally.fallbacks > 0);
    CHECK(tally.wrong_float == 0);
    CHECK(tally.wrong_code == 0);
}

TEST_CASE("at n = 12 edge values beyond 2^53 are as exact as small ones", "[slow]") {
    constexpr std::uint64_t seed = 23;
    Random random{seed};
    Tally tally;
    constexpr std::int32_t far = (1 << 27) - 1;
    for (int n = 0; n < 12; ++n) {
        const auto odd = [&] { return random_int(random, 0, 1000) * 2 + 1; };
        const std::array<SubpixelPoint, 3> p{
            {{-far + odd(), -far + odd()}, {far - odd(), -far + odd()}, {odd(), far - odd()}}};
        const auto z = [&] { return double{random_z(random, n % 3)}; };
        compare(window_triangle(p, 12, {z(), z(), z()}), {.subpixel_bits = 12}, DepthFormat::d24, 48, tally);
    }
    INFO("seed " << seed << ", fallbacks " << tally.fallbacks);
    CHECK(tally.fragments == 12u * 48 * 48);
    CHECK(tally.wrong_float == 0);
    CHECK(tally.wrong_code == 0);
}
