// Tests the D16F format in rational arithmetic: a code has 4 bits of exponent e and 12 of mantissa m; its value is 2^(e
// - 7) (1 + m / 4096), or 0 for e = 0.
#include <bit>
#include <catch2/catch.hpp>
#include <limits>

#include "rasterizer/rules/depth_code.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

[[nodiscard]] Rational d16f_meaning(std::uint32_t code) {
    const int exponent = static_cast<int>(code / 4096);
    if (exponent == 0) return 0;
    return power(exponent - 7) * (Rational{1} + Rational{code % 4096, 4096});
}

// The largest code whose value is at most v, by bisection; of codes with value 0, code 0.
[[nodiscard]] std::uint32_t d16f_model(const Rational& v) {
    std::uint32_t low = 0, high = 0x10000;
    while (high - low > 1) {
        const std::uint32_t middle = (low + high) / 2;
        (d16f_meaning(middle) <= v ? low : high) = middle;
    }
    return low < 0x1000 ? 0 : low;
}

}  // namespace

TEST_CASE("a D16F code has the value of its four exponent and twelve mantissa bits and that value has the code",
          "[slow]") {
    std::uint32_t wrong = 0, first = 0;
    for (std::uint32_t code = 0x1000; code <= 0xffff; ++code) {
        const Rational value = d16f_meaning(code);
        const float found = d16f_value(code);
        const bool holds = Rational{found} == value && to_d16f_code(found) == code;
        if (!holds && wrong++ == 0) first = code;
    }
    INFO("first wrong: " << std::hex << first);
    CHECK(wrong == 0);
    CHECK(d16f_value(0) == 0.0f);
    CHECK(d16f_value(0xffff) == 511.9375f);
    CHECK(max_d16f == 511.9375f);
}

TEST_CASE("a float is truncated to the next lower D16F code and to 0 below the smallest normal one", "[slow]") {
    std::uint32_t wrong = 0, first = 0;
    for (std::uint32_t code = 0x1000; code <= 0xffff; code += 3) {
        const auto bits = std::bit_cast<std::uint32_t>(nearest_float(d16f_meaning(code)));
        const std::uint32_t before = code == 0x1000 ? 0 : code - 1;
        const bool holds = to_d16f_code(std::bit_cast<float>(bits)) == code &&
                           to_d16f_code(std::bit_cast<float>(bits + 0x7ff)) == code &&
                           to_d16f_code(std::bit_cast<float>(bits - 1)) == before;
        if (!holds && wrong++ == 0) first = code;
    }
    INFO("first wrong: " << std::hex << first);
    CHECK(wrong == 0);
    for (const float nothing : {0.0f, -0.0f, -1.0f, -1e30f, 0x1p-149f, 0x1p-7f, std::numeric_limits<float>::quiet_NaN(),
                                -std::numeric_limits<float>::infinity()})
        CHECK(to_d16f_code(nothing) == 0);
    for (const float beyond : {511.9375f, 512.0f, 65535.0f, 3e38f, std::numeric_limits<float>::infinity()})
        CHECK(to_d16f_code(beyond) == 0xffff);
}

TEST_CASE("depth 1 is the greatest D16F value and a depth is its product with it truncated under either rounding",
          "[slow]") {
    Random random{611};
    std::uint64_t wrong = 0;
    float first = 0;
    for (int n = 0; n < 4000; ++n) {
        const float z = n % 4 == 0 ? random_float(random, 0, 0x1p-12f) : random_float(random, 0, 1);
        const Rational product = Rational{z} * Rational{8191, 16};
        const std::uint32_t expected = d16f_model(product);
        // Skips products that binary32 rounds up to the next code: one in 4,096.
        if (d16f_model(Rational{nearest_float(product)}) != expected) continue;
        for (const DepthRounding rounding : {DepthRounding::floor, DepthRounding::nearest})
            if (to_depth_code(z, DepthFormat::d16f, rounding) != expected && wrong++ == 0) first = z;
    }
    INFO("first wrong: " << std::hexfloat << first);
    CHECK(wrong == 0);
    for (const float z : {1.0f, 1.5f, std::numeric_limits<float>::infinity()})
        CHECK(to_depth_code(z, DepthFormat::d16f, DepthRounding::floor) == 0xffff);
    for (const float z : {0.0f, -0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()})
        CHECK(to_depth_code(z, DepthFormat::d16f, DepthRounding::nearest) == 0);
}

TEST_CASE("a code of any depth format is read back as its fraction of depth 1 rounded once to binary64", "[slow]") {
    std::uint64_t wrong = 0;
    const auto near53 = [](const Rational& v, double found) {  // at most half a unit in 53 bits
        return abs(Rational{found} - v) <= power(floor_log2(v) - 53);
    };
    for (std::uint32_t code = 0x1000; code <= 0xffff; code += 7) {
        wrong += near53(d16f_meaning(code) / Rational{8191, 16}, depth_value(code, DepthFormat::d16f)) ? 0 : 1;
        wrong += near53(Rational{code, 65535}, depth_value(code, DepthFormat::d16)) ? 0 : 1;
        wrong += near53(Rational{code * 251, 16777215}, depth_value(code * 251, DepthFormat::d24)) ? 0 : 1;
    }
    CHECK(wrong == 0);
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f, DepthFormat::d16f}) {
        CHECK(depth_value(max_code(format), format) == 1.0);
        CHECK(depth_value(0, format) == 0.0);
        CHECK(to_depth_code(1.0f, format, DepthRounding::floor) == max_code(format));
    }
    CHECK(depth_value(std::bit_cast<std::uint32_t>(0.1f), DepthFormat::d32f) == double{0.1f});
}

static_assert(max_code(DepthFormat::d16) == 65535 && max_code(DepthFormat::d16f) == 65535);
static_assert(max_code(DepthFormat::d24) == 16777215 && max_code(DepthFormat::d32f) == 0x3f800000);
