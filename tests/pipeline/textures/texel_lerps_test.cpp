// Tests lookups by lerps against values that Mesa 22.3.6's llvmpipe and softpipe drew, and against exact arithmetic.
#include "pipeline/textures/texel_lerps.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/formats/srgb.h"
#include "pipeline/formats/srgb_mesa.h"
#include "pipeline/textures/texture_sample.h"
#include "tests/pipeline/stage_values.h"
#include "tests/pipeline/textures/mesa_lookups.h"

// A separate namespace: models of several tests use the same short names, and a unity build joins their files.
namespace strata::testing::lerps_model {
namespace {

using namespace pipeline;
using rasterizer::Lanes;
using Rule = TextureFilterPrecision;

struct Drawn {
    Rule rule;
    TextureFilter filter;
    TextureWrap wrap;
    std::uint32_t s, t, red;
};

// The red channel of a texture of 7 x 5 at (s, t).
constexpr Drawn drawn_by_mesa[] = {
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbec94b20, 0xbf1a4f17, 0x3e34b4b5},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbe74e802, 0xbf7c7923, 0x3f39b9ba},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3feb4c25, 0x3ff50b11, 0x3ebababb},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3fe0f116, 0xbea76ecc, 0x3e44c4c6},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3f5b6db7, 0x3f841b35, 0x3f5edee0},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbf0a76aa, 0xbed1828f, 0x3f55d5d7},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbf58680e, 0x3f7466ed, 0x3f09898a},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3e924925, 0x3fe7a624, 0x3efcfcfe},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbec94b20, 0xbf1a4f17, 0x00000000},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbe74e802, 0xbf7c7923, 0x00000000},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3feb4c25, 0x3ff50b11, 0x3ea4a4a5},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3fe0f116, 0xbea76ecc, 0x3f5edee0},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3f5b6db7, 0x3f841b35, 0x3ea4a4a5},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbf0a76aa, 0xbed1828f, 0x00000000},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbf58680e, 0x3f7466ed, 0x3f149495},
    {Rule::code_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3e924925, 0x3fe7a624, 0x3efcfcfe},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3eeeee7b, 0xbf1c0fe4, 0x3f5adadc},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3fdf4468, 0x3fcf167e, 0x3eb6b6b7},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3f3d34bb, 0x3fdd7bfb, 0x3ea8a8a9},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3fa578ac, 0x3ebb4106, 0x3f149495},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3de90311, 0x3fd9999a, 0x3ebababb},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0xbe7ad3c8, 0x3f666666, 0x3ebebebf},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3fbbf815, 0x3e7144e6, 0x3f44c4c6},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3f484b06, 0x3fbfd75e, 0x3f058586},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3eeeee7b, 0xbf1c0fe4, 0x3eccccce},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3fdf4468, 0x3fcf167e, 0x3ea4a4a5},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3f3d34bb, 0x3fdd7bfb, 0x3ec2c2c4},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3fa578ac, 0x3ebb4106, 0x3f2babac},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3de90311, 0x3fd9999a, 0x3f119192},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0xbe7ad3c8, 0x3f666666, 0x3f149495},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3fbbf815, 0x3e7144e6, 0x3f2aaaab},
    {Rule::code_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3f484b06, 0x3fbfd75e, 0x3ebababb},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbec94b20, 0xbf1a4f17, 0x3e34b4b5},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbe74e802, 0xbf7c7923, 0x3f39b9ba},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3feb4c25, 0x3ff50b11, 0x3ebababb},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3fe0f116, 0xbea76ecc, 0x3e44c4c6},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3f5b6db7, 0x3f841b35, 0x3f5edee0},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbf0a76aa, 0xbed1828f, 0x3f55d5d7},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0xbf58680e, 0x3f7466ed, 0x3f09898a},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::repeat, 0x3e924925, 0x3fe7a624, 0x3efcfcfe},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbec94b20, 0xbf1a4f17, 0x00000000},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbe74e802, 0xbf7c7923, 0x00000000},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3feb4c25, 0x3ff50b11, 0x3ea4a4a5},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3fe0f116, 0xbea76ecc, 0x3f5edee0},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3f5b6db7, 0x3f841b35, 0x3ea4a4a5},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbf0a76aa, 0xbed1828f, 0x00000000},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0xbf58680e, 0x3f7466ed, 0x3f149495},
    {Rule::single_lerps, TextureFilter::nearest, TextureWrap::clamp_to_edge, 0x3e924925, 0x3fe7a624, 0x3efcfcfe},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3eeeee7b, 0xbf1c0fe4, 0x3f5ae6d7},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3fdf4468, 0x3fcf167e, 0x3eb70468},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3f3d34bb, 0x3fdd7bfb, 0x3ea9962c},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3fa578ac, 0x3ebb4106, 0x3f13f460},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3de90311, 0x3fd9999a, 0x3eba06c2},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0xbe7ad3c8, 0x3f666666, 0x3ebf7852},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3fbbf815, 0x3e7144e6, 0x3f449938},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::repeat, 0x3f484b06, 0x3fbfd75e, 0x3f0535be},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3eeeee7b, 0xbf1c0fe4, 0x3ecd88d1},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3fdf4468, 0x3fcf167e, 0x3ea4a4a5},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3f3d34bb, 0x3fdd7bfb, 0x3ec1f038},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3fa578ac, 0x3ebb4106, 0x3f2ba24d},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3de90311, 0x3fd9999a, 0x3f114e91},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0xbe7ad3c8, 0x3f666666, 0x3f149495},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3fbbf815, 0x3e7144e6, 0x3f2a744d},
    {Rule::single_lerps, TextureFilter::linear, TextureWrap::clamp_to_edge, 0x3f484b06, 0x3fbfd75e, 0x3ebb3e1d},
};

