// Tests stochastic: its hash in 64-bit integers, its masks by counting, and its pictures against samples in real
// numbers. peeling/reference/algorithms.md 23.
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/programs/fixed_passes/sample_mask.h"
#include "tests/peeling/eighths.h"
#include "tests/peeling/expectations.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

const ExpectedRow expected_stochastic{{.algorithm = "stochastic",
                                       .devices = Devices::independent_blending,
                                       .passes = [](int) { return 2; },
                                       .targets = {"samples", "sums", "through", "result"},
                                       .render_targets = 2}};

// lowbias32 modulo 2^32, with divisions in place of shifts.
std::uint64_t mixed_model(std::uint64_t v) {
    constexpr std::uint64_t words = std::uint64_t{1} << 32;
    v = v % words;
    v = (v ^ v / 65536) * 2146121005 % words;
    v = (v ^ v / 32768) * 2221713035 % words;
    return v ^ v / 65536;
}

std::uint32_t hash_model(std::size_t x, std::size_t y, std::size_t triangle, std::uint64_t seed) {
    return static_cast<std::uint32_t>(mixed_model(mixed_model(mixed_model(x + 65536 * y) + triangle) + seed));
}

// The triangle number of each fragment, in rounds over the pixels as draw_list submits them.
std::vector<std::vector<std::size_t>> triangles_of(const FragmentScene& scene) {
    std::vector<std::vector<std::size_t>> numbers(scene.pixels.size());
    std::size_t next = 0;
    for (std::size_t round = 0; round < 8; ++round)
        for (std::size_t p = 0; p < scene.pixels.size(); ++p)
            if (round < scene.pixels[p].fragments.size()) numbers[p].push_back(next++);
    return numbers;
}

Color3 sampled(const FragmentScene& scene, std::size_t p, const std::vector<std::size_t>& triangles, int samples,
               std::uint64_t seed) {
    const GivenPixel& pixel = scene.pixels[p];
    const float limit = pixel.opaque ? pixel.opaque->depth : 1.0f;
    std::vector<float> nearest(static_cast<std::size_t>(samples), 2.0f);
    const auto width = static_cast<std::size_t>(scene.width);
    for (std::size_t i = 0; i < pixel.fragments.size(); ++i) {
        const GivenFragment& f = pixel.fragments[i];
        if (f.depth >= limit) continue;
        const std::uint32_t mask =
            strata::peeling::sample_mask(f.color[3], samples, hash_model(p % width, p / width, triangles[i], seed));
        for (std::size_t s = 0; s < nearest.size(); ++s)
            if ((mask >> s & 1u) != 0) nearest[s] = std::min(nearest[s], f.depth);
    }
    Color3 sums{};
    double weights = 0, through = 1;
    for (const GivenFragment& f : visible(pixel)) {
        double seen = 0;
        for (const float depth : nearest) seen += f.depth <= depth ? 1.0 / samples : 0;
        const RealLayer own = layer_of(f);
        for (std::size_t c = 0; c < 3; ++c) sums[c] += own.color[c] * seen;
        weights += f.color[3] * seen;
        through *= 1 - double{f.color[3]};
    }
    Color3 color = behind(pixel);
    if (weights > 0)
        for (std::size_t c = 0; c < 3; ++c) color[c] = sums[c] / weights * (1 - through) + color[c] * through;
    return color;
}

}  // namespace

TEST_CASE("the hash of a fragment is lowbias32 over its pixel and triangle and seed") {
    std::mt19937 random{5};
    for (int i = 0; i < 10000; ++i) {
        const std::uint32_t x = random() % 16384, y = random() % 16384, triangle = random(), seed = random();
        REQUIRE(strata::peeling::sample_hash(x, y, triangle, seed) == hash_model(x, y, triangle, seed));
    }
}

TEST_CASE("a mask has alpha times S samples rounded down or up with the exact mean and every sample equally often") {
    constexpr int tries = 20000;
    for (const int samples : {1, 2, 3, 4, 8})
        for (const float alpha : {0.0f, 0.125f, 0.3f, 0.5f, 0.9f, 1.0f}) {
            std::array<int, 8> covered{};
            int all = 0;
            bool is_stratified = true;
            for (std::uint32_t i = 0; i < tries; ++i) {
                const std::uint32_t mask =
                    strata::peeling::sample_mask(alpha, samples, hash_model(i % 100, i / 100, 7, 1));
                const int count = std::popcount(mask);
                is_stratified &= count == static_cast<int>(std::floor(double{alpha} * samples)) ||
                                 count == static_cast<int>(std::ceil(double{alpha} * samples));
                all += count;
                for (std::size_t s = 0; s < 8; ++s) covered[s] += (mask >> s & 1u) != 0 ? 1 : 0;
            }
            INFO(samples << " samples, alpha " << alpha);
            CHECK(is_stratified);
            CHECK(std::abs(all / double{tries} - double{alpha} * samples) < 0.02);
            for (std::size_t s = 0; s < static_cast<std::size_t>(samples); ++s)
                CHECK(std::abs(covered[s] / double{tries} - double{alpha}) < 0.02);
            for (std::size_t s = static_cast<std::size_t>(samples); s < 8; ++s) CHECK(covered[s] == 0);
        }
}

TEST_CASE("stochastic weights colours by visible samples and corrects by the exact alpha in every execution") {
    const FragmentScene scene = eighths_scene(41, 6);
    const auto triangles = triangles_of(scene);
    for (const int samples : {1, 2, 4, 7, 8})
        for (const std::uint32_t seed : {0u, 77u}) {
            RenderOptions options = eighths_options(scene);
            options.algorithm.stochastic_samples = samples;
            options.algorithm.stochastic_seed = seed;
            bool are_alike = true;
            const RenderResult result = rendered_alike(scene, "stochastic", options, are_alike);
            INFO(samples << " samples, seed " << seed);
            REQUIRE_FALSE(result.refusal);
            CHECK(first_unlike(
                      result.frame.color, [&](std::size_t p) { return sampled(scene, p, triangles[p], samples, seed); },
                      40 * 0x1p-24) == "");
            CHECK(are_alike);
        }
}

TEST_CASE("the error of a stochastic picture is smaller for more samples") {
    const FragmentScene scene = eighths_scene(42, 6, false);
    RenderOptions options = eighths_options(scene);
    const auto exact = render(scene, {"ideal", "a_buffer"}, options).frame.color;
    const auto error = [&](int samples) {
        options.algorithm.stochastic_samples = samples;
        const auto image = render(scene, {"ideal", "stochastic"}, options).frame.color;
        double sum = 0;
        for (std::size_t i = 0; i < image.codes.size(); ++i)
            sum += std::pow(double{std::bit_cast<float>(image.codes[i])} - double{std::bit_cast<float>(exact.codes[i])},
                            2);
        return sum;
    };
    CHECK(error(8) < error(2));
    CHECK(error(2) < error(1));
}
