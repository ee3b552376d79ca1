// Fails if the build contracts into fused multiply-add, reassociates, keeps excess precision or flushes denormals.
#include "rasterizer/base/numerics.h"

#include <catch2/catch.hpp>
#include <limits>

TEST_CASE("a product and a sum are rounded separately") {
    volatile float a = 1.0f + 0x1p-12f, c = -(1.0f + 0x1p-11f);
    const float x = a, z = c;
    CHECK(x * x + z == 0.0f);  // fused: 2^-24
    volatile double b = 1.0 + 0x1p-27, d = -(1.0 + 0x1p-26);
    const double y = b, w = d;
    CHECK(y * y + w == 0.0);  // fused: 2^-54
}

TEST_CASE("sums keep their order and their precision") {
    volatile float large = 0x1p24f, one = 1.0f;
    const float l = large, o = one;
    CHECK((l + o) - l == 0.0f);  // 1 in excess precision or after reassociation
    CHECK((o - l) + l == 1.0f);
    CHECK((l + o) + o == l);
}

TEST_CASE("special values and denormals are kept") {
    volatile float zero = 0.0f, tiny = std::numeric_limits<float>::min();
    const float z = zero, t = tiny;
    const float nan = z / z;
    CHECK(nan != nan);
    CHECK(1.0f / -z == -std::numeric_limits<float>::infinity());
    CHECK(t / 4 > 0.0f);
    CHECK(t / 4 * 4 == t);
}