Texture texture_of(int width, int height, TextureFilter filter, TextureWrap wrap) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    texture.filter = filter;
    texture.wrap_s = texture.wrap_t = wrap;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            for (int c = 0; c < 4; ++c)
                texture.texels.push_back(static_cast<std::uint8_t>(37 * i + 101 * j + 59 * c + 13 * i * j * j));
    return texture;
}

std::array<float, 4> sampled(const Texture& texture, Rule rule, float s, float t) {
    Lanes<float> s_lanes{}, t_lanes{};
    std::array<Lanes<float>, 4> rgba{};
    s_lanes[0] = s, t_lanes[0] = t;
    sample(texture, rule, s_lanes, t_lanes, rgba, 1);
    return {rgba[0][0], rgba[1][0], rgba[2][0], rgba[3][0]};
}

}  // namespace

TEST_CASE("lookups by lerps give the values that the two drivers drew") {
    std::uint64_t wrong = 0;
    for (const Drawn& one : drawn_by_mesa) {
        const Texture texture = texture_of(7, 5, one.filter, one.wrap);
        const float red = sampled(texture, one.rule, float_of(one.s), float_of(one.t))[0];
        wrong += bits_of(red) == one.red ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("lookups in mirrored and in sRGB textures give the values that llvmpipe and softpipe drew") {
    constexpr std::array rules{Rule::code_lerps_fused, Rule::code_lerps, Rule::single_lerps};
    for (const MesaLookup& one : lookups::by_mesa) {
        Texture texture = texture_of(7, 5, one.filter, one.wrap_s);
        texture.wrap_t = one.wrap_t;
        texture.decode_srgb = one.decodes_srgb;
        for (std::size_t driver = 0; driver < rules.size(); ++driver) {
            INFO("lookup " << &one - lookups::by_mesa << ", driver " << driver);
            CHECK(bits_of(sampled(texture, rules[driver], float_of(one.s), float_of(one.t))[0]) == one.red[driver]);
        }
    }
}

TEST_CASE("the drivers' tables of sRGB are within their errors of the exact values and the fused cubic is fused") {
    for (std::uint32_t code = 0; code < 256; ++code) {
        const double exact = double{srgb_to_linear[code]}, x = code;
        CHECK(std::abs(double{srgb_in_8_digits[code]} - exact) <= exact * 0x1p-23);
        CHECK(std::abs(double{srgb_cubic<true>[code]} - exact) <= 0.0013);
        if (code <= 15) continue;
        const double c1 = 0.0030 / 255, c2 = 0.6935 / (255.0 * 255), c3 = 0.3012 / (255.0 * 255 * 255);
        const double cubic = (x * x * c2 + 0.0023) + (x * x * c3 + c1) * x;
        CHECK(std::abs(double{srgb_cubic<true>[code]} - cubic) <= cubic * 0x1p-21);
        CHECK(std::abs(double{srgb_cubic<false>[code]} - cubic) <= cubic * 0x1p-21);
    }
    CHECK(srgb_cubic<true> != srgb_cubic<false>);
}

TEST_CASE("a lookup by codes is within 1.5 codes of exact arithmetic and one by floats within a few roundings") {
    Random random{61};
    std::uint64_t wrong = 0, cases = 0;
    for (const Rule rule : {Rule::code_lerps, Rule::code_lerps_fused, Rule::single_lerps})
        for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::clamp_to_edge, TextureWrap::mirrored_repeat})
            for (int round = 0; round < 500; ++round) {
                const int width = 1 + static_cast<int>(below(random, 9)),
                          height = 1 + static_cast<int>(below(random, 9));
                const Texture texture = texture_of(width, height, TextureFilter::linear, wrap);
                const float s = static_cast<float>(below(random, 4096)) / 1024.0f - 2.0f;
                const float t = static_cast<float>(below(random, 4096)) / 1024.0f - 2.0f;
                const auto found = sampled(texture, rule, s, t);
                const double u = double{s} * width - 0.5, v = double{t} * height - 0.5;
                const auto texel = [&](double column, double row, std::size_t c) {
                    const auto inside = [&](double k, int size) {
                        if (wrap == TextureWrap::clamp_to_edge) return std::min(std::max(k, 0.0), size - 1.0);
                        const double period = wrap == TextureWrap::repeat ? size : 2.0 * size;
                        const double place = k - period * std::floor(k / period);
                        return place < size ? place : period - 1 - place;
                    };
                    const double number = inside(row, height) * width + inside(column, width);
                    return static_cast<double>(texture.texels[4 * static_cast<std::size_t>(number) + c]);
                };
                const double x = std::floor(u), y = std::floor(v), a = u - x, b = v - y;
                // softpipe shows the next texel at the exact centre of one that is mirrored.
                if (rule == Rule::single_lerps && wrap == TextureWrap::mirrored_repeat && (a == 0 || b == 0)) continue;
                for (std::size_t c = 0; c < 4; ++c) {
                    const double exact = (texel(x, y, c) * (1 - a) + texel(x + 1, y, c) * a) * (1 - b) +
                                         (texel(x, y + 1, c) * (1 - a) + texel(x + 1, y + 1, c) * a) * b;
                    // A weight error of 1/512 is at most half a code along each axis, and each lerp rounds by half a
                    // code.
                    const double slack = rule != Rule::single_lerps ? 2.0 : 0.001;
                    wrong += std::abs(255.0 * double{found[c]} - exact) <= slack ? 0 : 1;
                    ++cases;
                }
            }
    CHECK(wrong == 0);
    CHECK(cases > 17000);
}

