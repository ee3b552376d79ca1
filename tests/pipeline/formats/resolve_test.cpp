// Tests resolves against integers for codes, and against rationals rounded once per operation for sums in binary32.
#include "pipeline/formats/resolve.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::pipeline;
using strata::rasterizer::floor;
using strata::rasterizer::Integer;
using strata::rasterizer::nearest_float;
using strata::rasterizer::Rational;
using strata::rasterizer::Rounded;
using strata::testing::Random;
using strata::testing::random_int;

constexpr int resolved_width = 37, resolved_height = 31;  // more codes than a block, and not a multiple of a block

[[nodiscard]] std::vector<Image> random_samples(Random& random, Format format, int samples, auto code) {
    std::vector<Image> images;
    for (int s = 0; s < samples; ++s) {
        images.emplace_back(format, resolved_width, resolved_height);
        for (std::uint32_t& c : images.back().codes) c = code(random);
    }
    return images;
}

[[nodiscard]] Image resolved(const std::vector<Image>& samples, ResolveRule rule, ColorRounding rounding) {
    ColorResolve resolve{static_cast<int>(samples.size()), rule, rounding};
    for (const Image& sample : samples) resolve.add(sample);
    return std::move(resolve).picture();
}

[[nodiscard]] std::uint32_t random_code(Random& random) {
    return static_cast<std::uint32_t>(random_int(random, 0, 255));
}

// The sum of `value(sample)` in binary32, sample by sample, times 1/n.
[[nodiscard]] float mean(const std::vector<Image>& samples, std::size_t i, auto value) {
    Rounded sum{0};
    for (const Image& sample : samples) sum = sum + Rounded{value(sample.codes[i])};
    return (sum * Rounded{1.0f / static_cast<float>(samples.size())}).v;
}

}  // namespace

