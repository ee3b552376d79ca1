// Fails if the build contracts into fused multiply-add, reassociates, keeps excess precision, flushes denormals or
// loses roundings.
#include "rasterizer/base/numerics.h"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

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

namespace {

struct Place {
    double x, y, z;
};

// Moves places by the middle of two corners, rounded to binary32. GCC 12.2 for SSE2 forgets the rounding in its
// vectors.
[[gnu::noinline]] Place recentred(const Place& low, const Place& high, std::vector<Place>& places) {
    const Place middle{(low.x + high.x) * 0.5, (low.y + high.y) * 0.5, (low.z + high.z) * 0.5};
    const Place rounded{double{static_cast<float>(middle.x)}, double{static_cast<float>(middle.y)},
                        double{static_cast<float>(middle.z)}};
    for (Place& p : places) p = {p.x - rounded.x, p.y - rounded.y, p.z - rounded.z};
    return rounded;
}

}  // namespace

TEST_CASE("a value that is rounded to binary32 and widened again has been rounded") {
    std::vector<Place> places{{12958094, 0, 0}};
    const Place rounded = recentred({12958094, 0, 0}, {12958097, 3, 0}, places);
    CHECK(rounded.x == 12958096);  // the middle, 12958095.5, lies between two binary32 values
    CHECK(rounded.y == 1.5);
    CHECK(places[0].x == -2);
}