TEST_CASE("only sizes that are no power of two take the fraction of a coordinate before they repeat") {
    // The fraction of -2^-30 is 1 in binary32: the texel after the last one, which is the first.
    const auto red = [](int width, Rule rule) {
        const Texture texture = texture_of(width, 1, TextureFilter::nearest, TextureWrap::repeat);
        return sampled(texture, rule, -0x1p-30f, 0.5f)[0] * 255;
    };
    const auto code = [](int i) { return Approx(static_cast<std::uint8_t>(37 * i)); };
    for (const Rule rule : {Rule::code_lerps, Rule::code_lerps_fused}) {
        CHECK(red(8, rule) == code(7));
        CHECK(red(7, rule) == code(0));
    }
    CHECK(red(8, Rule::single_lerps) == code(7));
    CHECK(red(7, Rule::single_lerps) == code(6));
}

TEST_CASE("an 8-bit lookup by lerps is a code times the binary32 of 1/255 and decoded texels are mixed as floats") {
    const float of_code = 1.0f / 255.0f;
    Texture texture = texture_of(2, 1, TextureFilter::linear, TextureWrap::clamp_to_edge);
    texture.texels = {0, 0, 0, 255, 255, 255, 255, 255};
    CHECK(sampled(texture, Rule::code_lerps, 0.5f, 0.5f)[0] == 128.0f * of_code);  // 127.5 rounds up
    CHECK(sampled(texture, Rule::single_lerps, 0.5f, 0.5f)[0] == 0.5f);
    texture.decode_srgb = true;
    texture.texels[0] = 128;
    CHECK(sampled(texture, Rule::code_lerps, 0.0f, 0.5f)[0] == srgb_cubic<false>[128]);
    CHECK(sampled(texture, Rule::code_lerps_fused, 0.0f, 0.5f)[0] == srgb_cubic<true>[128]);
    CHECK(sampled(texture, Rule::single_lerps, 0.0f, 0.5f)[0] == srgb_in_8_digits[128]);
    CHECK(sampled(texture, Rule::code_lerps, 0.0f, 0.5f)[3] == texture.texels[3] * of_code);
    texture.target = TextureTarget::rectangle;
    CHECK(sampled(texture, Rule::code_lerps, 0.5f, 0.5f)[0] == srgb_cubic<false>[128]);
    texture.decode_srgb = false;
    CHECK(sampled(texture, Rule::code_lerps, 1.0f, 0.5f)[1] == 128.0f * of_code);
    for (const std::uint32_t odd : {0x7fc00000u, 0x7f800000u, 0xff800000u})
        CHECK(sampled(texture, Rule::single_lerps, float_of(odd), 0.5f)[3] == 1.0f);
}

}  // namespace strata::testing::lerps_model
