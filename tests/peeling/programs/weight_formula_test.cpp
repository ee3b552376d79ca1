// Tests the steps of a weight's formula: exponentials, logarithms and powers against Boost.Multiprecision, the others
// and special values by their definition. peeling/reference/algorithms.md 18.3.
#include "peeling/programs/weight_formula.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "rasterizer/base/log_exp.h"
#include "tests/peeling/units_off.h"

namespace {

using strata::exponential;
using strata::natural_log;
using strata::peeling::is_complete;
using strata::peeling::weight_by;
using strata::peeling::WeightFormula;
using strata::peeling::WeightInputs;
using strata::peeling::WeightStep;
using strata::peeling::WeightTerm;
using strata::testing::units_off;
using strata::testing::Wide;

constexpr float infinity = std::numeric_limits<float>::infinity();

float of_two(WeightTerm term, float a, float b) {
    return weight_by({.text = {}, .steps = {{WeightTerm::number, a}, {WeightTerm::number, b}, {term}}}, {});
}

float part(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }

}  // namespace

TEST_CASE("exponentials and powers of weights are within half a unit in the last place plus a millionth") {
    std::mt19937 random{58};
    double worst_exp = 0, worst_log = 0, worst_power = 0;
    for (int i = 0; i < 4000; ++i) {
        const float x = (part(random) - 0.5f) * 2 * 87.0f;
        worst_exp = std::max(worst_exp, units_off(exponential(double{x}), exp(Wide{x})));
        const float base = std::ldexp(0.5f + 0.5f * part(random), static_cast<int>(random() % 270) - 140);
        const Wide log_of_base = log(Wide{base});
        worst_log = std::max(worst_log, std::abs(static_cast<double>((Wide{natural_log(base)} - log_of_base) /
                                                                     (abs(log_of_base) + Wide{0x1p-20}))));
        const float y = (part(random) - 0.5f) * 4;
        if (abs(y * log_of_base) < 87)
            worst_power =
                std::max(worst_power, units_off(of_two(WeightTerm::power, base, y), exp(Wide{y} * log_of_base)));
    }
    CHECK(worst_exp < 0.5 + 1e-6);
    CHECK(worst_power < 0.5 + 1e-6);
    CHECK(worst_log < 1e-13);
}

TEST_CASE("exponentials end at 0 and infinity where binary32 does") {
    CHECK(exponential(-106.0) == 0.0f);
    CHECK(exponential(-103.0) == 0x1p-149f);
    CHECK(exponential(88.0) < infinity);
    CHECK(exponential(88.722839) < infinity);  // the logarithm of the greatest number is 88.7228391...
    CHECK(exponential(88.7228392) == infinity);
    CHECK(exponential(double{infinity}) == infinity);
    CHECK(exponential(-double{infinity}) == 0.0f);
    CHECK(std::isnan(exponential(std::numeric_limits<double>::quiet_NaN())));
    CHECK(exponential(0.0) == 1.0f);
}

TEST_CASE("a power of 0, of infinity and of a negative number is what the page says") {
    const auto power = [](float x, float y) { return of_two(WeightTerm::power, x, y); };
    CHECK(power(0, 2.5f) == 0);
    CHECK(power(0, 0) == 1);
    CHECK(power(0, -1) == infinity);
    CHECK(power(infinity, 0.5f) == infinity);
    CHECK(power(infinity, -0.5f) == 0);
    CHECK(power(-2, 0.5f) == 0);  // no number, whose weight is 0
    CHECK(power(4, 0.5f) == 2);
}

TEST_CASE("a formula's steps are IEEE operations, and a weight that is negative or no number is 0") {
    std::mt19937 random{59};
    int wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const float a = part(random) * 8, b = part(random) * 8 + 0.125f;
        wrong += of_two(WeightTerm::sum, a, b) != a + b;
        wrong += of_two(WeightTerm::difference, a, b) != std::max(a - b, 0.0f);
        wrong += of_two(WeightTerm::product, a, b) != a * b;
        wrong += of_two(WeightTerm::quotient, a, b) != a / b;
        wrong += of_two(WeightTerm::least, a, b) != (a < b ? a : b);
        wrong += of_two(WeightTerm::greatest, a, b) != (a < b ? b : a);
        const float cube = weight_by({.text = {}, .steps = {{WeightTerm::depth}, {WeightTerm::whole_power, 3}}},
                                     WeightInputs{.depth = a});
        wrong += cube != a * a * a;
    }
    CHECK(wrong == 0);
    CHECK(of_two(WeightTerm::quotient, 0, 0) == 0);
    CHECK(of_two(WeightTerm::quotient, 1, 0) == infinity);
}

TEST_CASE("steps that lack operands, leave several values or are too many are not complete") {
    const WeightStep one{WeightTerm::number, 1}, sum{WeightTerm::sum};
    const auto complete = [](std::vector<WeightStep> steps) { return is_complete({.text = {}, .steps = steps}); };
    CHECK(complete({one}));
    CHECK(complete({one, one, sum}));
    CHECK_FALSE(complete({}));
    CHECK_FALSE(complete({one, sum}));
    CHECK_FALSE(complete({one, one}));
    CHECK_FALSE(complete({{WeightTerm::negated}}));
    CHECK_FALSE(complete({one, {WeightTerm::whole_power, 9}}));
    CHECK_FALSE(complete({{static_cast<WeightTerm>(14)}}));
    std::vector<WeightStep> deep(9, one);
    for (int i = 0; i < 8; ++i) deep.push_back(sum);
    CHECK_FALSE(complete(deep));
    std::vector<WeightStep> longest{one};
    for (int i = 0; i < 63; ++i) longest.push_back({WeightTerm::negated});
    CHECK(complete(longest));
    longest.push_back({WeightTerm::negated});
    CHECK_FALSE(complete(longest));
}
