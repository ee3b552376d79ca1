// Tests texture lookups against rational arithmetic with the texels of tests/pipeline/addressing_model.h.
#include "pipeline/textures/texture_sample.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>

#include "pipeline/formats/srgb.h"
#include "pipeline/formats/unorm8.h"
#include "tests/pipeline/addressing_model.h"
#include "tests/pipeline/format_models.h"
#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;
using strata::rasterizer::Lanes;

namespace {

Texture any_texture(Random& random) {
    Texture texture;
    texture.target = any_of(random, TextureTarget::rectangle);
    texture.filter = any_of(random, TextureFilter::linear);
    texture.wrap_s = any_of(random, TextureWrap::clamp_to_edge);
    texture.wrap_t = any_of(random, TextureWrap::clamp_to_edge);
    texture.decode_srgb = one_in(random, 3);
    texture.width = static_cast<int>(below(random, 9)) + 1;
    texture.height = static_cast<int>(below(random, 9)) + 1;
    for (int i = 0; i < texture.width * texture.height * 4; ++i) texture.texels.push_back(any_byte(random));
    return texture;
}

// The value of a byte of channel c before filtering.
float decoded(const Texture& texture, std::uint8_t byte, std::size_t c) {
    return texture.decode_srgb && c < 3 ? srgb_to_linear[byte] : unorm8_table[byte];
}

float eight_bits(float x) { return static_cast<float>(model::unorm8(bits_of(x))) / 255.0f; }

// A sum in the specified order, each operation rounded to binary32 through binary64.
float ordered_sum(const std::array<float, 4>& value, const std::array<int, 4>& weight) {
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto product = static_cast<float>(double{value[k]} * weight[k] / 65536);
        sum = k == 0 ? product : static_cast<float>(double{sum} + double{product});
    }
    return sum;
}

std::array<float, 4> model_sample(const Texture& texture, TextureFilterPrecision precision, float s, float t) {
    const bool is_single = precision == TextureFilterPrecision::single;
    const auto x = model::texels(texture.target, texture.wrap_s, texture.width, texture.filter, is_single, s);
    const auto y = model::texels(texture.target, texture.wrap_t, texture.height, texture.filter, is_single, t);
    const auto byte = [&](int column, int row, std::size_t c) {
        return texture.texels[static_cast<std::size_t>(row * texture.width + column) * 4 + c];
    };
    const std::array<int, 4> weight{(256 - x.weight) * (256 - y.weight), x.weight * (256 - y.weight),
                                    (256 - x.weight) * y.weight, x.weight * y.weight};
    std::array<float, 4> result{};
    for (std::size_t c = 0; c < 4; ++c) {
        const std::array<std::uint8_t, 4> tap{byte(x.first, y.first, c), byte(x.second, y.first, c),
                                              byte(x.first, y.second, c), byte(x.second, y.second, c)};
        if (!is_single && !texture.decode_srgb) {  // the nearest code to the exact sum, ties up
            int sum = 0;
            for (std::size_t k = 0; k < 4; ++k) sum += tap[k] * weight[k];
            int code = 0;
            while ((2 * code + 1) * 32768 <= sum) ++code;
            result[c] = static_cast<float>(code) / 255.0f;
            continue;
        }
        std::array<float, 4> value{};
        for (std::size_t k = 0; k < 4; ++k) value[k] = decoded(texture, tap[k], c);
        const float filtered = texture.filter == TextureFilter::nearest ? value[0] : ordered_sum(value, weight);
        result[c] = is_single ? filtered : eight_bits(filtered);
    }
    return result;
}

std::array<float, 4> sample_one(const Texture& texture, TextureFilterPrecision precision, float s, float t) {
    Lanes<float> s_lanes{}, t_lanes{};
    std::array<Lanes<float>, 4> rgba{};
    s_lanes[0] = s, t_lanes[0] = t;
    sample(texture, precision, s_lanes, t_lanes, rgba, 1);
    return {rgba[0][0], rgba[1][0], rgba[2][0], rgba[3][0]};
}

Texture row_of(const std::vector<std::uint8_t>& red, TextureFilter filter, TextureWrap wrap) {
    Texture texture;
    texture.width = static_cast<int>(red.size());
    texture.filter = filter;
    texture.wrap_s = texture.wrap_t = wrap;
    for (const std::uint8_t r : red) texture.texels.insert(texture.texels.end(), {r, 0, 0, 255});
    return texture;
}

}  // namespace

