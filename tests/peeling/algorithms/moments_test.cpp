// Tests moments: its logarithm and exponential against Boost.Multiprecision, its bounds against distributions of
// points, and pictures against the exact A-buffer. peeling/reference/algorithms.md 22.
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/programs/fixed_passes/moment_bound.h"
#include "rasterizer/base/log_exp.h"
#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"
#include "tests/peeling/units_off.h"

namespace {

using namespace strata::testing;
using strata::exp_of_minus;
using strata::minus_log;
using strata::peeling::Moments;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::peeling::share_before;

const ExpectedRow expected_moments{{.algorithm = "moments",
                                    .devices = Devices::programmable,
                                    .passes = [](int) { return 2; },
                                    .targets = {"total", "moments", "sums", "result"},
                                    .render_targets = 2}};

struct Points {
    std::vector<double> depth, mass;
};

Points random_points(std::mt19937& random, std::size_t count) {
    Points points;
    double all = 0;
    for (std::size_t i = 0; i < count; ++i) {
        points.depth.push_back(static_cast<double>(random() % 2001) / 1000.0 - 1);
        points.mass.push_back(1 + static_cast<double>(random() % 100));
        all += points.mass.back();
    }
    for (double& m : points.mass) m /= all;
    return points;
}

Moments moments_of(const Points& points) {
    Moments b{};
    for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t i = 0; i < points.depth.size(); ++i)
            b[k] += points.mass[i] * std::pow(points.depth[i], static_cast<double>(k));
    return b;
}

// A scene without opaque fragments: the picture of an opaque one would depend on the overestimation of its own
// absorbance.
FragmentScene translucent_scene(unsigned seed, unsigned most) {
    FragmentScene scene = eighths_scene(seed, most, false);
    for (GivenPixel& pixel : scene.pixels)
        for (GivenFragment& f : pixel.fragments) f.color[3] = std::min(f.color[3], 0.875f);
    return scene;
}

}  // namespace

TEST_CASE("minus_log and exp_of_minus are within half a unit in the last place plus a millionth") {
    std::mt19937 random{6};
    double worst_log = 0, worst_exp = 0;
    for (int i = 0; i < 4000; ++i) {
        const float x =
            std::ldexp(0.5f + 0.5f * static_cast<float>(random() >> 8) * 0x1p-24f, -static_cast<int>(random() % 25));
        if (x < 1.0f) worst_log = std::max(worst_log, units_off(minus_log(x), -log(Wide{x})));
        const float y = std::ldexp(static_cast<float>(random() >> 8) * 0x1p-24f, static_cast<int>(random() % 8) - 1);
        if (y < 103.0f) worst_exp = std::max(worst_exp, units_off(exp_of_minus(y), exp(-Wide{y})));
    }
    CHECK(worst_log < 0.5 + 1e-6);
    CHECK(worst_exp < 0.5 + 1e-6);
    CHECK(minus_log(1.0f) == 0.0f);
    CHECK(exp_of_minus(0.0f) == 1.0f);
    CHECK(exp_of_minus(1000.0f) == 0.0f);
    CHECK(exp_of_minus(std::numeric_limits<float>::infinity()) == 0.0f);
}

TEST_CASE("overestimation 0 and 1 give a lower and an upper bound of the share in front of a depth for given moments") {
    std::mt19937 random{7};
    for (const std::size_t count : {4u, 6u, 8u})
        for (int i = 0; i < 500; ++i) {
            const Points points = random_points(random, count / 2 + 1 + random() % 4);
            const Moments b = moments_of(points);
            const double z = static_cast<double>(random() % 1999) / 1000.0 - 0.9995;
            double before = 0;
            for (std::size_t p = 0; p < points.depth.size(); ++p) before += points.depth[p] < z ? points.mass[p] : 0;
            const double lower = share_before(b, count, z, 0), upper = share_before(b, count, z, 1),
                         middle = share_before(b, count, z, 0.5);
            INFO(count << " moments, try " << i << ", z " << z);
            CHECK(lower <= before + 1e-3);
            CHECK(upper >= before - 1e-3);
            CHECK(middle == Approx((lower + upper) / 2).margin(1e-6));
        }
}

TEST_CASE("the bounds are closer together for more moments") {
    std::mt19937 random{8};
    std::array<double, 3> gaps{};
    for (int i = 0; i < 200; ++i) {
        const Moments b = moments_of(random_points(random, 9));
        const double z = static_cast<double>(random() % 1999) / 1000.0 - 0.9995;
        for (std::size_t k = 0; k < 3; ++k)
            gaps[k] += share_before(b, 4 + 2 * k, z, 1) - share_before(b, 4 + 2 * k, z, 0);
    }
    CHECK(gaps[1] < gaps[0]);
    CHECK(gaps[2] < gaps[1]);
}

TEST_CASE("moments is exact for one fragment per pixel and within 2 codes for two and equal in every execution") {
    for (const unsigned most : {1u, 2u})
        for (const int count : {4, 6, 8}) {
            const FragmentScene scene = translucent_scene(51 + most, most);
            RenderOptions options = eighths_options(scene);
            options.algorithm.moments = count;
            options.algorithm.overestimation = 0;
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, "moments", options, are_alike);
            INFO(most << " fragments, " << count << " moments: off by " << result.audit.max_difference << " / 255");
            REQUIRE_FALSE(result.refusal);
            CHECK(are_alike);
            CHECK(result.audit.max_difference < (most == 1 ? 1e-3 : 2));
        }
}

TEST_CASE("the error of a picture by moments is smaller for more moments") {
    const FragmentScene scene = translucent_scene(57, 6);
    std::vector<double> errors;
    for (const int count : {4, 6, 8}) {
        RenderOptions options = eighths_options(scene);
        const auto exact = render(scene, {"ideal", "a_buffer"}, options).frame.color;
        options.algorithm.moments = count;
        const auto image = render(scene, {"ideal", "moments"}, options).frame.color;
        errors.push_back(0);
        for (std::size_t i = 0; i < image.codes.size(); ++i)
            errors.back() += std::pow(
                double{std::bit_cast<float>(image.codes[i])} - double{std::bit_cast<float>(exact.codes[i])}, 2);
    }
    INFO(errors[0] << ' ' << errors[1] << ' ' << errors[2]);
    CHECK(errors[1] < errors[0]);
    CHECK(errors[2] < errors[1]);
}

TEST_CASE("moments does not depend on the submission order and bias and overestimation change its picture") {
    FragmentScene scene{2, 1};
    const GivenFragment near{0.125f, {1, 0.5f, 0.25f, 0.5f}}, far{0.875f, {0.25f, 0.5f, 1, 0.25f}};
    scene.pixels[0].fragments = {near, far};
    scene.pixels[1].fragments = {far, near};
    RenderOptions options = eighths_options(scene);
    const auto image = render(scene, {"ideal", "moments"}, options).frame.color;
    for (std::size_t c = 0; c < 4; ++c) CHECK(image.codes[c] == image.codes[4 + c]);
    options.algorithm.overestimation = 1;
    CHECK(render(scene, {"ideal", "moments"}, options).frame.color != image);
    options.algorithm.overestimation = 0.25f;
    options.algorithm.moment_bias = 0.125f;
    CHECK(render(scene, {"ideal", "moments"}, options).frame.color != image);
}
