// Tests the 22-bit floats of the lighting unit against rationals (rational.h) cut by the rules of
// pipeline/reference/fog-and-lighting.md 3, and its tables against big integers.
#include "pipeline/lighting/float22.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata;
using namespace strata::rasterizer;
namespace f22 = strata::pipeline::float22;

const Rational model_largest = power(128) - power(114);

[[nodiscard]] float model_cut22(const Rational& v) {
    if (v == 0 || abs(v) < power(-126)) return 0.0f;
    const Rational size = std::min<Rational>(abs(truncate_to_bits(v, 14)), model_largest);
    return v < 0 ? -nearest_float(size) : nearest_float(size);
}

// The multiple of 2^unit that is nearest, a half away from 0.
[[nodiscard]] Rational model_nearest(const Rational& v, int unit) {
    const Rational size = Rational{floor(abs(v) * power(-unit) + Rational{1, 2})} * power(unit);
    return v < 0 ? Rational{-size} : size;
}

template <std::size_t n>
[[nodiscard]] float model_sum22(const std::array<Rational, n>& terms, int below) {
    int top = -100000;
    for (const Rational& each : terms)
        if (each != 0) top = std::max(top, floor_log2(abs(each)));
    Rational sum{0};
    for (const Rational& each : terms) sum += truncate(each, top - 13 - below);
    return model_cut22(sum);
}

[[nodiscard]] float random22(Random& random, int spread) {
    const auto word = static_cast<std::uint32_t>(random()) & 0x807ffc00u;
    const int exponent = random_int(random, std::max(1, 127 - spread), std::min(254, 127 + spread));
    return std::bit_cast<float>(word | static_cast<std::uint32_t>(exponent) << 23);
}

[[nodiscard]] bool same22(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a == 0.0f && b == 0.0f) ||
           (f22::is_nan(a) && f22::is_nan(b));
}

}  // namespace

// The eight lowest of the 13 kept fraction bits.
TEST_CASE("a binary32 becomes the nearest number of 14 bits, a half away from zero, but not up from eight ones") {
    std::size_t wrong = 0;
    for (std::uint32_t low = 0; low < 0x4000; ++low)
        for (const std::uint32_t high : {0x3f800000u, 0xbf800000u, 0x00800000u, 0x7f7fc000u, 0x417ffc00u & ~0x3fffu}) {
            const auto v = std::bit_cast<float>(high | low);
            const Rational exact{v};
            const Rational nearest = model_nearest(exact, floor_log2(abs(exact)) - 13);
            const bool has_ones =
                numerator(Rational{truncate_to_bits(abs(exact), 14) * power(13 - floor_log2(abs(exact)))}) % 256 == 255;
            const Rational kept = has_ones ? truncate_to_bits(exact, 14) : nearest;
            wrong += Rational{f22::rounded(v)} != kept ? 1 : 0;
        }
    CHECK(wrong == 0);
    CHECK(f22::rounded(0x1p-127f) == 0.0f);
    CHECK(f22::rounded(-f22::infinity) == -f22::infinity);
    CHECK(f22::is_nan(f22::rounded(std::bit_cast<float>(0x7f800001u))));
}

