// Tests the D24F format in rational arithmetic: a code has 8 bits of exponent e and 16 of mantissa m; its value is 2^(e
// - 127) (1 + m / 65536), or 0 for e = 0.
#include <catch2/catch.hpp>
#include <limits>

#include "rasterizer/rules/depth_code.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] Rational d24f_meaning(std::uint32_t code) {
    const int exponent = static_cast<int>(code / 65536);
    return exponent == 0 ? Rational{0} : Rational{power(exponent - 127) * (1 + Rational{code % 65536, 65536})};
}

}  // namespace

TEST_CASE("a D24F code has the value of its eight exponent and sixteen mantissa bits and that value has the code") {
    std::uint32_t wrong = 0, first = 0;
    for (std::uint32_t code = 0x10000; code <= 0xfeffff; code += 977) {
        const Rational value = d24f_meaning(code);
        const bool holds = Rational{d24f_value(code)} == value && to_d24f_code(d24f_value(code)) == code;
        if (!holds && wrong++ == 0) first = code;
    }
    INFO("first wrong: " << std::hex << first);
    CHECK(wrong == 0);
    CHECK(d24f_value(0) == 0.0);
}

TEST_CASE(
    "a value is truncated to a D24F code with 0 below the smallest normal one and the last finite one above the range",
    "[slow]") {
    Random random{91};
    std::uint32_t wrong = 0;
    for (int n = 0; n < 20000; ++n) {
        const auto bits = static_cast<std::uint32_t>(random_int(random, 0x00800000, 0x7f7fffff));
        const float v = std::bit_cast<float>(bits);
        const std::uint32_t code = to_d24f_code(v);
        wrong += d24f_meaning(code) <= Rational{v} && Rational{v} < d24f_meaning(code + 1) ? 0 : 1;
    }
    CHECK(wrong == 0);
    for (const double nothing : {0.0, -0.0, -1.0, 0x1p-127, std::numeric_limits<double>::quiet_NaN()})
        CHECK(to_d24f_code(nothing) == 0);
    for (const double beyond : {0x1.fffffep127, 0x1p128, std::numeric_limits<double>::infinity()})
        CHECK(to_d24f_code(beyond) == 0xfeffff);
    CHECK(to_d24f_code(0x1p-126) == 0x10000);
}

TEST_CASE("depth 1 of D24F is 1e30 and its code is the greatest of any depth") {
    CHECK(max_code(DepthFormat::d24f) == 0xe293e5);
    for (const DepthRounding rounding : {DepthRounding::floor, DepthRounding::nearest, DepthRounding::product_even}) {
        CHECK(to_depth_code(1.0f, DepthFormat::d24f, rounding) == 0xe293e5);
        CHECK(to_depth_code(2.0f, DepthFormat::d24f, rounding) == 0xe293e5);
        CHECK(to_depth_code(0.0f, DepthFormat::d24f, rounding) == 0);
    }
    CHECK(depth_value(0xe293e5, DepthFormat::d24f) == Approx(1.0).epsilon(0x1p-16));
}
