// Tests the size of points by distance against its formula in binary64, within the error of a table of 64 roots, and
// its limits. Captures of suite Point_params decide the bits (tests/tools/lab/hardware_check/suites_test.cpp).
#include "pipeline/geforce3/point_size.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/random_numbers.h"

using strata::pipeline::attenuated_size;
using strata::pipeline::PointSizeRegisters;

TEST_CASE("a point's size falls with its distance as the formula says") {
    strata::testing::Random random{31};
    using strata::testing::random_float;
    int wrong = 0, between = 0;
    for (int i = 0; i < 5000; ++i) {
        const auto any = [&](float most) { return random() % 3 == 0 ? 0.0f : random_float(random, 0, most); };
        const PointSizeRegisters r{{any(4), any(1), any(0.1f)},
                                   random_float(random, 0, 40),
                                   random_float(random, -1, 1),
                                   random_float(random, 0, 20)};
        const std::array<float, 3> eye{random_float(random, -9, 9), random_float(random, -9, 9),
                                       random_float(random, 1, 200)};
        const double squared = double{eye[0]} * eye[0] + double{eye[1]} * eye[1] + double{eye[2]} * eye[2];
        const double q = double{r.factor[0]} + r.factor[1] * std::sqrt(squared) + r.factor[2] * squared;
        const double root = q > 0 ? 1 / std::sqrt(q) : 1e9;
        const double f = std::min(std::max(root + double{r.bias}, 0.0), 1.0);
        const double size = 8 * (f * double{r.range} + double{r.least});
        between += f > 0 && f < 1 ? 1 : 0;
        // A seed is cut to 1/64 .. 1/128 of itself; what comes after has 14 bits.
        const double slack = 8 * double{r.range} * (root < 4 ? root : 0) / 64 + size / 1000 + 1;
        wrong += std::fabs(attenuated_size(r, eye) - std::min(size, 511.0)) > slack ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(between > 1000);
}

TEST_CASE("a sum that is not positive gives the greatest size, and sizes end at 511 eighths") {
    const std::array<float, 3> eye{0, 0, 10};
    CHECK(attenuated_size({{0, 0, 0}, 16, 0, 0}, eye) == 128);
    CHECK(attenuated_size({{-1, 0, 0}, 16, 0, 2}, eye) == 144);
    CHECK(attenuated_size({{0, 0, 0}, 15, -100, 1}, eye) == 120 + 8);  // infinity, less a finite bias
    CHECK(attenuated_size({{4, 0, 0}, 14, -1, 16}, eye) == 128);
    CHECK(attenuated_size({{0, 0, 0}, 60, 0, 30}, eye) == 511);
    CHECK(attenuated_size({{1, 0, 0}, 0, 0, -3}, eye) == 0);
}
