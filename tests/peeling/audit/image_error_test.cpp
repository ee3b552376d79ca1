// Tests the error measures of images against the formulas of the header with the C library's logarithm, compared to 10
// digits.
#include "peeling/audit/image_error.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/random_numbers.h"

using namespace strata::peeling;
using namespace strata::pipeline;
using strata::testing::Random;
using strata::testing::random_float;
using strata::testing::random_int;

namespace {

Image grey(int width, int height) { return Image(Format::rgba8, width, height); }

}  // namespace

TEST_CASE("equal pictures have no difference and no signal-to-noise ratio") {
    CHECK(image_error(grey(3, 2), grey(3, 2)) == ImageError{});
}

TEST_CASE("largest difference and root mean square and PSNR follow their formulas without alpha") {
    Random random{4};
    for (int i = 0; i < 50; ++i) {
        Image a = grey(5, 4), b(Format::rgba32f, 5, 4);
        double largest = 0, sum = 0;
        for (std::size_t k = 0; k < a.codes.size(); ++k) {
            const float truth = random_float(random, 0, i < 25 ? 1.0f : 0.01f);
            a.codes[k] = static_cast<std::uint32_t>(random_int(random, 0, i < 25 ? 255 : 2));
            b.codes[k] = std::bit_cast<std::uint32_t>(truth);
            const double difference = static_cast<double>(a.codes[k]) - 255.0 * double{truth};
            if (k % 4 == 3) continue;
            largest = std::max(largest, std::fabs(difference));
            sum += difference * difference;
        }
        const double rmse = std::sqrt(sum / 60);
        const ImageError error = image_error(a, b);
        CHECK(error.max_difference == Approx(largest).epsilon(1e-10));
        CHECK(error.rmse == Approx(rmse).epsilon(1e-10));
        CHECK(error.psnr.value() == Approx(20 * std::log10(255 / rmse)).epsilon(1e-10));
    }
}

TEST_CASE("the difference image is image minus truth with its sign") {
    Image a = grey(1, 1), b = grey(1, 1);
    a.codes = {0, 255, 51, 7};
    b.codes = {255, 0, 51, 9};
    const Image found = difference(a, b);
    CHECK(std::bit_cast<float>(found.codes[0]) == -1.0f);
    CHECK(std::bit_cast<float>(found.codes[1]) == 1.0f);
    CHECK(std::bit_cast<float>(found.codes[2]) == 0.0f);
    CHECK(std::bit_cast<float>(found.codes[3]) == 1.0f);
}
