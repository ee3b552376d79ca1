// Tests the UNORM8 conversions against the inequalities of tests/pipeline/format_models.h.
#include "pipeline/formats/unorm8.h"

#include <catch2/catch.hpp>

#include "tests/pipeline/exhaustive.h"
#include "tests/pipeline/format_models.h"
#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;

TEST_CASE("every UNORM8 code is k/255 correctly rounded and converts back to itself") {
    int wrong = 0;
    for (int k = 0; k < 256; ++k) {
        const float value = from_unorm8(static_cast<std::uint8_t>(k));
        // |value - k/255| is at most half a step to either neighbour, multiplied by 510 * 2^150: 255 (2 v -+ ulp)
        // against 510 k.
        const model::Binary v = model::magnitude(bits_of(value));
        const model::Wide twice = model::Wide{2} * 255 * v.mantissa;
        const model::Wide target = k == 0 ? 0 : (model::Wide{2} * k) << -v.exponent;
        const model::Wide distance = twice > target ? twice - target : target - twice;
        const bool is_rounded = k == 0 ? bits_of(value) == 0 : distance <= 255;
        wrong +=
            is_rounded && to_unorm8(value) == k && bits_of(unorm8_table[static_cast<std::size_t>(k)]) == bits_of(value)
                ? 0
                : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a float becomes the nearest UNORM8 code with ties up and NaN as 0 and values outside of 0 to 1 clamped") {
    Tally tally;
    const auto check = [&](std::uint32_t bits) {
        const int code = to_unorm8(float_of(bits));
        tally.expect(model::is_unorm8(bits, code), [&] { return fmt::format("{:08x} -> {}", bits, code); });
    };
    for (const std::uint32_t bits : hard_bits) check(bits);
    for (int k = 0; k < 256; ++k)
        for (std::uint32_t i = 0; i < 9; ++i) check(bits_of(static_cast<float>(2 * k + 1) / 510.0f) + i - 4);
    for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 4099) check(static_cast<std::uint32_t>(bits));
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(to_unorm8(0.5f) == 128);  // 127.5
}

TEST_CASE("product_even rounds 255 x in binary32 first and then to the nearest code with ties to even") {
    Tally tally;
    std::uint64_t unlike_half_up = 0;
    const auto check = [&](float x) {
        // 255 x has at most 32 bits, so it is exact in binary64; the cast rounds it to binary32, and the code is found
        // by comparison.
        const double product = double{static_cast<float>(double{x} * 255.0)};
        int code = 0;
        while (code < 255 && (product > code + 0.5 || (product == code + 0.5 && code % 2 == 1))) ++code;
        tally.expect(
            to_unorm8<UnormRounding::product_even>(x) == code && to_unorm8(x, UnormRounding::product_even) == code,
            [&] { return fmt::format("{:08x} -> {}", bits_of(x), code); });
        unlike_half_up += to_unorm8(x) == code ? 0 : 1;
    };
    for (int k = 0; k < 255; ++k)
        for (std::uint32_t i = 0; i < 9; ++i) check(float_of(bits_of(static_cast<float>(2 * k + 1) / 510.0f) + i - 4));
    for (std::uint32_t bits = 0; bits < 0x3f800000u; bits += 100003) check(float_of(bits));
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(unlike_half_up > 100);
    CHECK(to_unorm8<UnormRounding::product_even>(0.3f) == 76);  // measured on the driver
    CHECK(to_unorm8(0.3f) == 77);
    CHECK(to_unorm8<UnormRounding::product_even>(-1.0f) == 0);
    CHECK(to_unorm8<UnormRounding::product_even>(float_of(0x7fc00000u)) == 0);
    CHECK(to_unorm8<UnormRounding::product_even>(float_of(0x7f800000u)) == 255);
}

TEST_CASE("every one of the 2^32 floats becomes the right UNORM8 code", "[exhaustive]") {
    const Exhausted result =
        over_all_floats([](std::uint32_t bits) { return model::is_unorm8(bits, to_unorm8(float_of(bits))); });
    INFO("first wrong: " << fmt::format("{:08x}", result.first));
    CHECK(result.wrong == 0);
}
