// Tests the elementary functions against MPFR with 60 decimal digits; errors are in units of the last place of the
// exact value.
#include "scenes/numbers/elementary.h"

#include <bit>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<60>>;

constexpr int points = 100'000;
constexpr double bound = 0.501;

double error_in_ulp(double answer, const Wide& exact) {
    const int exponent = std::max(std::ilogb(exact.convert_to<double>()), -1022);
    return abs((Wide{answer} - exact) / ldexp(Wide{1}, exponent - 52)).convert_to<double>();
}

struct Worst {
    double error = 0, x = 0, y = 0;
    void note(double answer, const Wide& exact, double at_x, double at_y = 0) {
        const double e = error_in_ulp(answer, exact);
        if (!(e <= error)) *this = {e, at_x, at_y};
    }
    void check() const {
        INFO("largest error " << error << " ulp at " << x << ", " << y << ", bits " << std::hex
                              << std::bit_cast<std::uint64_t>(x) << ", " << std::bit_cast<std::uint64_t>(y));
        CHECK(error < bound);
    }
};

// Angles of every magnitude up to the limit, and doubles next to multiples of pi/2, where all leading bits cancel.
double angle(std::mt19937_64& random, int i) {
    std::uniform_real_distribution<double> unit{-1, 1};
    const double signed_unit = unit(random);
    if (i % 4 == 0) return signed_unit * strata::scenes::max_angle;
    if (i % 4 == 1) return signed_unit * 10;
    if (i % 4 == 2) return std::ldexp(signed_unit, -static_cast<int>(random() % 300));
    const auto k = static_cast<double>(random() % 636'000 + 1);
    const double near = (k * (boost::math::constants::pi<Wide>() / 2)).convert_to<double>();
    return random() % 2 == 0 ? near : std::nextafter(near, 0);
}

}  // namespace

TEST_CASE("sin and cos and tan are within 0.501 ulp up to 10^6 radians and next to multiples of pi/2") {
    std::mt19937_64 random{1};
    Worst sine, cosine, tangent;
    for (int i = 0; i < points; ++i) {
        const double x = angle(random, i);
        if (x == 0) continue;
        sine.note(strata::scenes::sin(x), sin(Wide{x}), x);
        cosine.note(strata::scenes::cos(x), cos(Wide{x}), x);
        tangent.note(strata::scenes::tan(x), tan(Wide{x}), x);
    }
    sine.check();
    cosine.check();
    tangent.check();
}

TEST_CASE("pow is within 0.501 ulp wherever the result is a normal number") {
    std::mt19937_64 random{2};
    std::uniform_real_distribution<double> unit{0, 1};
    Worst worst;
    int normal = 0;
    for (int i = 0; i < points; ++i) {
        double base = unit(random), exponent = i % 2 == 0 ? 2.4 : 1 / 2.4;
        if (i % 3 == 1) base = std::ldexp(1 + unit(random), static_cast<int>(random() % 2000) - 1000);
        if (i % 3 == 2) base = 1 + std::ldexp(unit(random) - 0.5, -static_cast<int>(random() % 50));
        if (i % 5 == 0) exponent = std::ldexp(unit(random) - 0.5, static_cast<int>(random() % 60) - 30);
        const Wide exact = pow(Wide{base}, Wide{exponent});
        if (base == 0 || exact > std::numeric_limits<double>::max() || exact < std::numeric_limits<double>::min())
            continue;
        worst.note(strata::scenes::pow(base, exponent), exact, base, exponent);
        ++normal;
    }
    worst.check();
    CHECK(normal > points / 2);
}

TEST_CASE("the elementary functions give exact values and preserve the sign of zero") {
    using namespace strata::scenes;
    CHECK(strata::scenes::cos(0) == 1);
    CHECK(std::signbit(strata::scenes::sin(-0.0)));
    CHECK(std::signbit(strata::scenes::tan(-0.0)));
    CHECK(strata::scenes::sin(radians(30)) == Approx(0.5));
    CHECK(strata::scenes::pow(4, 0.5) == 2);
    CHECK(strata::scenes::pow(1024, 0.1) == Approx(2));
    CHECK(strata::scenes::pow(2, -1022) == 0x1p-1022);
    CHECK(strata::scenes::pow(0, 2) == 0);
    CHECK(strata::scenes::pow(7, 0) == 1);
    CHECK(strata::scenes::pow(1, 1e300) == 1);
    CHECK(strata::scenes::pow(2, 1024) == std::numeric_limits<double>::infinity());
    CHECK(strata::scenes::pow(2, -1100) == 0);
}

TEST_CASE("the elementary functions are NaN outside of their specified domain") {
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    for (const double x : {infinity, -infinity, nan, 1.1e6}) {
        CHECK(std::isnan(strata::scenes::sin(x)));
        CHECK(std::isnan(strata::scenes::cos(x)));
        CHECK(std::isnan(strata::scenes::tan(x)));
    }
    CHECK(std::isnan(strata::scenes::pow(-1, 2)));
    CHECK(std::isnan(strata::scenes::pow(nan, 2)));
    CHECK(std::isnan(strata::scenes::pow(2, infinity)));
}