TEST_CASE("a lookup gives the result of rational arithmetic for random textures and every kind of coordinate",
          "[slow]") {
    Random random{37};
    Tally tally;
    for (int round = 0; round < 5000; ++round) {
        const Texture texture = any_texture(random);
        const auto precision = any_of(random, TextureFilterPrecision::single);
        const int count = one_in(random, 16) ? 256 : static_cast<int>(below(random, 20));
        Lanes<float> s{}, t{};
        std::array<Lanes<float>, 4> rgba{};
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            s[i] = model::any_coordinate(random, texture.width), t[i] = model::any_coordinate(random, texture.height);
        sample(texture, precision, s, t, rgba, count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const auto expected = model_sample(texture, precision, s[i], t[i]);
            for (std::size_t c = 0; c < 4; ++c)
                tally.expect(bits_of(rgba[c][i]) == bits_of(expected[c]), [&] {
                    return fmt::format("{} x {} target {} filter {} wrap {} {} at {} {}: channel {} {} not {}",
                                       texture.width, texture.height, static_cast<int>(texture.target),
                                       static_cast<int>(texture.filter), static_cast<int>(texture.wrap_s),
                                       static_cast<int>(texture.wrap_t), s[i], t[i], c, rgba[c][i], expected[c]);
                });
        }
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() >= 100000);
}

TEST_CASE("a coordinate of exactly 1 takes the last texel when clamped and the first when repeated") {
    const auto red = [](TextureWrap wrap) {
        return sample_one(row_of({0, 51, 255}, TextureFilter::nearest, wrap), TextureFilterPrecision::single, 1.0f,
                          0.5f)[0];
    };
    CHECK(red(TextureWrap::clamp_to_edge) == 1.0f);
    CHECK(red(TextureWrap::mirrored_repeat) == 1.0f);
    CHECK(red(TextureWrap::repeat) == 0.0f);
}

TEST_CASE("a device that snaps texture coordinates to 1/256 reaches the next texel just before its border") {
    const Texture texture = row_of({0, 255}, TextureFilter::nearest, TextureWrap::clamp_to_edge);
    const float just_before = 0.4995f;  // u = 0.999
    CHECK(sample_one(texture, TextureFilterPrecision::single, just_before, 0.5f)[0] == 1.0f);
    CHECK(sample_one(texture, TextureFilterPrecision::unorm8, just_before, 0.5f)[0] == 0.0f);
}

TEST_CASE("a bilinear lookup at a texel centre is that texel and halfway the mean rounded half up for 8-bit results") {
    const Texture texture = row_of({10, 21}, TextureFilter::linear, TextureWrap::clamp_to_edge);
    for (const auto precision : {TextureFilterPrecision::unorm8, TextureFilterPrecision::single}) {
        CHECK(sample_one(texture, precision, 0.25f, 0.5f)[0] == unorm8_table[10]);
        CHECK(sample_one(texture, precision, 0.75f, 0.5f)[0] == unorm8_table[21]);
        CHECK(sample_one(texture, precision, -5.0f, 0.5f)[0] == unorm8_table[10]);
    }
    CHECK(sample_one(texture, TextureFilterPrecision::unorm8, 0.5f, 0.5f)[0] == unorm8_table[16]);  // 15.5
    CHECK(sample_one(texture, TextureFilterPrecision::single, 0.5f, 0.5f)[0] == Approx(15.5 / 255));
}

TEST_CASE("NaN and infinite and huge coordinates give some texel of the image") {
    for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirrored_repeat, TextureWrap::clamp_to_edge})
        for (const TextureFilter filter : {TextureFilter::nearest, TextureFilter::linear}) {
            const Texture texture = row_of({51, 51, 51}, filter, wrap);
            for (const std::uint32_t bits : hard_bits)
                CHECK(sample_one(texture, TextureFilterPrecision::single, float_of(bits), float_of(bits))[0] ==
                      Approx(0.2));
        }
    const Texture edge = row_of({0, 255}, TextureFilter::nearest, TextureWrap::clamp_to_edge);
    CHECK(sample_one(edge, TextureFilterPrecision::single, float_of(0x7f800000), 0.5f)[0] == 1.0f);
    CHECK(sample_one(edge, TextureFilterPrecision::single, float_of(0xff800000), 0.5f)[0] == 0.0f);
    CHECK(sample_one(edge, TextureFilterPrecision::single, float_of(0x7fc00000), 0.5f)[0] == 0.0f);
}
