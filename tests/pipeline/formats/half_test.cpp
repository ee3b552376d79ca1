// Tests the half conversions against the inequalities of tests/pipeline/format_models.h.
#include "pipeline/formats/half.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/pipeline/exhaustive.h"
#include "tests/pipeline/format_models.h"
#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;

namespace {

std::uint16_t nearest(std::uint32_t bits) { return to_half<HalfRounding::nearest_even>(float_of(bits)); }
std::uint16_t toward_zero(std::uint32_t bits) { return to_half<HalfRounding::toward_zero>(float_of(bits)); }

// Calls body with the neighbourhood of each half, and with every 4,099th bit pattern (a prime).
template <class Body>
void for_many_floats(Body&& body) {
    for (std::uint32_t half = 0; half < 0x10000; ++half)
        for (std::uint32_t offset = 0; offset < 5; ++offset)
            for (const std::uint32_t middle : {0u, 0x1000u})
                body(bits_of(half_to_float(static_cast<std::uint16_t>(half))) + middle + offset - 2);
    for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 4099) body(static_cast<std::uint32_t>(bits));
    for (const std::uint32_t bits : hard_bits) body(bits);
}

}  // namespace

TEST_CASE("every half becomes the binary32 value of its definition and a NaN keeps sign and payload") {
    int wrong = 0;
    for (std::uint32_t half = 0; half < 0x10000; ++half) {
        const float value = half_to_float(static_cast<std::uint16_t>(half));
        const auto e = static_cast<int>(half >> 10 & 0x1f), m = static_cast<int>(half & 0x3ff);
        const double sign = (half & 0x8000) != 0 ? -1.0 : 1.0;
        bool holds = false;
        if (e == 31) {
            holds = bits_of(value) == ((half & 0x8000) << 16 | 0x7f800000u | static_cast<std::uint32_t>(m) << 13);
        } else {
            const double expected = sign * (e == 0 ? std::ldexp(m, -24) : std::ldexp(1024 + m, e - 25));
            holds = double{value} == expected && std::signbit(value) == std::signbit(expected);
        }
        wrong += holds ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a half is unchanged by a round trip through binary32 except that a signalling NaN becomes quiet") {
    int wrong = 0;
    for (std::uint32_t half = 0; half < 0x10000; ++half) {
        const bool is_nan_code = (half & 0x7fff) > 0x7c00;
        const std::uint32_t expected = is_nan_code ? half | 0x200 : half;
        const std::uint32_t bits = bits_of(half_to_float(static_cast<std::uint16_t>(half)));
        wrong += nearest(bits) == expected && toward_zero(bits) == expected ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a float becomes the nearest half with ties to even") {
    Tally tally;
    for_many_floats([&](std::uint32_t bits) {
        tally.expect(model::is_nearest_half(bits, nearest(bits)),
                     [&] { return fmt::format("{:08x} -> {:04x}", bits, nearest(bits)); });
    });
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("toward zero a float becomes the largest half not above its magnitude and overflow gives 65504") {
    Tally tally;
    for_many_floats([&](std::uint32_t bits) {
        tally.expect(model::is_half_toward_zero(bits, toward_zero(bits)),
                     [&] { return fmt::format("{:08x} -> {:04x}", bits, toward_zero(bits)); });
    });
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
}

TEST_CASE("without infinity there is one more binade and a float beyond it becomes the largest code") {
    const auto without = [](std::uint32_t bits) { return to_half<HalfRounding::no_infinity>(float_of(bits)); };
    Tally tally;
    for_many_floats([&](std::uint32_t bits) {
        tally.expect(model::is_half_without_infinity(bits, without(bits)),
                     [&] { return fmt::format("{:08x} -> {:04x}", bits, without(bits)); });
    });
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(without(bits_of(65520.0f)) == 0x7c00);
    CHECK(without(bits_of(-131039.99f)) == 0xffff);
    CHECK(without(0x7f800000) == 0x7fff);
    CHECK(without(0xffc00000) == 0xffff);
    CHECK(without(0x7fffffff) == 0xffff);
    // The lowest digits of 2^-25 (1 + 2^-23) are dropped before rounding, which makes it a midpoint.
    CHECK(without(bits_of(0x1.000002p-25f)) == 0);
    CHECK(nearest(bits_of(0x1.000002p-25f)) == 1);
    int wrong = 0;
    for (std::uint32_t half = 0; half < 0x10000; ++half) {
        const double size = static_cast<double>(model::half_units(half & 0x7fff)) * 0x1p-24;
        const double value = (half & 0x8000) != 0 ? -size : size;
        const auto found = half_value<HalfRounding::no_infinity>(static_cast<std::uint16_t>(half));
        wrong += double{found} == value && std::signbit(found) == std::signbit(value) ? 0 : 1;
        wrong += without(bits_of(found)) == half ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("to nearest a float from 65520 on overflows to infinity") {
    CHECK(nearest(bits_of(65519.996f)) == 0x7bff);
    CHECK(nearest(bits_of(65520.0f)) == 0x7c00);
    CHECK(nearest(bits_of(-65520.0f)) == 0xfc00);
    CHECK(toward_zero(bits_of(65520.0f)) == 0x7bff);
    CHECK(toward_zero(bits_of(3e38f)) == 0x7bff);
    CHECK(toward_zero(0xff800000) == 0xfc00);
}

TEST_CASE("a fragment counter in fp16 stops at 2048 under both roundings") {
    for (const HalfRounding rounding : {HalfRounding::nearest_even, HalfRounding::toward_zero}) {
        std::uint16_t count = 0;
        for (int i = 0; i < 3000; ++i) count = to_half(half_to_float(count) + 1.0f, rounding);
        CHECK(half_to_float(count) == 2048.0f);
    }
}

TEST_CASE("every one of the 2^32 floats becomes the right half under both roundings", "[exhaustive]") {
    const Exhausted even =
        over_all_floats([](std::uint32_t bits) { return model::is_nearest_half(bits, nearest(bits)); });
    INFO("first wrong: " << fmt::format("{:08x}", even.first));
    CHECK(even.wrong == 0);
    const Exhausted zero =
        over_all_floats([](std::uint32_t bits) { return model::is_half_toward_zero(bits, toward_zero(bits)); });
    INFO("first wrong: " << fmt::format("{:08x}", zero.first));
    CHECK(zero.wrong == 0);
}
