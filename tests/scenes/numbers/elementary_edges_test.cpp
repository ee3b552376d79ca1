// Tests the elementary functions at special values: symmetries, values that binary64 represents exactly, and MPFR with
// 60 digits where every base is combined with every exponent.
#include <bit>
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "scenes/numbers/double_double.h"
#include "scenes/numbers/elementary.h"

namespace {

using WideNumber = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<80>>;
namespace elementary = strata::scenes;

constexpr double never = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double least_normal = std::numeric_limits<double>::min();
constexpr double greatest = std::numeric_limits<double>::max();

// Error in units of the last place of `exact`, at least 2^-1074.
double units_off(double answer, const WideNumber& exact) {
    const int exponent = std::max(std::ilogb(exact.convert_to<double>()), -1022);
    return abs((WideNumber{answer} - exact) / ldexp(WideNumber{1}, exponent - 52)).convert_to<double>();
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

}  // namespace

TEST_CASE("angles are accepted up to 10^6 radians inclusive in both directions") {
    for (const double sign : {1.0, -1.0}) {
        const double last = sign * 1e6, beyond = std::nextafter(last, sign * endless);
        CHECK(units_off(elementary::sin(last), sin(WideNumber{last})) < 0.501);
        CHECK(units_off(elementary::cos(last), cos(WideNumber{last})) < 0.501);
        CHECK(units_off(elementary::tan(last), tan(WideNumber{last})) < 0.501);
        CHECK(std::isnan(elementary::sin(beyond)));
        CHECK(std::isnan(elementary::cos(beyond)));
        CHECK(std::isnan(elementary::tan(beyond)));
    }
}

TEST_CASE("sine and tangent are odd and cosine is even in every bit") {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> exponent{-60, 19.9};
    double first_wrong = 0;
    for (int i = 0; i < 20'000; ++i) {
        const double x = std::exp2(exponent(random));
        const bool right = same_bits(elementary::sin(-x), -elementary::sin(x)) &&
                           same_bits(elementary::cos(-x), elementary::cos(x)) &&
                           same_bits(elementary::tan(-x), -elementary::tan(x));
        if (!right && first_wrong == 0) first_wrong = x;
    }
    CHECK(first_wrong == 0);
}

TEST_CASE("small angles are equal to their sine and tangent") {
    for (const double x : {0x1p-1074, least_normal, 0x1p-500, 0x1.8p-27}) {
        CHECK(elementary::sin(x) == x);
        CHECK(elementary::cos(x) == (x < 0x1p-27 ? 1 : 1 - 0x1.2p-54));
    }
    CHECK(elementary::tan(0x1p-30) == 0x1p-30);
    CHECK(same_bits(elementary::sin(0.0), 0.0));
    CHECK(same_bits(elementary::tan(0.0), 0.0));
}

TEST_CASE("every base to every exponent is within half a unit and at the ends of the range too") {
    const double bases[] = {0x1p-1074,
                            0x1.8p-1073,
                            0x1.fffffffffffffp-1023,
                            least_normal,
                            0x1.3p-1000,
                            1e-10,
                            0.5,
                            0x1.6a09e667f3bccp-1,
                            0x1.6a09e667f3bcdp-1,
                            std::nextafter(1.0, 0.0),
                            std::nextafter(1.0, 2.0),
                            0x1.6a09e667f3bcdp+0,
                            2,
                            3,
                            10,
                            1e10,
                            0x1.8p1000,
                            greatest};
    const double exponents[] = {1, 2, 3, 0.5, 1 / 2.4, 2.4, 0.001, 1e-300, 100, 308, 1023, 1074, 1e15};
    double worst = 0, worst_base = 0, worst_exponent = 0;
    int in_range = 0, small = 0, above = 0, below = 0;
    for (const double base : bases)
        for (const double magnitude : exponents)
            for (const double exponent : {magnitude, -magnitude}) {
                const WideNumber exact = pow(WideNumber{base}, WideNumber{exponent});
                const double answer = elementary::pow(base, exponent);
                double off = 0;
                if (exact >= ldexp(WideNumber{1}, 1024)) {
                    off = answer == endless ? 0 : 99;
                    ++above;
                } else if (exact < ldexp(WideNumber{1}, -1076)) {
                    off = answer == 0 ? 0 : 99;
                    ++below;
                } else if (exact >= WideNumber{least_normal} && exact <= WideNumber{greatest}) {
                    off = units_off(answer, exact);
                    ++in_range;
                } else if (exact < WideNumber{least_normal}) {  // rounded twice
                    off = abs(WideNumber{answer} - exact) <= ldexp(WideNumber{1.01}, -1074) ? 0 : 99;
                    ++small;
                }
                if (!(off <= worst)) worst = off, worst_base = base, worst_exponent = exponent;
            }
    INFO(worst_base << " to the " << worst_exponent);
    CHECK(worst < 0.501);
    CHECK((in_range > 200 && small > 5 && above > 50 && below > 50));
}

TEST_CASE("a power that binary64 represents is exact") {
    int wrong = 0;
    for (int n = 1; n <= 2000; ++n) {
        const double x = n;
        wrong += elementary::pow(x, 2) == x * x && elementary::pow(x * x, 0.5) == x ? 0 : 1;
        wrong += elementary::pow(x, 3) == x * x * x && elementary::pow(x, 1) == x ? 0 : 1;
    }
    for (int k = -1074; k <= 1023; ++k) wrong += elementary::pow(2, k) == std::ldexp(1.0, k) ? 0 : 1;
    CHECK(wrong == 0);
}

TEST_CASE("powers with base or exponent 0 or base 1 have their defined values and undefined ones are NaN") {
    for (const double exponent : {0.5, 1.0, 1e300}) {
        CHECK(same_bits(elementary::pow(0, exponent), 0.0));
        CHECK(elementary::pow(0, -exponent) == endless);
        CHECK(elementary::pow(1, exponent) == 1);
        CHECK(elementary::pow(1, -exponent) == 1);
    }
    for (const double base : {0.0, 0x1p-1074, 1.0, greatest}) CHECK(elementary::pow(base, 0) == 1);
    for (const double bad : {never, endless, -endless}) {
        CHECK(std::isnan(elementary::pow(bad, 2)));
        CHECK(std::isnan(elementary::pow(bad, 0)));
        CHECK(std::isnan(elementary::pow(2, bad)));
        CHECK(std::isnan(elementary::pow(1, bad)));
    }
    CHECK(std::isnan(elementary::pow(-0x1p-1074, 1)));
}

TEST_CASE("degrees become radians by one product and one quotient that are each rounded") {
    CHECK(elementary::radians(180) == elementary::pi);
    CHECK(elementary::radians(0) == 0);
    int wrong = 0;
    for (int d = -720; d <= 720; ++d) {
        volatile double product = d * 0x1.921fb54442d18p+1;
        wrong += elementary::radians(d) == product / 180 ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("sums and products and quotients of double-doubles lose at most a few of their last bits") {
    std::mt19937_64 random{8};
    std::uniform_real_distribution<double> unit{1, 2};
    const auto next = [&] {
        const int sign = random() % 2 == 0 ? 1 : -1;
        return elementary::two_sum(sign * std::ldexp(unit(random), static_cast<int>(random() % 40) - 20),
                                   std::ldexp(unit(random), -80));
    };
    const auto exact = [](const elementary::DoubleDouble& d) { return WideNumber{d.high} + WideNumber{d.low}; };
    WideNumber sum_off = 0, product_off = 0, quotient_off = 0;
    bool is_nearest = true;
    for (int i = 0; i < 5000; ++i) {
        const auto a = next(), b = next();
        const WideNumber x = exact(a), y = exact(b), larger = abs(x) > abs(y) ? abs(x) : abs(y);
        const auto note = [&](WideNumber& worst, const elementary::DoubleDouble& found, const WideNumber& expected,
                              const WideNumber& scale) {
            const WideNumber off = abs(exact(found) - expected) / abs(scale);
            if (off > worst) worst = off;
            is_nearest = is_nearest && found.high == found.high + found.low;
        };
        note(sum_off, elementary::add(a, b), x + y, larger);
        note(product_off, elementary::mul(a, b), x * y, x * y);
        note(quotient_off, elementary::div(a, b), x / y, x / y);
        is_nearest = is_nearest && exact(elementary::negated(a)) == -x;
    }
    const WideNumber some_bits = ldexp(WideNumber{1}, -101);
    CHECK(sum_off < some_bits);
    CHECK(product_off < some_bits);
    CHECK(quotient_off < some_bits);
    CHECK(is_nearest);
}