TEST_CASE("products are cut to 14 significant bits, for every pair of mantissas with few bits") {
    std::size_t wrong = 0;
    for (std::uint32_t a = 0; a < 8192; a += 7)
        for (std::uint32_t b = 0; b < 8192; b += 101) {
            const auto x = std::bit_cast<float>(0x3f800000u | a << 10), y = std::bit_cast<float>(0xc0000000u | b << 10);
            wrong += same22(f22::mul(x, y), model_cut22(Rational{x} * Rational{y})) ? 0 : 1;
        }
    CHECK(wrong == 0);
    Random random{311};
    for (int k = 0; k < 20000; ++k) {
        const float x = random22(random, 126), y = random22(random, 126);
        wrong += same22(f22::mul(x, y), model_cut22(Rational{x} * Rational{y})) ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("before a sum terms are cut to five bits below the last one of the largest, or to none") {
    Random random{312};
    std::size_t wrong = 0, cut = 0;
    for (int k = 0; k < 30000; ++k) {
        const float a = random22(random, 9), b = random22(random, 9), c = random22(random, 9);
        const std::array three{Rational{a}, Rational{b}, Rational{c}};
        const std::array two{Rational{a}, Rational{b}};
        wrong += same22(f22::sum<3>({a, b, c}), model_sum22(three, 5)) ? 0 : 1;
        wrong += same22(f22::add(a, b), model_sum22(two, 5)) ? 0 : 1;
        wrong += same22(f22::sadd(a, b), model_sum22(two, 0)) ? 0 : 1;
        cut += same22(f22::add(a, b), f22::sadd(a, b)) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(cut > 100);
}

TEST_CASE("a dot product adds products that are cut") {
    Random random{313};
    std::size_t wrong = 0;
    for (int k = 0; k < 10000; ++k) {
        std::array<float, 3> a{}, b{};
        std::array<Rational, 3> product;
        for (std::size_t i = 0; i < 3; ++i) {
            a[i] = random22(random, 5), b[i] = random22(random, 5);
            product[i] = Rational{model_cut22(Rational{a[i]} * Rational{b[i]})};
        }
        wrong += same22(f22::dot(a, b), model_sum22(product, 5)) ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("infinity times zero is zero, times anything else +infinity, and NaN wins") {
    constexpr float inf = f22::infinity, nan = f22::not_a_number;
    CHECK(same22(f22::mul(inf, 0.0f), 0.0f));
    CHECK(f22::mul(inf, -2.0f) == inf);
    CHECK(f22::mul(-inf, -inf) == inf);
    CHECK(f22::is_nan(f22::mul(0.0f, nan)));
    CHECK(f22::add(-inf, 1.0f) == inf);
    CHECK(f22::is_nan(f22::sum<3>({inf, 1.0f, nan})));
    // Products that enter a sum whole, as those of highlights do.
    CHECK(f22::is_nan(f22::cut_sum<2>({double{inf}, double{nan}}, 2)));
    CHECK(f22::cut_sum<2>({-double{inf}, 1.0}, 1) == inf);
    CHECK(f22::mul(f22::largest, -2.0f) == -f22::largest);
}

TEST_CASE("the tables of reciprocals and roots are those of their formulas, for every mantissa") {
    std::size_t wrong = 0;
    double worst = 0, worst_wide = 0;
    for (const int exponent : {-7, -6, 0, 1, 12})
        for (std::uint32_t fraction = 0; fraction < 8192; ++fraction) {
            const auto field = static_cast<std::uint32_t>(127 + exponent) << 23;
            const auto x = std::bit_cast<float>(field | fraction << 10);
            // The middle of the table's interval.
            const Rational middle = 1 + Rational{2 * (fraction >> 7) + 1, 128};
            const Rational scaled = (exponent & 1) != 0 ? Rational{2 * middle} : middle;
            Integer seed{0};  // floor(128 / sqrt(scaled))
            while (Rational{(seed + 1) * (seed + 1)} * scaled <= 16384) ++seed;
            const int half = exponent >= 0 ? exponent / 2 : -((1 - exponent) / 2);
            const Rational root = Rational{seed, 64} * power(-half - 1);
            wrong += Rational{f22::rsq(x)} != root ? 1 : 0;
            const Integer first = floor(Rational{128} / middle), n{8192 + fraction};
            const Integer second = (((Integer{1} << 21) - first * n) * first) >> 14;
            wrong += Rational{f22::rcp(x)} != Rational{second, 4096} * power(-exponent - 1) ? 1 : 0;
            wrong += f22::rcp(-x) != -f22::rcp(x) ? 1 : 0;
            worst = std::max(worst, std::fabs(double{f22::rcp(x)} * double{x} - 1));
            const double wide = double{f22::wide_rsq(x)};
            worst_wide = std::max(worst_wide, std::fabs(wide * wide * double{x} - 1));
        }
    CHECK(wrong == 0);
    CHECK(worst < 0x1p-10);
    CHECK(worst_wide < 0x1p-19);
    CHECK(f22::rcp(1.0f) == 8191.0f / 8192.0f);
    CHECK(f22::rsq(0.0f) == f22::infinity);
    CHECK(f22::rsq(-1.0f) == f22::infinity);
}

TEST_CASE("the wide root is that of its two steps in big integers") {
    Random random{314};
    std::size_t wrong = 0;
    for (int k = 0; k < 20000; ++k) {
        const int exponent = random_int(random, -30, 30);
        const auto fraction = static_cast<std::uint32_t>(random()) & 0x7fffffu;
        const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23 | fraction);
        const bool is_odd = (exponent & 1) != 0;
        const Integer f = Integer{fraction | 0x800000u} * (is_odd ? 2 : 1);
        const Rational middle = (1 + Rational{2 * (fraction >> 17) + 1, 128}) * (is_odd ? 2 : 1);
        Integer s0{0};
        while (Rational{(s0 + 1) * (s0 + 1)} * middle <= 16384) ++s0;
        const Integer s1 = (((Integer{3} << 37) - s0 * s0 * f) * s0) >> 32;
        const Integer s2 = (((Integer{3} << 49) - s1 * s1 * f) * s1) >> 39;
        const int half = static_cast<int>(floor(Rational{exponent, 2}));
        wrong += Rational{f22::wide_rsq(x)} != Rational{s2} * power(-23 - half - 1) ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a colour becomes a byte to nearest, for every 22-bit float from 1/1024 to 2") {
    std::size_t wrong = 0;
    for (std::uint32_t word = 0x3a800000u; word <= 0x40000000u; word += 0x400u) {
        const auto v = std::bit_cast<float>(word);
        const Integer code = floor(std::min<Rational>(Rational{v}, 1) * 255 + Rational{1, 2});
        wrong += Integer{f22::to_byte(v)} != code ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(f22::to_byte(-1.0f) == 0);
    CHECK(f22::to_byte(f22::not_a_number) == 0);
    CHECK(f22::to_byte(f22::infinity) == 255);
}