TEST_CASE("8-bit samples resolve to the mean of their codes with ties up") {
    Random random{51};
    std::uint64_t wrong = 0, halves = 0;
    for (const int n : {1, 2, 4, 8}) {
        const auto samples = random_samples(random, Format::rgba8, n, random_code);
        const Image picture = resolved(samples, ResolveRule::codes_half_up, HalfRounding::nearest_even);
        REQUIRE(picture.codes.size() == samples[0].codes.size());
        for (std::size_t i = 0; i < picture.codes.size(); ++i) {
            Integer sum = 0;
            for (const Image& sample : samples) sum += sample.codes[i];
            const Rational exact{sum, Integer{n}};
            halves += 2 * (sum % n) == n ? 1 : 0;
            wrong += picture.codes[i] != floor(exact + Rational{1, 2}) ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    CHECK(halves > 1000);
}

TEST_CASE("a resolve in binary32 adds values sample by sample with each step rounded and then rounds like colours") {
    Random random{52};
    std::uint64_t wrong = 0, unlike_codes = 0;
    for (const int n : {2, 4, 8}) {
        const auto samples = random_samples(random, Format::rgba8, n, random_code);
        const Image exact = resolved(samples, ResolveRule::codes_half_up, HalfRounding::nearest_even);
        for (const UnormRounding rounding : {UnormRounding::half_up, UnormRounding::product_even}) {
            const Image picture = resolved(samples, ResolveRule::single, {HalfRounding::nearest_even, rounding});
            for (std::size_t i = 0; i < picture.codes.size(); ++i) {
                const float value = mean(samples, i, [&](std::uint32_t c) {
                    const Rational code{static_cast<int>(c)};
                    return rounding == UnormRounding::half_up ? nearest_float(code / 255)
                                                              : nearest_float(code * Rational{1.0f / 255.0f});
                });
                const Rational scaled = rounding == UnormRounding::half_up
                                            ? Rational{value} * 255
                                            : Rational{nearest_float(Rational{value} * 255)};
                Integer code = floor(scaled + Rational{1, 2});
                if (rounding == UnormRounding::product_even && Rational{code} - scaled == Rational{1, 2} &&
                    code % 2 == 1)
                    --code;
                wrong += picture.codes[i] != code ? 1 : 0;
                unlike_codes += picture.codes[i] != exact.codes[i] ? 1 : 0;
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(unlike_codes > 100);
}

TEST_CASE("float samples resolve in binary32 by every rule") {
    Random random{53};
    std::uint64_t wrong = 0;
    const auto number = [](Random& r) {
        return std::bit_cast<std::uint32_t>(static_cast<float>(random_int(r, -4000, 90000)) * 0.0037f);
    };
    for (const ResolveRule rule : {ResolveRule::codes_half_up, ResolveRule::single}) {
        const auto samples = random_samples(random, Format::rgba32f, 4, number);
        const Image picture = resolved(samples, rule, HalfRounding::nearest_even);
        for (std::size_t i = 0; i < picture.codes.size(); ++i)
            wrong += std::bit_cast<float>(picture.codes[i]) !=
                             mean(samples, i, [](std::uint32_t c) { return std::bit_cast<float>(c); })
                         ? 1
                         : 0;
        const auto half = [](Random& r) { return static_cast<std::uint32_t>(random_int(r, 0x2000, 0x5bff)); };
        const auto halves = random_samples(random, Format::r16f, 8, half);
        for (const HalfRounding rounding : {HalfRounding::nearest_even, HalfRounding::toward_zero}) {
            const Image small = resolved(halves, rule, rounding);
            for (std::size_t i = 0; i < small.codes.size(); ++i) {
                const float value = mean(halves, i, [](std::uint32_t c) {
                    const int exponent = static_cast<int>(c >> 10 & 31) - 25;
                    return nearest_float(Rational{static_cast<int>(c & 1023u) + 1024} *
                                         strata::rasterizer::power(exponent));
                });
                wrong += small.codes[i] != to_half(value, rounding) ? 1 : 0;
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("a sample without a picture adds codes of 0 and narrow surfaces store the mean like any colour") {
    Random random{54};
    const auto samples = random_samples(random, Format::rgba8, 3, random_code);
    ColorResolve resolve{4, ResolveRule::codes_half_up, HalfRounding::nearest_even};
    for (const Image& sample : samples) resolve.add(sample);
    const Image picture = std::move(resolve).picture();
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < picture.codes.size(); ++i)
        wrong += picture.codes[i] != (samples[0].codes[i] + samples[1].codes[i] + samples[2].codes[i] + 2) / 4 ? 1 : 0;
    const auto narrow = random_samples(random, Format::r5g6b5, 2, random_code);
    const Image stored = resolved(narrow, ResolveRule::codes_half_up, HalfRounding::nearest_even);
    for (std::size_t i = 0; i < stored.codes.size(); ++i) {
        const std::uint32_t mean = (narrow[0].codes[i] + narrow[1].codes[i] + 1) / 2;
        const std::uint32_t kept = i % 4 == 3 ? 255 : i % 4 == 1 ? mean & 0xfcu : mean & 0xf8u;
        wrong += stored.codes[i] != kept ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("the nearest depth of a pixel's samples is its least code") {
    Random random{55};
    const auto samples = random_samples(random, Format::d24, 4, random_code);
    Image least;
    for (const Image& sample : samples) add_nearest(sample, least);
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < least.codes.size(); ++i) {
        const std::array<std::uint32_t, 4> all{samples[0].codes[i], samples[1].codes[i], samples[2].codes[i],
                                               samples[3].codes[i]};
        wrong += least.codes[i] != *std::ranges::min_element(all) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(least.format == Format::d24);
}

TEST_CASE("Quincunx weights the centre by 1/2 and each corner of the pixel by 1/8 with ties up") {
    Random random{56};
    const auto samples = random_samples(random, Format::rgba8, 2, random_code);
    std::uint64_t wrong = 0;
    const Image picture = quincunx(samples[0], samples[1]);
    for (int y = 0; y < resolved_height; ++y)
        for (int x = 0; x < resolved_width; ++x)
            for (int c = 0; c < 4; ++c) {
                Rational sum = Rational{samples[1].codes[samples[1].index(x, y, c)]} / 2;
                for (const int right : {0, 1})
                    for (const int below : {0, 1}) {
                        const int column = x + right == resolved_width ? x : x + right;
                        const int row = y + below == resolved_height ? y : y + below;
                        sum += Rational{samples[0].codes[samples[0].index(column, row, c)]} / 8;
                    }
                wrong += picture.codes[picture.index(x, y, c)] != floor(sum + Rational{1, 2}) ? 1 : 0;
            }
    CHECK(wrong == 0);
}
