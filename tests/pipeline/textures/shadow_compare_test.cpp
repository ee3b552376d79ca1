// Tests shadow lookups against comparisons of stored depths in rational arithmetic, with the texels of
// tests/pipeline/addressing_model.h.
#include "pipeline/textures/shadow_compare.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/pipeline/addressing_model.h"
#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;
using model::Rational;
using strata::rasterizer::Lanes;

namespace {

DeviceProfile device(DepthRounding rounding, TextureFilterPrecision precision) {
    DeviceProfile profile;
    profile.raster.depth_rounding = rounding;
    profile.texture_filter = precision;
    return profile;
}

// R as the buffer would store it, in rational arithmetic.
double stored(float r, Format format, DepthRounding rounding) {
    if (format == Format::d32f) return r;
    const int top = format == Format::d16 ? 65535 : 16777215;
    if (is_nan(r) || r < 0) return 0;
    if (r > 1) return top;
    const Rational half = rounding == DepthRounding::nearest ? Rational{1, 2} : Rational{0};
    return static_cast<double>(model::floor(Rational{r} * top + half));
}

double meaning(std::uint32_t code, Format format) {
    return format == Format::d32f ? double{float_of(code)} : static_cast<double>(code);
}

Image any_depth_image(Random& random) {
    const Format format = std::array{Format::d16, Format::d24, Format::d24s8, Format::d32f}[below(random, 4)];
    Image image{format, static_cast<int>(below(random, 5)) + 1, static_cast<int>(below(random, 5)) + 1};
    for (std::uint32_t& code : image.codes)
        code = format == Format::d32f  ? bits_of(any_float(random))
               : format == Format::d16 ? below(random, 0x10000)
                                       : below(random, 0x1000000);
    return image;
}

// A random R, near a texel of the image or arbitrary.
float any_reference(Random& random, const Image& image) {
    if (one_in(random, 2)) return any_float(random);
    const std::uint32_t code = image.codes[below(random, static_cast<std::uint32_t>(image.codes.size()))];
    if (image.format == Format::d32f) return float_of(code);
    return static_cast<float>((code + (one_in(random, 2) ? 0.5 : 0.0)) /
                              (image.format == Format::d16 ? 65535 : 16777215));
}

float model_compare_texels(const Image& image, const ShadowCompare& state, const DeviceProfile& profile, float s,
                           float t, float r) {
    const bool snaps = profile.texture_filter == TextureFilterPrecision::single;
    const auto x = model::texels(state.target, state.wrap_s, image.width, state.filter, snaps, s);
    const auto y = model::texels(state.target, state.wrap_t, image.height, state.filter, snaps, t);
    const auto tap = [&](int column, int row) {
        const std::uint32_t code = image.codes[static_cast<std::size_t>(row * image.width + column)];
        const double reference = stored(r, image.format, profile.raster.depth_rounding);
        return model_compare(state.func, reference, meaning(code, image.format)) ? 1.0f : state.fail_value;
    };
    if (state.filter == TextureFilter::nearest) return tap(x.first, y.first);
    const std::array<float, 4> value{tap(x.first, y.first), tap(x.second, y.first), tap(x.first, y.second),
                                     tap(x.second, y.second)};
    const std::array<int, 4> weight{(256 - x.weight) * (256 - y.weight), x.weight * (256 - y.weight),
                                    (256 - x.weight) * y.weight, x.weight * y.weight};
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto product = static_cast<float>(double{value[k]} * weight[k] / 65536);
        sum = k == 0 ? product : static_cast<float>(double{sum} + double{product});
    }
    return sum;
}

std::array<float, 4> compare_one(const Image& image, const ShadowCompare& state, const DeviceProfile& profile, float s,
                                 float r) {
    Lanes<float> s_lanes{}, t_lanes{}, r_lanes{};
    std::array<Lanes<float>, 4> rgba{};
    s_lanes[0] = s, t_lanes[0] = 0.5f, r_lanes[0] = r;
    shadow_compare(image, state, profile, {s_lanes, t_lanes, r_lanes}, rgba, 1);
    return {rgba[0][0], rgba[1][0], rgba[2][0], rgba[3][0]};
}

Image one_texel(Format format, std::uint32_t code) {
    Image image{format, 1, 1};
    image.codes[0] = code;
    return image;
}

const DeviceProfile floors = device(DepthRounding::floor, TextureFilterPrecision::unorm8);

}  // namespace

