// Tests moments_quantized: the transform against moments of points in binary64, and pictures against those of moments
// and the exact A-buffer. peeling/reference/algorithms.md 22.2.
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/programs/fixed_passes/moment_quantization.h"
#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::as_unorm16;
using strata::peeling::MomentValues;
using strata::peeling::quantization_of;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::peeling::restored;
using strata::peeling::transformed;
using strata::peeling::with_fragment;

const ExpectedRow expected_moments_quantized{{.algorithm = "moments_quantized",
                                              .devices = Devices::ideal_alone,
                                              .passes = [](int) { return 2; },
                                              .targets = {"total", "moments", "sums", "result"},
                                              .render_targets = 2}};

struct MassPoint {
    double depth, mass;
};

std::vector<MassPoint> random_masses(std::mt19937& random) {
    std::vector<MassPoint> points(1 + random() % 12);
    for (MassPoint& point : points)
        point = {static_cast<double>(random() % 2001) / 1000 - 1, static_cast<double>(1 + random() % 64) / 16};
    return points;
}

double moment_of(const std::vector<MassPoint>& points, std::size_t power) {
    double sum = 0, all = 0;
    for (const MassPoint& point : points) {
        sum += point.mass * std::pow(point.depth, static_cast<double>(power));
        all += point.mass;
    }
    return sum / all;
}

// One pixel whose fragments have no opaque surface: moments of opaque ones depend on the overestimation.
FragmentScene glass_scene(unsigned seed, unsigned most) {
    FragmentScene scene = eighths_scene(seed, most, false);
    for (GivenPixel& pixel : scene.pixels)
        for (GivenFragment& f : pixel.fragments) f.color[3] = std::min(f.color[3], 0.875f);
    return scene;
}

double mean_error(const strata::pipeline::Image& image, const strata::pipeline::Image& exact) {
    double sum = 0;
    for (std::size_t i = 0; i < image.codes.size(); ++i)
        sum += std::abs(double{std::bit_cast<float>(image.codes[i])} - double{std::bit_cast<float>(exact.codes[i])});
    return 255 * sum / static_cast<double>(image.codes.size());
}

}  // namespace

TEST_CASE("the transforms of moments are inverse to one another and keep moments of any distribution within 0 and 1") {
    std::mt19937 random{21};
    for (const std::size_t count : {4u, 6u, 8u}) {
        const auto& transform = quantization_of(count);
        double worst = 0, least = 1, greatest = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto points = random_masses(random);
            MomentValues moments{};
            for (std::size_t m = 0; m < count; ++m) moments[m] = static_cast<float>(moment_of(points, m + 1));
            MomentValues stored = transformed(moments, count, transform.odd, transform.even);
            for (std::size_t m = 0; m < count; ++m) {
                stored[m] += m % 2 == 0 ? 0.5f : transform.even_offset[m / 2];
                least = std::min(least, double{stored[m]});
                greatest = std::max(greatest, double{stored[m]});
            }
            const MomentValues back = restored(stored, count);
            for (std::size_t m = 0; m < count; ++m)
                worst = std::max(worst, std::abs(double{back[m]} - double{moments[m]}));
        }
        INFO(count << " moments: off by " << worst << ", stored from " << least << " to " << greatest);
        CHECK(worst < 2e-5);
        CHECK(least > -1e-3);
        CHECK(greatest < 1 + 1e-3);
    }
}

TEST_CASE("a moment of 16 bits is the nearest multiple of 1 of 65535") {
    for (const int code : {0, 1, 2, 32767, 32768, 65534, 65535}) {
        const float value = static_cast<float>(code) / 65535.0f;
        CHECK(as_unorm16(value) == value);
        CHECK(as_unorm16(value + 0.49f / 65535.0f) == value);
    }
    CHECK(as_unorm16(-1.0f) == 0.0f);
    CHECK(as_unorm16(2.0f) == 1.0f);
}

// A step rounds every stored value by at most half a code, and the steps after it only shrink that error.
TEST_CASE("moments of fragments added one by one are those of the distribution within the roundings of 16 bits") {
    std::mt19937 random{22};
    for (const std::size_t count : {4u, 6u, 8u}) {
        const auto& transform = quantization_of(count);
        double rows = 0;
        for (std::size_t r = 0; r < count / 2; ++r) {
            double odd = 0, even = 0;
            for (std::size_t c = 0; c < count / 2; ++c) {
                odd += std::abs(double{transform.odd_inverse[r][c]});
                even += std::abs(double{transform.even_inverse[r][c]});
            }
            rows = std::max({rows, odd, even});
        }
        double worst = 0;
        for (int i = 0; i < 500; ++i) {
            const auto points = random_masses(random);
            MomentValues stored{};
            float total = 0;
            for (const MassPoint& point : points) {
                stored = with_fragment(stored, count, total, static_cast<float>(point.mass),
                                       static_cast<float>(point.depth));
                total += static_cast<float>(point.mass);
            }
            const MomentValues back = restored(stored, count);
            for (std::size_t m = 0; m < count; ++m) {
                const double off = std::abs(double{back[m]} - moment_of(points, m + 1));
                worst = std::max(worst, off * 65535 / (rows * static_cast<double>(points.size())));
            }
        }
        INFO(count << " moments: " << worst << " of half a code per fragment");
        CHECK(worst < 0.75);
        CHECK(worst > 0.05);
    }
}

TEST_CASE("moments_quantized is nearly exact for one fragment and close to moments for more in every execution") {
    for (const unsigned most : {1u, 6u})
        for (const int count : {4, 6, 8}) {
            const FragmentScene scene = glass_scene(71 + most, most);
            RenderOptions options = eighths_options(scene);
            options.algorithm.moments = count;
            options.algorithm.overestimation = 0;
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, "moments_quantized", options, are_alike);
            REQUIRE_FALSE(result.refusal);
            CHECK(are_alike);
            const auto exact = render(scene, {"ideal", "a_buffer"}, options).frame.color;
            const double by_sums = mean_error(render(scene, {"ideal", "moments"}, options).frame.color, exact);
            const double by_codes = mean_error(result.frame.color, exact);
            INFO(most << " fragments, " << count << " moments: " << by_codes << " / 255, by binary32 " << by_sums);
            CHECK(by_codes < by_sums + 1);
            CHECK(by_codes != by_sums);
        }
}
