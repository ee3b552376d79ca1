// Tests depths with polygon offset against exact rational sums and products, each truncated toward zero to 24 bits.
#include "rasterizer/chip/offset_value.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

// A number of either sign with at most `bits` significant bits, whose last one is near 2^unit.
double number_of_bits(Random& random, int bits, int unit) {
    const auto digits = static_cast<double>(random() >> (64 - bits));
    const bool is_negative = (random() & 1) != 0;
    return std::ldexp(is_negative ? -digits : digits, unit);
}

Rational truncate_24(const Rational& v) { return truncate_to_bits(v, 24); }

}  // namespace

TEST_CASE("a 24-bit sum plus a tiny term is truncated to the previous number only if the term points toward zero") {
    const float one = 1.0f, before = std::nextafter(one, 0.0f);
    for (const double sign : {1.0, -1.0}) {
        CHECK(truncate_sum_24({sign, sign * 0x1p-60}) == sign * one);
        CHECK(truncate_sum_24({sign, sign * -0x1p-60}) == sign * before);
        CHECK(truncate_sum_24({sign, 0.0}) == sign * one);
    }
}

TEST_CASE("the chip's offset and the offset depth are exact sums truncated to 24 bits for random values of all sizes",
          "[slow]") {
    Random random{2041};
    int wrong = 0, with_hair = 0;
    for (int i = 0; i < 20000; ++i) {
        const int unit = random_int(random, -40, 10), offset_unit = random_int(random, -60, 10);
        const double value = number_of_bits(random, random_int(random, 1, 40), unit);
        const double offset = number_of_bits(random, 24, offset_unit);
        const TwoTerms terms = two_sum(value, offset);
        with_hair += terms.low != 0.0 ? 1 : 0;
        wrong += Rational{truncate_sum_24(terms)} != truncate_24(Rational{value} + Rational{offset}) ? 1 : 0;
        const Rational moved = truncate_24(truncate_24(Rational{terms.high} + Rational{terms.low}) + Rational{offset});
        wrong += Rational{offset_value(terms, offset)} != moved ? 1 : 0;

        PolygonOffset state{.enabled = true};
        const int factor_unit = random_int(random, -30, 0), bias_unit = random_int(random, -30, 0);
        state.factor = static_cast<float>(number_of_bits(random, random_int(random, 1, 24), factor_unit));
        state.units = static_cast<float>(number_of_bits(random, random_int(random, 1, 24), bias_unit));
        const Rational sloped = truncate_24(truncate_24(Rational{value}) * Rational{state.factor});
        wrong += Rational{chip_offset(value, state)} != truncate_24(sloped + Rational{state.units}) ? 1 : 0;
        state.enabled = false;
        wrong += chip_offset(value, state) != 0.0 ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(with_hair > 1000);
}
