// Tests the codes of packed colours: every code of every channel is its own value's code, and the change from a code to
// the next lies exactly at the half between them, decided by integers and by an own decoder of short floats.
#include "pipeline/formats/packed.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace strata::testing::packed_codes {

namespace {

using namespace pipeline;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

constexpr ColorRounding exact{HalfRounding::nearest_even, UnormRounding::half_up};
constexpr ColorRounding product{HalfRounding::toward_zero, UnormRounding::product_even};

// The least positive binary32 up to 1 whose code is at least k, by bisection of the bits.
float first_of(Format format, int channel, std::uint32_t k, ColorRounding rounding) {
    std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);
    while (high - low > 1) {
        const std::uint32_t middle = (low + high) / 2;
        (packed_code(format, channel, std::bit_cast<float>(middle), rounding) >= k ? high : low) = middle;
    }
    return std::bit_cast<float>(high);
}

// The value of 5 bits of exponent and `bits` of mantissa, by its definition.
double short_float(std::uint32_t code, int bits) {
    const std::uint32_t exponent = code >> bits, mantissa = code & ((1u << bits) - 1);
    const double fraction = std::ldexp(mantissa, -bits);
    return exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1 + fraction, static_cast<int>(exponent) - 15);
}

}  // namespace

TEST_CASE("every code of rgb10_a2 is the code of its value under both roundings") {
    for (const ColorRounding rounding : {exact, product})
        for (int channel = 0; channel < 4; ++channel)
            for (std::uint32_t k = 0; k < 1024; k += channel == 3 ? 341 : 1) {
                const float value = packed_value(Format::rgb10_a2, channel, k, rounding);
                CHECK(std::abs(double{value} - k / 1023.0) <= 0x1p-23);
                CHECK(packed_code(Format::rgb10_a2, channel, value, rounding) == k);
            }
}

TEST_CASE("rgb10_a2 changes from one code to the next at the half between them, up") {
    for (const auto& [channel, greatest] : {std::pair{0, 1023}, std::pair{3, 3}})
        for (int k = 1; k <= greatest; ++k) {
            const auto code = static_cast<std::uint32_t>(k * (1023 / greatest));
            const float x = first_of(Format::rgb10_a2, channel, code, exact);
            // 2 n x is exact in binary64: 24 and 11 bits.
            CHECK(2.0 * greatest * double{x} >= 2 * k - 1);
            CHECK(2.0 * greatest * double{std::nextafter(x, 0.0f)} < 2 * k - 1);
        }
}

TEST_CASE("every code of r11g11b10f is the code of its value, and alpha is 1") {
    for (const ColorRounding rounding : {exact, product})
        for (int channel = 0; channel < 3; ++channel) {
            const int bits = channel == 2 ? 5 : 6;
            for (std::uint32_t k = 0; k < 31u << bits; ++k) {
                const std::uint32_t half = k << (10 - bits);
                const float value = packed_value(Format::r11g11b10f, channel, half, rounding);
                CHECK(double{value} == short_float(k, bits));
                CHECK(packed_code(Format::r11g11b10f, channel, value, rounding) == half);
            }
        }
    for (const float x : {0.0f, 0.3f, 7.0f, not_a_number})
        CHECK(packed_value(Format::r11g11b10f, 3, packed_code(Format::r11g11b10f, 3, x, exact), exact) == 1.0f);
}

TEST_CASE("a value between two codes of r11g11b10f goes to the nearest, the even one at the half, or toward zero") {
    for (int channel = 0; channel < 3; ++channel) {
        const int bits = channel == 2 ? 5 : 6;
        for (std::uint32_t k = 0; k + 1 < 31u << bits; ++k) {
            // The half needs one more bit than the codes, so it is exact.
            const auto half = static_cast<float>((short_float(k, bits) + short_float(k + 1, bits)) / 2);
            const auto nearest = [&](float x) {
                return packed_code(Format::r11g11b10f, channel, x, exact) >> (10 - bits);
            };
            CHECK(nearest(std::nextafter(half, 0.0f)) == k);
            CHECK(nearest(half) == k + (k & 1u));
            CHECK(nearest(std::nextafter(half, infinity)) == k + 1);
            const auto next = static_cast<float>(short_float(k + 1, bits));
            CHECK(packed_code(Format::r11g11b10f, channel, std::nextafter(next, 0.0f), product) >> (10 - bits) == k);
        }
    }
}

TEST_CASE("out of the range of r11g11b10f values become 0 or the greatest number and infinity and NaN stay") {
    for (const ColorRounding rounding : {exact, product})
        for (int channel = 0; channel < 3; ++channel) {
            const auto value = [&](float x) {
                return packed_value(Format::r11g11b10f, channel, packed_code(Format::r11g11b10f, channel, x, rounding),
                                    rounding);
            };
            const float greatest = channel == 2 ? 64512.0f : 65024.0f;
            for (const float x : {-0.0f, -1.0f, -1e30f, -infinity}) CHECK(value(x) == 0.0f);
            for (const float x : {greatest, 65535.0f, 65536.0f, 1e30f}) CHECK(value(x) == greatest);
            CHECK(value(infinity) == infinity);
            CHECK(std::isnan(value(not_a_number)));
            CHECK(std::isnan(value(-not_a_number)));
            CHECK_FALSE(std::signbit(value(-not_a_number)));
        }
}

TEST_CASE("srgb8_alpha8 keeps every code, encodes colours and not alpha, and clamps") {
    for (const ColorRounding rounding : {exact, product})
        for (std::uint32_t k = 0; k < 256; ++k)
            for (int channel = 0; channel < 4; ++channel)
                CHECK(packed_code(Format::srgb8_alpha8, channel,
                                  packed_value(Format::srgb8_alpha8, channel, k, rounding), rounding) == k);
    // 0.5 in light is 187.516 / 255 encoded (IEC 61966-2-1), 127.5 / 255 not encoded.
    CHECK(packed_code(Format::srgb8_alpha8, 1, 0.5f, exact) == 188);
    CHECK(packed_code(Format::srgb8_alpha8, 3, 0.5f, exact) == 128);
    for (int channel = 0; channel < 4; ++channel) {
        for (const float x : {-1.0f, -infinity, not_a_number})
            CHECK(packed_code(Format::srgb8_alpha8, channel, x, exact) == 0);
        for (const float x : {1.0f, 2.0f, infinity}) CHECK(packed_code(Format::srgb8_alpha8, channel, x, exact) == 255);
    }
}

}  // namespace strata::testing::packed_codes
