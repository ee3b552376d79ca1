// Tests exact sums of products against rational arithmetic.
#include "rasterizer/base/exact_sum.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] double random_double(Random& random, int exponents) {
    const auto mantissa = static_cast<double>(static_cast<std::int64_t>(random()) >> 11);
    const auto exponent = static_cast<std::uint64_t>(1023 + random_int(random, -exponents, exponents)) << 52;
    return mantissa * std::bit_cast<double>(exponent);
}

}  // namespace

TEST_CASE("a sum of products has the sign and nearly the value of the rational sum for any cancellation", "[slow]") {
    constexpr std::uint64_t seed = 11;
    Random random{seed};
    std::uint64_t wrong_sign = 0, wrong_value = 0, zeros = 0;
    for (int n = 0; n < 20000; ++n) {
        ExactSum sum;
        Rational model = 0;
        const auto add = [&](std::int64_t e, double a, double b) {
            sum.add_product(e, a, b);
            model += Rational{Integer{e}} * Rational{a} * Rational{b};
        };
        const auto e = static_cast<std::int64_t>(random()) >> random_int(random, 7, 60);
        const double a = random_double(random, n % 3 == 0 ? 2 : 100), b = static_cast<double>(random() & 0xffffff);
        add(e, a, b);
        add(-e, a, n % 2 == 0 ? b : b + 1);
        if (n % 5 != 0) add(static_cast<std::int64_t>(random()) >> 40, random_double(random, 60), 1.0);
        const int sign = model > 0 ? 1 : (model < 0 ? -1 : 0);
        zeros += sign == 0 ? 1 : 0;
        wrong_sign += sum.sign() != sign ? 1 : 0;
        wrong_value += abs(Rational{sum.approximation()} - model) > abs(model) * power(-51) ? 1 : 0;
    }
    INFO("seed " << seed);
    CHECK(zeros > 1000);
    CHECK(wrong_sign == 0);
    CHECK(wrong_value == 0);
}

TEST_CASE("sum and product in two terms are exact", "[slow]") {
    Random random{12};
    std::uint64_t wrong = 0;
    for (int n = 0; n < 20000; ++n) {
        const double a = random_double(random, 50), b = random_double(random, 50);
        const TwoTerms s = two_sum(a, b), p = two_product(a, b);
        wrong += Rational{s.high} + Rational{s.low} != Rational{a} + Rational{b} ? 1 : 0;
        wrong += Rational{p.high} + Rational{p.low} != Rational{a} * Rational{b} ? 1 : 0;
        wrong += s.high != a + b || p.high != a * b ? 1 : 0;
    }
    CHECK(wrong == 0);
}
