// Tests the comparison of codes of different formats. Quotients of integers are compared by cross products; distances
// of floats are counted with nextafter.
#include "tools/oracle/picture/codes.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

using namespace strata::oracle;

namespace {

std::uint32_t bits_of(float v) { return std::bit_cast<std::uint32_t>(v); }

}  // namespace

TEST_CASE("an 8-bit and a 16-bit code are equal exactly where their quotients are equal") {
    int wrong = 0;
    for (std::uint64_t a = 0; a < 256; ++a)
        for (std::uint64_t b = 0; b < 65536; ++b) {
            const bool equal = a * 65535 == b * 255;
            const StoredCode narrow{Code::unorm8, static_cast<std::uint32_t>(a)};
            const StoredCode wide{Code::unorm16, static_cast<std::uint32_t>(b)};
            if (is_equal(narrow, wide) != equal || is_equal(wide, narrow) != equal) ++wrong;
        }
    CHECK(wrong == 0);
}

TEST_CASE("each 8-bit value equals the nearest binary32 and the nearest half and no others") {
    for (std::uint32_t k = 0; k < 256; ++k) {
        int halves = 0;
        for (std::uint32_t half = 0; half <= 0x3c00; ++half)
            halves += is_equal({Code::unorm8, k}, {Code::half, half}) ? 1 : 0;
        CHECK(halves == 1);
        const float own = static_cast<float>(static_cast<double>(k) / 255);
        CHECK(is_equal({Code::unorm8, k}, {Code::single, bits_of(own)}));
        CHECK_FALSE(is_equal({Code::unorm8, k}, {Code::single, bits_of(std::nextafter(own, 2.0f))}));
        CHECK(distance({Code::unorm8, k}, {Code::single, bits_of(std::nextafter(own, 2.0f))}) == 1);
    }
}

TEST_CASE("the distance of two floats is the number of steps between them") {
    float to = -0x1p-149f * 3;
    for (std::uint32_t steps = 0; steps < 8; ++steps) {
        // Between -0 and +0 is one step that nextafter does not make.
        const std::uint32_t over_zero = to >= 0 ? 1 : 0;
        CHECK(distance({Code::single, bits_of(-0x1p-149f * 3)}, {Code::single, bits_of(to)}) == steps + over_zero);
        to = std::nextafter(to, 1.0f);
        if (to == 0) to = 0.0f;
    }
    CHECK(distance({Code::single, bits_of(-0.0f)}, {Code::single, bits_of(0.0f)}) == 1);
    CHECK(distance({Code::half, 0x3bff}, {Code::half, 0x3c01}) == 2);
}

TEST_CASE("a 24-bit depth equals the float that is nearest to it and no other") {
    for (const std::uint32_t code : {0u, 1u, 2u, 4095u, 8388607u, 8388608u, 12345678u, 16777214u, 16777215u}) {
        const float own = static_cast<float>(static_cast<double>(code) / 16777215);
        CHECK(is_equal({Code::unorm24, code}, {Code::single, bits_of(own)}));
        CHECK_FALSE(is_equal({Code::unorm24, code}, {Code::single, bits_of(std::nextafter(own, 2.0f))}));
    }
    CHECK(distance({Code::unorm24, 1000}, {Code::single, bits_of(static_cast<float>(1003.0 / 16777215))}) == 3);
}

TEST_CASE("integers are compared as codes and a NaN is equal to its own bits only") {
    CHECK(is_equal({Code::unorm24, 7}, {Code::integer, 7}));
    CHECK(distance({Code::unorm24, 7}, {Code::integer, 9}) == 2);
    CHECK(is_equal({Code::single, 0x7fc00001}, {Code::single, 0x7fc00001}));
    CHECK(distance({Code::single, 0x7fc00001}, {Code::single, 0x7fc00002}) == 0xffffffff);
    CHECK(distance({Code::unorm8, 3}, {Code::single, 0x7fc00000}) == 0xffffffff);
}
