// Tests depth keys against the order of binary32 numbers: a key must reverse the order and be its own inverse.
#include "rasterizer/rules/depth_key.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using strata::rasterizer::depth_key;

namespace {

constexpr std::uint32_t one_code = 0x3f800000u, least_normal_code = 0x00800000u;

float float_of(std::uint32_t bits) { return std::bit_cast<float>(bits); }

}  // namespace

static_assert(depth_key(0u) == one_code && depth_key(one_code) == 0u);
static_assert(depth_key(0x3f7fffffu) == least_normal_code, "the number before 1 has the least normal key");
static_assert(depth_key(0.0f) == 1.0f && depth_key(1.0f) == 0.0f);

TEST_CASE("keys of stored depths reverse the order and a key's key is the depth") {
    std::mt19937 random{1};
    std::uint64_t wrong = 0;
    std::uint32_t first = 0;
    const auto check = [&](std::uint32_t a, std::uint32_t b) {
        const bool turns = (a < b) == (depth_key(a) > depth_key(b)), returns = depth_key(depth_key(a)) == a;
        const bool fits = depth_key(a) == 0 || (depth_key(a) >= least_normal_code && depth_key(a) <= one_code);
        const bool is_same = std::bit_cast<std::uint32_t>(depth_key(float_of(a))) == depth_key(a);
        if (turns && returns && fits && is_same) return;
        if (wrong++ == 0) first = a;
    };
    // Neighbours at both ends, at every power of two, and a million random values.
    for (std::uint32_t exponent = 1; exponent <= 127; ++exponent)
        for (std::uint32_t step = 0; step < 64; ++step) {
            const std::uint32_t code = (exponent << 23) - 32 + step;
            if (code >= least_normal_code && code < one_code) check(code, code + 1);
        }
    for (int i = 0; i < 1'000'000; ++i) {
        const std::uint32_t a = least_normal_code + random() % (one_code - least_normal_code + 1);
        check(a, least_normal_code + random() % (one_code - least_normal_code + 1));
    }
    CAPTURE(first);
    CHECK(wrong == 0);
    for (const std::uint32_t denormal : {1u, 0x00000100u, 0x007fffffu}) CHECK(depth_key(denormal) == one_code);
}

TEST_CASE("keys also reverse the order of depths beyond the range") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float rising[] = {-infinity, -3e38f, -2.0f,  -1.0f, -0x1p-126f, 0.0f, 0x1p-126f, 0.25f,
                            0.5f,      0.75f,  0.999f, 1.0f,  1.0000001f, 2.0f, 3e38f,     infinity};
    for (std::size_t i = 0; i + 1 < std::size(rising); ++i) {
        INFO(rising[i]);
        CHECK(depth_key(rising[i]) >= depth_key(rising[i + 1]));
        const bool saturates = rising[i] < -0x1p+120f;
        if (!saturates) CHECK(depth_key(rising[i]) > depth_key(rising[i + 1]));
        if (!saturates) CHECK(depth_key(depth_key(rising[i])) == rising[i]);
    }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(std::isnan(depth_key(nan)));
    CHECK(depth_key(-0.0f) == 1.0f);
}
