// Tests the compositing of samples: every sample's channels are read by TargetStorage::code and the formats'
// definitions, sorted by std::stable_sort, and composited by the rule in the header.
#include "peeling/programs/fixed_passes/sample_lists.h"

#include <bit>
#include <catch2/catch.hpp>

#include "pipeline/formats/half.h"
#include "pipeline/formats/unorm8_product.h"
#include "pipeline/stages/target_storage.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::SampleLists;
using strata::peeling::SamplePlanes;

constexpr std::uint32_t plane_pixels = 40, no_sample = 0xffffff;

struct PlainSample {
    std::uint32_t code;
    Rgba color;
};

Rgba plain_color(const TargetStorage& from, std::uint32_t pixel, int sample, UnormRounding rounding) {
    Rgba color{};
    for (int c = 0; c < 4; ++c) {
        const std::uint32_t code = from.code(pixel, c, sample);
        float& value = color[static_cast<std::size_t>(c)];
        if (info(from.format()).type == ChannelType::single)
            value = std::bit_cast<float>(code);
        else if (info(from.format()).type == ChannelType::half)
            value = half_to_float(static_cast<std::uint16_t>(code));
        else
            value = rounding == UnormRounding::half_up ? from_unorm8(static_cast<std::uint8_t>(code))
                                                       : unorm8_product(code);
    }
    return color;
}

Rgba plain_composite(std::vector<PlainSample> samples, const Rgba& background) {
    std::stable_sort(samples.begin(), samples.end(),
                     [](const PlainSample& a, const PlainSample& b) { return a.code < b.code; });
    Rgba front{0, 0, 0, 1};
    for (const PlainSample& s : samples) {
        for (std::size_t c = 0; c < 3; ++c) front[c] = front[c] + front[3] * (s.color[3] * s.color[c]);
        front[3] = front[3] * (1.0f - s.color[3]);
    }
    for (std::size_t c = 0; c < 3; ++c) front[c] = front[c] + front[3] * background[c];
    // An opaque background gives an opaque pixel; a transparent one is multiplied by the transmittance in front of it.
    return {front[0], front[1], front[2], background[3] == 1 ? 1.0f : 1.0f - front[3] * (1.0f - background[3])};
}

TargetStorage random_target(Random& random, Format format, int samples) {
    TargetStorage target{format, samples, plane_pixels};
    for (int s = 0; s < samples; ++s)
        for (std::size_t w = 0; w < target.texels(s).words(); ++w)
            for (std::uint32_t p = 0; p < plane_pixels; ++p) {
                // Channels of every format from 0 to 1: 0x3bff is a half, 0x3c003c00 two halves or a binary32.
                const auto bits = static_cast<std::uint32_t>(random_int(random, 0, 0x3bff));
                target.texels(s).plane(w).words[p] =
                    bits << 16 | static_cast<std::uint32_t>(random_int(random, 0, 0x3bff));
            }
    return target;
}

int wrong_pixels(Random& random, Format format, UnormRounding rounding) {
    constexpr int passes = 3, pass_samples = 8;
    const TargetStorage background = random_target(random, format, 1);
    std::vector<TargetStorage> sample_colors, sample_depths;
    for (int pass = 0; pass < passes; ++pass) {
        sample_colors.push_back(random_target(random, format, pass_samples));
        sample_depths.emplace_back(Format::d24, pass_samples, plane_pixels);
        for (int s = 0; s < pass_samples; ++s)
            for (std::uint32_t p = 0; p < plane_pixels; ++p) {
                const bool is_empty = random_int(random, 0, 3) == 0;
                sample_depths.back().depth_plane(s).words[p] =
                    is_empty ? no_sample : static_cast<std::uint32_t>(random_int(random, 0, 30));
            }
    }
    std::vector<SamplePlanes> planes;
    for (std::size_t pass = 0; pass < passes; ++pass)
        for (int s = 0; s < pass_samples; ++s)
            planes.push_back({sample_depths[pass].depth(s), sample_colors[pass].texels(s)});
    SampleLists lists{planes, no_sample, {strata::pipeline::HalfRounding::nearest_even, rounding}};
    int wrong = 0;
    for (std::uint32_t p = 0; p < plane_pixels; ++p) {
        std::vector<PlainSample> samples;
        for (std::size_t pass = 0; pass < passes; ++pass)
            for (int s = 0; s < pass_samples; ++s)
                if (const std::uint32_t code = sample_depths[pass].code(p, 0, s); code != no_sample)
                    samples.push_back({code, plain_color(sample_colors[pass], p, s, rounding)});
        const Rgba expected = plain_composite(samples, plain_color(background, p, 0, rounding));
        const Rgba found = lists.composite(p, background.texels(0));
        for (std::size_t c = 0; c < 4; ++c)
            wrong += std::bit_cast<std::uint32_t>(found[c]) == std::bit_cast<std::uint32_t>(expected[c]) ? 0 : 1;
        wrong += lists.order().size() == samples.size() ? 0 : 1;
    }
    return wrong;
}

}  // namespace

TEST_CASE("samples of a pixel are composited from the nearest and of equal sample_depths by number") {
    Random random{43};
    for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f})
        for (const UnormRounding rounding : {UnormRounding::half_up, UnormRounding::product_even}) {
            INFO(info(format).name);
            CHECK(wrong_pixels(random, format, rounding) == 0);
        }
}
