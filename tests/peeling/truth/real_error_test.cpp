// Tests the error measures in real numbers against the formulas of the header in long double with the C library's
// logarithm, and on pictures whose SSIM is known.
#include "peeling/truth/real_error.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::peeling::real_error;
using strata::peeling::RealError;
using strata::peeling::RealImage;

RealImage flat(int width, int height, double value) {
    return {width, height, std::vector<double>(3 * static_cast<std::size_t>(width * height), value)};
}

}  // namespace

TEST_CASE("equal numbers have no error for any value") {
    CHECK(real_error(flat(9, 7, 0.3), flat(9, 7, 0.3)) == RealError{});
}

TEST_CASE("one pixel of a hundred that is one code off gives the expected value of every measure") {
    const RealImage truth = flat(10, 10, 0.5);
    RealImage image = truth;
    image.rgb[3 * 42 + 1] += 1 / 255.0;
    const RealError error = real_error(image, truth);
    CHECK(error.max_difference == Approx(1).epsilon(1e-12));
    CHECK(error.rmse == Approx(std::sqrt(1 / 300.0)).epsilon(1e-12));
    CHECK(error.psnr.value() == Approx(20 * std::log10(255 / std::sqrt(1 / 300.0))).epsilon(1e-10));
    CHECK(error.pixels == 0.01);
    CHECK(error.ssim < 1);
    CHECK(error.ssim > 0.99);
}

TEST_CASE("two flat pictures are as similar as their means and a picture and its negative have negative similarity") {
    const double a = 0.25, b = 0.5;
    CHECK(real_error(flat(16, 12, a), flat(16, 12, b)).ssim ==
          Approx((2 * a * b + 1e-4) / (a * a + b * b + 1e-4)).epsilon(1e-9));
    RealImage stripes = flat(16, 16, 0), negative = stripes;
    for (std::size_t i = 0; i < stripes.rgb.size(); ++i) {
        stripes.rgb[i] = i / 3 % 2 == 0 ? 1 : 0;
        negative.rgb[i] = 1 - stripes.rgb[i];
    }
    // Means are equal, 1/2; variances 1/4 and the covariance -1/4.
    CHECK(real_error(stripes, negative).ssim == Approx((9e-4 - 0.5) / (9e-4 + 0.5)).epsilon(1e-9));
}

TEST_CASE("the mean over windows is that of a loop over them in a picture that is not a multiple of a window") {
    Random random{8};
    RealImage a = flat(13, 11, 0), b = a;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        a.rgb[i] = double{random_float(random, 0, 1)};
        b.rgb[i] = double{random_float(random, 0, 1)};
    }
    long double sum = 0;
    int windows = 0;
    for (const int y0 : {0})
        for (const int x0 : {0, 4}) {
            long double mean[2] = {}, square[2] = {}, both = 0;
            for (int y = y0; y < y0 + 8; ++y)
                for (int x = x0; x < x0 + 8; ++x) {
                    const auto at = 3 * static_cast<std::size_t>(13 * y + x);
                    const long double u = (0.0L + a.rgb[at] + a.rgb[at + 1] + a.rgb[at + 2]) / 3;
                    const long double v = (0.0L + b.rgb[at] + b.rgb[at + 1] + b.rgb[at + 2]) / 3;
                    mean[0] += u / 64;
                    mean[1] += v / 64;
                    square[0] += u * u / 64;
                    square[1] += v * v / 64;
                    both += u * v / 64;
                }
            const long double m = mean[0], n = mean[1];
            sum += (2 * m * n + 1e-4L) * (2 * (both - m * n) + 9e-4L) /
                   ((m * m + n * n + 1e-4L) * (square[0] - m * m + square[1] - n * n + 9e-4L));
            ++windows;
        }
    CHECK(real_error(a, b).ssim == Approx(static_cast<double>(sum / windows)).epsilon(1e-9));
}
