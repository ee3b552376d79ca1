// Tests the sRGB conversions against the formulas of IEC 61966-2-1 in 60 decimal digits (MPFR).
#include "pipeline/formats/srgb.h"

#include <array>
#include <bit>
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "scenes/numbers/srgb_encode.h"

namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<60>>;

Wide decoded(const Wide& e) {
    return e <= Wide{"0.04045"} ? Wide(e / Wide{"12.92"}) : Wide(pow((e + Wide{"0.055"}) / Wide{"1.055"}, Wide{"2.4"}));
}
Wide encoded(const Wide& l) {
    return l <= Wide{"0.0031308"} ? Wide(l * Wide{"12.92"})
                                  : Wide(Wide{"1.055"} * pow(l, 1 / Wide{"2.4"}) - Wide{"0.055"});
}

// True if |answer - exact| is at most half the distance to either neighbour.
bool is_nearest(float answer, const Wide& exact) {
    const Wide error = abs(Wide{answer} - exact);
    const Wide up = Wide{std::nextafter(answer, 2.0f)} - Wide{answer},
               down = Wide{answer} - Wide{std::nextafter(answer, -1.0f)};
    return 2 * error <= up && 2 * error <= down;
}

float one_ulp_below(float x) { return std::nextafter(x, -1.0f); }

}  // namespace

TEST_CASE("every entry of the sRGB table is the binary32 nearest to the standard's value") {
    int wrong = 0;
    for (int k = 0; k < 256; ++k)
        wrong +=
            is_nearest(strata::pipeline::srgb_to_linear[static_cast<std::size_t>(k)], decoded(Wide{k} / 255)) ? 0 : 1;
    CHECK(wrong == 0);
}

TEST_CASE("decoding an 8-bit code and encoding it again gives the same code") {
    for (int k = 0; k < 256; ++k)
        CHECK(int{strata::scenes::encode_srgb8(strata::pipeline::srgb_to_linear[std::size_t(k)])} == k);
}

TEST_CASE("encode_srgb8 changes from one code to the next exactly where the encoding passes the half") {
    int wrong = 0;
    for (int k = 1; k < 256; ++k) {
        float low = 0, high = 1;  // bisects the interval that contains the change of the tested code
        while (std::bit_cast<std::uint32_t>(high) - std::bit_cast<std::uint32_t>(low) > 1) {
            const auto middle =
                std::bit_cast<float>((std::bit_cast<std::uint32_t>(low) + std::bit_cast<std::uint32_t>(high)) / 2);
            (strata::scenes::encode_srgb8(middle) >= k ? high : low) = middle;
        }
        const Wide half = Wide{2 * k - 1} / 510;
        if (!(encoded(Wide{high}) >= half && encoded(Wide{one_ulp_below(high)}) < half)) ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("encode_srgb and decode_srgb are within 0.50001 units of the last place") {
    int wrong_encode = 0, wrong_decode = 0;
    for (std::uint32_t bits = 0x38000000; bits <= std::bit_cast<std::uint32_t>(1.0f); bits += 3989) {
        const auto x = std::bit_cast<float>(bits);
        const auto off = [&](float answer, const Wide& exact) {
            return abs(Wide{answer} - exact) > Wide{0.50001} * (std::nextafter(answer, 2.0f) - answer);
        };
        wrong_encode += off(strata::scenes::encode_srgb(x), encoded(Wide{x})) ? 1 : 0;
        wrong_decode += off(strata::scenes::decode_srgb(x), decoded(Wide{x})) ? 1 : 0;
    }
    CHECK(wrong_encode == 0);
    CHECK(wrong_decode == 0);
}

TEST_CASE("encoding clamps so that NaN and values below 0 become 0 and values above 1 become 1") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float x : {nan, -1.0f, -infinity, -0.0f, 0.0f}) {
        CHECK(strata::scenes::encode_srgb(x) == 0);
        CHECK(strata::scenes::decode_srgb(x) == 0);
        CHECK(int{strata::scenes::encode_srgb8(x)} == 0);
    }
    for (const float x : {1.0f, 2.0f, infinity}) {
        CHECK(strata::scenes::encode_srgb(x) == 1);
        CHECK(strata::scenes::decode_srgb(x) == 1);
        CHECK(int{strata::scenes::encode_srgb8(x)} == 255);
    }
}

TEST_CASE("a colour changes only between spaces and its alpha never") {
    using strata::pipeline::ColorSpace;
    const strata::pipeline::Rgba color{0.5f, 0.0f, 1.0f, 0.25f};
    CHECK(strata::scenes::from_encoded(color, ColorSpace::encoded) == color);
    CHECK(strata::scenes::from_linear(color, ColorSpace::linear) == color);
    const strata::pipeline::Rgba half_decoded{strata::scenes::decode_srgb(0.5f), 0.0f, 1.0f, 0.25f};
    CHECK(strata::scenes::from_encoded(color, ColorSpace::linear) == half_decoded);
    CHECK(strata::scenes::from_linear(color, ColorSpace::encoded)[3] == 0.25f);
}

TEST_CASE("encode_srgb8 is the code of the exact encoding for every binary32 from 0 to 1", "[exhaustive]") {
    std::array<float, 256> first{};  // the expected thresholds, by bisection on the exact encoding
    for (int k = 1; k < 256; ++k) {
        std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);
        while (high - low > 1) {
            const std::uint32_t middle = (low + high) / 2;
            (encoded(Wide{std::bit_cast<float>(middle)}) * 510 >= 2 * k - 1 ? high : low) = middle;
        }
        first[std::size_t(k)] = std::bit_cast<float>(high);
    }
    std::uint32_t wrong = 0, code = 0;
    for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(1.0f); ++bits) {
        const auto x = std::bit_cast<float>(bits);
        while (code < 255 && x >= first[code + 1]) ++code;
        if (strata::scenes::encode_srgb8(x) != code) ++wrong;
    }
    CHECK(wrong == 0);
}
