// Tests interval arithmetic against exact integers over 2^80, with 256 bits.
#include "tools/oracle/rounding/interval.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <random>

using namespace strata::oracle::verdict;

namespace {

using Whole = boost::multiprecision::int256_t;

// n / 2^40.
double small(std::int64_t n) { return static_cast<double>(n) * 0x1p-40; }

// True if low <= n / 2^80 <= high. Exact: x 2^80 is a whole number for all values here, except below 2^-80, where it is
// truncated to the stricter side.
bool encloses(const Interval& x, const Whole& n) {
    return Whole{std::ceil(std::ldexp(x.low, 80))} <= n && n <= Whole{std::floor(std::ldexp(x.high, 80))};
}

}  // namespace

TEST_CASE("the sum and product and mixture of intervals contain the exact result of every pair of operands") {
    std::mt19937_64 random{20};
    const auto number = [&] { return static_cast<std::int64_t>(random() >> 22) - (std::int64_t{1} << 41); };
    const auto share = [&] { return static_cast<std::int64_t>(random() >> 24); };
    std::uint64_t outside = 0;
    for (int i = 0; i < 200'000; ++i) {
        const std::int64_t a = number(), b = number(), s = share();
        const Interval x = Interval::of(small(a)), y = Interval::of(small(b)), part = Interval::of(small(s));
        const Whole one = Whole{1} << 40;
        outside += encloses(x + y, (Whole{a} + b) * one) ? 0 : 1;
        outside += encloses(x * y, Whole{a} * b) ? 0 : 1;
        outside += encloses(rest_of(x), (one - a) * one) ? 0 : 1;
        outside += encloses(mixed(part, x, y), Whole{s} * a + (one - s) * b) ? 0 : 1;
    }
    CHECK(outside == 0);
}

TEST_CASE("intervals of several numbers contain the results of all numbers within them") {
    std::mt19937_64 random{21};
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::uint64_t outside = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double from[3] = {2 * unit() - 1, 2 * unit() - 1, 0.9 * unit()};
        const double wide[3] = {unit(), unit(), 0.1 * unit()};
        const Interval x{from[0], from[0] + wide[0]}, y{from[1], from[1] + wide[1]}, a{from[2], from[2] + wide[2]};
        const double u = from[0] + wide[0] * unit() * 0.999, v = from[1] + wide[1] * unit() * 0.999;
        const double share = from[2] + wide[2] * unit() * 0.999;
        outside += (x + y).holds(u + v) && (x * y).holds(u * v) && rest_of(x).holds(1 - u) ? 0 : 1;
        outside += mixed(a, x, y).holds(share * u + (1 - share) * v) ? 0 : 1;
    }
    CHECK(outside == 0);
}

TEST_CASE("an interval of one number stays narrow because outward rounding costs only some units in the last place") {
    const Interval third = Interval::of(1.0 / 3), mixture = mixed(third, Interval::of(0.75), Interval::of(0.25));
    CHECK(mixture.high - mixture.low < 1e-14);
    CHECK((third * third).high - (third * third).low < 1e-15);
}