TEST_CASE("a shadow lookup compares R with each texel like two stored depths for random images and coordinates",
          "[slow]") {
    Random random{44};
    Tally tally;
    for (int round = 0; round < 8000; ++round) {
        const Image image = any_depth_image(random);
        ShadowCompare state;
        state.func = any_of(random, CompareFunc::always);
        state.fail_value = one_in(random, 2) ? 0.0f : static_cast<float>(below(random, 256)) / 255.0f;
        state.target = any_of(random, TextureTarget::rectangle);
        state.filter = any_of(random, TextureFilter::linear);
        state.wrap_s = any_of(random, TextureWrap::clamp_to_edge);
        state.wrap_t = any_of(random, TextureWrap::clamp_to_edge);
        const DeviceProfile profile =
            device(any_of(random, DepthRounding::nearest), any_of(random, TextureFilterPrecision::single));
        const auto count = static_cast<std::size_t>(below(random, 33));
        Lanes<float> s{}, t{}, r{};
        std::array<Lanes<float>, 4> rgba{};
        for (std::size_t i = 0; i < count; ++i) {
            s[i] = model::any_coordinate(random, image.width), t[i] = model::any_coordinate(random, image.height);
            r[i] = any_reference(random, image);
        }
        shadow_compare(image, state, profile, {s, t, r}, rgba, static_cast<int>(count));
        for (std::size_t i = 0; i < count; ++i) {
            const float expected = model_compare_texels(image, state, profile, s[i], t[i], r[i]);
            tally.expect(bits_of(rgba[0][i]) == bits_of(expected), [&] {
                return fmt::format("format {} func {} filter {} at {} {}: R {:08x}: {} not {}",
                                   static_cast<int>(image.format), static_cast<int>(state.func),
                                   static_cast<int>(state.filter), s[i], t[i], bits_of(r[i]), rgba[0][i], expected);
            });
        }
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() >= 100000);
}

TEST_CASE("LEQUAL lights a fragment at exactly the depth that it wrote itself") {
    for (const DepthRounding rounding : {DepthRounding::floor, DepthRounding::nearest}) {
        const DeviceProfile profile = device(rounding, TextureFilterPrecision::unorm8);
        Random random{1};
        int dark = 0;
        for (int i = 0; i < 1000; ++i) {
            const float z = static_cast<float>(below(random, 1u << 24)) * 0x1p-24f;
            const Image own = one_texel(Format::d24, strata::rasterizer::to_depth_code(z, DepthFormat::d24, rounding));
            dark += compare_one(own, {.func = CompareFunc::lequal}, profile, 0.5f, z)[0] == 1.0f ? 0 : 1;
            dark += compare_one(own, {.func = CompareFunc::greater}, profile, 0.5f, z)[0] == 0.0f ? 0 : 1;
        }
        CHECK(dark == 0);
    }
}

TEST_CASE("LEQUAL means R <= texel and GEQUAL R >= texel unlike the text of SGIX_shadow") {
    const Image middle = one_texel(Format::d16, 0x8000);
    CHECK(compare_one(middle, {.func = CompareFunc::lequal}, floors, 0.5f, 0.25f)[0] == 1.0f);
    CHECK(compare_one(middle, {.func = CompareFunc::lequal}, floors, 0.5f, 0.75f)[0] == 0.0f);
    CHECK(compare_one(middle, {.func = CompareFunc::gequal}, floors, 0.5f, 0.75f)[0] == 1.0f);
}

TEST_CASE("R is clamped for fixed-point texels and not for float ones") {
    CHECK(compare_one(one_texel(Format::d24, 0xffffff), {.func = CompareFunc::lequal}, floors, 0.5f, 7.0f)[0] == 1.0f);
    CHECK(compare_one(one_texel(Format::d32f, bits_of(1.0f)), {.func = CompareFunc::lequal}, floors, 0.5f, 7.0f)[0] ==
          0.0f);
    CHECK(compare_one(one_texel(Format::d32f, bits_of(-1.0f)), {.func = CompareFunc::greater}, floors, 0.5f, 0.0f)[0] ==
          1.0f);
}

TEST_CASE("the result is placed by the depth texture mode and a failure gives the ambient value") {
    const Image far_plane = one_texel(Format::d24, 0xffffff);
    const auto routed = [&](DepthTextureMode mode, CompareFunc func) {
        return compare_one(far_plane, {.func = func, .mode = mode, .fail_value = 0.25f}, floors, 0.5f, 0.5f);
    };
    CHECK(routed(DepthTextureMode::luminance, CompareFunc::never) == std::array{0.25f, 0.25f, 0.25f, 1.0f});
    CHECK(routed(DepthTextureMode::intensity, CompareFunc::never) == std::array{0.25f, 0.25f, 0.25f, 0.25f});
    CHECK(routed(DepthTextureMode::alpha, CompareFunc::never) == std::array{0.0f, 0.0f, 0.0f, 0.25f});
    CHECK(routed(DepthTextureMode::texture_shader_alpha, CompareFunc::always) == std::array{1.0f, 1.0f, 1.0f, 1.0f});
    CHECK(routed(DepthTextureMode::texture_shader_alpha, CompareFunc::never) == std::array{1.0f, 1.0f, 1.0f, 0.25f});
}

TEST_CASE("a linear lookup gives the fraction of its four texels that pass in steps of 1/256 along an edge") {
    Image edge{Format::d16, 2, 1};
    edge.codes = {0, 0xffff};
    const ShadowCompare state{.func = CompareFunc::lequal, .filter = TextureFilter::linear};
    CHECK(compare_one(edge, state, floors, 0.25f, 0.5f)[0] == 0.0f);
    CHECK(compare_one(edge, state, floors, 0.375f, 0.5f)[0] == 0.25f);
    CHECK(compare_one(edge, state, floors, 0.5f, 0.5f)[0] == 0.5f);
    CHECK(compare_one(edge, state, floors, 0.5f + 0x1p-10f, 0.5f)[0] == 0.5f);
    CHECK(compare_one(edge, state, floors, 0.5f + 0x1p-9f, 0.5f)[0] == 0.5f + 0x1p-8f);
}

TEST_CASE(
    "8-bit depth texels compare R rounded to 255 steps as in Heidrich's limited form for all texels and half steps") {
    Image image{Format::d16, 256, 1};
    for (std::uint32_t k = 0; k < 256; ++k) image.codes[k] = k;
    DepthTexels texels{image};
    texels.is_eight_bit = true;
    const auto rounding = GENERATE(DepthRounding::floor, DepthRounding::nearest);
    const DeviceProfile profile = device(rounding, TextureFilterPrecision::single);
    Lanes<float> s, t, r;
    std::array<Lanes<float>, 4> rgba;
    for (int step = 0; step <= 510; ++step) {
        const Rational exact = Rational{static_cast<float>(step) / 510.0f} * 255 +
                               (rounding == DepthRounding::nearest ? Rational{1, 2} : Rational{0});
        for (std::size_t k = 0; k < 256; ++k) {
            s[k] = static_cast<float>(k) + 0.5f;
            t[k] = 0.5f;
            r[k] = static_cast<float>(step) / 510.0f;
        }
        shadow_compare(texels, {.func = CompareFunc::lequal, .target = TextureTarget::rectangle}, profile, {s, t, r},
                       rgba, 256);
        int lit = 0;
        for (std::size_t k = 0; k < 256; ++k) lit += rgba[0][k] == 1.0f;
        REQUIRE(lit == 256 - static_cast<int>(model::floor(exact)));
    }
}

TEST_CASE("R is truncated to 12 bits of mantissa for a 16-bit float texel and equal up to the next texel value") {
    DeviceProfile chip = floors;
    chip.raster.window_z = strata::rasterizer::WindowZ::buffer_units;
    const auto is = [&](std::uint32_t code, CompareFunc func, float r) {
        return compare_one(one_texel(Format::d16f, code), {.func = func}, chip, 0.5f, r)[0] == 1.0f;
    };
    const auto below_of = [](float v) { return std::nextafter(v, 0.0f); };
    int wrong = 0;
    // Bits 12 to 15 of a code are the exponent e: 2^(e - 7).
    for (std::uint32_t code = 0x1000; code <= 0xffff; code += 5) {
        const float value =
            std::ldexp(1.0f + static_cast<float>(code % 4096) / 4096.0f, static_cast<int>(code / 4096) - 7);
        const float step = std::ldexp(1.0f, static_cast<int>(code / 4096) - 19);
        wrong += !is(code, CompareFunc::equal, value) + !is(code, CompareFunc::equal, below_of(value + step)) +
                 !is(code, CompareFunc::less, below_of(value)) + is(code, CompareFunc::greater, value);
        wrong += code < 0xffff && !is(code, CompareFunc::greater, value + step);
    }
    CHECK(wrong == 0);
    CHECK(is(0xffff, CompareFunc::equal, 1e9f));          // clamped to 511.9375
    CHECK(is(0, CompareFunc::equal, below_of(0x1p-6f)));  // below the smallest normal value
    CHECK(is(0, CompareFunc::equal, -1.0f));
    const float between = 1.0f + 0x1p-13f;
    CHECK(is(0x7000, CompareFunc::equal, between));
    chip.raster.hypothesis.quantize_reference = false;
    CHECK(is(0x7000, CompareFunc::greater, between));
    CHECK(is(0xffff, CompareFunc::equal, 1e9f));
}
