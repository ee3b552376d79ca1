// Tests blending on 8-bit targets against the integer model of tests/pipeline/blend_model.h.
#include "pipeline/stages/blend_unorm8.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/pipeline/blend_model.h"

using namespace strata::pipeline;

namespace {

// Blends the codes of one fragment on an 8-bit target with four channels; the sources are codes, too.
std::array<int, 4> blended(const Blend& state, const std::array<int, 4>& source, const std::array<int, 4>& stored) {
    static Colors src;
    static Codes codes;
    for (std::size_t c = 0; c < 4; ++c) {
        src[c][0] = static_cast<float>(source[c]) / 255.0f;
        codes[c][0] = static_cast<std::uint32_t>(stored[c]);
    }
    blend(state, ChannelType::unorm8, {}, 4, src, codes, 1);
    std::array<int, 4> result{};
    for (std::size_t c = 0; c < 4; ++c) result[c] = static_cast<int>(codes[c][0]);
    return result;
}

}  // namespace

TEST_CASE("the shifted form divides every sum by 255 both rounded and truncated") {
    int wrong = 0;
    for (int t = 0; t <= 65025; ++t) {
        wrong += over_255<BlendRounding::nearest>(t) == (2 * t + 255) / 510 ? 0 : 1;
        wrong += over_255<BlendRounding::truncate>(t) == t / 255 ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("each_product rounds s F and d G separately for all pairs of codes before they are added and clamped") {
    // The shift formula in integers; a product with 255 returns the other factor unchanged.
    const auto product = [](int a, int b) { return (a * b + a * b / 256 + 128) / 256; };
    DeviceProfile profile;
    profile.blend_rounding = BlendRounding::each_product;
    static Colors src;
    static Codes codes;
    int wrong = 0, unlike_once = 0, unlike_exact = 0;
    for (const Blend& state : {blend_mode::over, blend_mode::sum}) {
        const bool is_over = state == blend_mode::over;
        for (int alpha = 0; alpha < 256; ++alpha)
            for (int c = 0; c < 256; c += is_over ? 1 : 5) {
                const int stored = (c * 7 + alpha * 3) % 256;
                const std::array values{c, 255 - c, c / 2, alpha};
                for (std::size_t k = 0; k < 4; ++k) {
                    src[k][0] = static_cast<float>(values[k]) / 255.0f;
                    codes[k][0] = static_cast<std::uint32_t>(stored);
                }
                blend(state, ChannelType::unorm8, profile, 4, src, codes, 1);
                for (std::size_t k = 0; k < 4; ++k) {
                    const int F = is_over ? alpha : 255, G = is_over ? 255 - alpha : 255;
                    const int sum = product(values[k], F) + product(stored, G);
                    wrong += static_cast<int>(codes[k][0]) == std::min(sum, 255) ? 0 : 1;
                    unlike_once += sum == (2 * (values[k] * F + stored * G) + 255) / 510 ? 0 : 1;
                }
            }
    }
    for (int a = 0; a < 256; ++a)
        for (int b = 0; b < 256; ++b) unlike_exact += product(a, b) == (2 * a * b + 255) / 510 ? 0 : 1;
    CHECK(wrong == 0);
    CHECK(unlike_once > 1000);
    CHECK(unlike_exact == 24);
}

// Operation by operation: a binary32 product or sum that is rounded to binary64 and then to binary32 is correctly
// rounded.
TEST_CASE(
    "unrounded_source blends the clamped source with the values of codes in binary32 and rounds to a code at the end") {
    const auto single = [](double exact) { return static_cast<float>(exact); };
    const auto clamped = [](float x) { return x > 0.0f ? std::min(x, 1.0f) : 0.0f; };
    Random random{8133};
    Tally tally;
    int unlike_codes = 0;
    for (const UnormRounding unorm :
         {UnormRounding::half_up, UnormRounding::product_even, UnormRounding::product_even_wide}) {
        DeviceProfile profile;
        profile.blend_rounding = BlendRounding::unrounded_source;
        profile.unorm_rounding = unorm;
        const auto read = [&](std::uint32_t code) {
            if (unorm == UnormRounding::half_up) return single(code / 255.0);
            if (unorm == UnormRounding::product_even)
                return single(double{static_cast<float>(code)} * double{single(1.0 / 255.0)});
            return single(double{static_cast<float>(257 * code)} * double{single(1.0 / 65535.0)});
        };
        const auto write = [&](float x) {
            const double exact = unorm == UnormRounding::half_up ? std::floor(double{clamped(x)} * 255.0 + 0.5)
                                                                 : std::nearbyint(single(double{clamped(x)} * 255.0));
            return static_cast<std::uint32_t>(exact);
        };
        for (int round = 0; round < 4000; ++round) {
            const Blend state = any_blend(random);
            if (state.color.equation >= BlendEquation::signed_add || state.alpha.equation >= BlendEquation::signed_add)
                continue;
            const int channels = one_in(random, 4) ? static_cast<int>(below(random, 4)) + 1 : 4;
            Colors src;
            Codes codes, before;
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t i = 0; i < 256; ++i) {
                    src[c][i] =
                        one_in(random, 4) ? any_float(random) : static_cast<float>(below(random, 1u << 24)) * 0x1p-24f;
                    codes[c][i] = any_byte(random);
                }
            before = codes;
            blend(state, ChannelType::unorm8, profile, channels, src, codes, 20);
            for (std::size_t i = 0; i < 20; ++i) {
                Fragment<float> f{};
                for (std::size_t c = 0; c < 4; ++c) {
                    f.source[c] = clamped(src[c][i]);
                    f.stored[c] = read(before[c][i]);
                    f.constant[c] = clamped(state.constant[c]);
                }
                if (channels < 4) f.stored[3] = 1.0f;
                for (std::size_t c = 0; c < 4; ++c) {
                    const bool is_written = c < static_cast<std::size_t>(channels) && (state.write_mask >> c & 1) != 0;
                    const BlendTerm& term = c == 3 ? state.alpha : state.color;
                    const auto complement = [&](float x) { return single(1.0 - double{x}); };
                    const auto lesser = [](float a, float b) { return std::min(a, b); };
                    const auto part = [&](float x, BlendFactor by) {
                        return double{single(double{x} * double{model_factor(by, f, c, 1.0f, complement, lesser)})};
                    };
                    const double source = part(f.source[c], term.src), stored = part(f.stored[c], term.dst);
                    const float value = !state.enabled                             ? src[c][i]
                                        : term.equation == BlendEquation::min      ? std::min(f.source[c], f.stored[c])
                                        : term.equation == BlendEquation::max      ? std::max(f.source[c], f.stored[c])
                                        : term.equation == BlendEquation::subtract ? single(source - stored)
                                        : term.equation == BlendEquation::reverse_subtract ? single(stored - source)
                                                                                           : single(source + stored);
                    tally.expect(codes[c][i] == (is_written ? write(value) : before[c][i]),
                                 [&] { return fmt::format("channel {}: {} over {}", c, src[c][i], before[c][i]); });
                    if (c == 0 && is_written && state == blend_mode::over) ++unlike_codes;
                }
            }
        }
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    // OVER with a source of 0.3 on code 85 gives 79 with the exact source and 80 with its code.
    DeviceProfile profile;
    static Colors src;
    static Codes codes;
    std::array<std::uint32_t, 2> found{};
    int differ = 0;
    for (std::uint32_t code = 0; code < 256; ++code) {
        for (const BlendRounding rounding : {BlendRounding::nearest, BlendRounding::unrounded_source}) {
            profile.blend_rounding = rounding;
            for (std::size_t c = 0; c < 4; ++c) src[c][0] = 0.3f, codes[c][0] = code;
            blend(blend_mode::over, ChannelType::unorm8, profile, 4, src, codes, 1);
            found[rounding == BlendRounding::nearest ? 0 : 1] = codes[0][0];
        }
        differ += found[0] != found[1] ? 1 : 0;
    }
    CHECK(differ > 20);
}

TEST_CASE("differences of separately rounded products end at 0") {
    DeviceProfile profile;
    profile.blend_rounding = BlendRounding::each_product;
    Blend state = blend_mode::sum;
    static Colors src;
    static Codes codes;
    for (const BlendEquation equation : {BlendEquation::subtract, BlendEquation::reverse_subtract}) {
        state.color.equation = state.alpha.equation = equation;
        for (std::size_t k = 0; k < 4; ++k) src[k][0] = 0.2f, codes[k][0] = 100;  // 51
        blend(state, ChannelType::unorm8, profile, 4, src, codes, 1);
        CHECK(codes[0][0] == (equation == BlendEquation::subtract ? 0u : 49u));
    }
}

TEST_CASE("every 8-bit channel becomes the exact sum rounded once for random states and fragments", "[slow]") {
    Random random{8};
    Tally tally;
    for (int round = 0; round < 10000; ++round) {
        const Blend state = any_blend(random);
        DeviceProfile profile;
        profile.blend_rounding = any_of(random, BlendRounding::truncate);
        const int count = one_in(random, 16) ? 256 : static_cast<int>(below(random, 20));
        const int channels = one_in(random, 4) ? static_cast<int>(below(random, 4)) + 1 : 4;
        Colors src;
        Codes codes, before;
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < 256; ++i) src[c][i] = any_float(random), codes[c][i] = any_byte(random);
        before = codes;
        blend(state, ChannelType::unorm8, profile, channels, src, codes, count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            Fragment<int> f{};
            for (std::size_t c = 0; c < 4; ++c) {
                f.source[c] = model::unorm8(bits_of(src[c][i]));
                f.stored[c] = static_cast<int>(before[c][i]);
                f.constant[c] = model::unorm8(bits_of(state.constant[c]));
            }
            if (channels < 4) f.stored[3] = 255;
            for (std::size_t c = 0; c < 4; ++c) {
                const bool is_written = c < static_cast<std::size_t>(channels) && (state.write_mask >> c & 1) != 0;
                const auto expected =
                    is_written ? static_cast<std::uint32_t>(model_unorm8(state, profile.blend_rounding, f, c))
                               : before[c][i];
                tally.expect(codes[c][i] == expected, [&] {
                    return fmt::format("{} channel {} of {}: s {} d {} -> {}, not {}", words(state), c, channels,
                                       f.source[c], f.stored[c], codes[c][i], expected);
                });
            }
        }
        for (std::size_t c = 0; c < 4; ++c)
            // lanes up to the end of the vector may be overwritten
            for (auto i = static_cast<std::size_t>((count + 15) / 16 * 16); i < 256; ++i)
                tally.expect(codes[c][i] == before[c][i], [&] { return fmt::format("lane {} beyond {}", i, count); });
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() >= 100000);
}

TEST_CASE("OVER gives the rational value rounded half up for every source and destination and alpha", "[slow]") {
    Colors src;
    Codes codes;
    std::uint64_t wrong = 0;
    for (int alpha = 0; alpha < 256; ++alpha)
        for (int s = 0; s < 256; ++s) {
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t d = 0; d < 256; ++d) {
                    src[c][d] = static_cast<float>(c == 3 ? alpha : s) / 255.0f;
                    codes[c][d] = static_cast<std::uint32_t>(d);
                }
            blend(blend_mode::over, ChannelType::unorm8, {}, 4, src, codes, 256);
            for (int d = 0; d < 256; ++d) {  // k - 1/2 <= (s a + d (255 - a)) / 255 < k + 1/2
                const int twice = 2 * (s * alpha + d * (255 - alpha));
                for (std::size_t c = 0; c < 3; ++c) {
                    const int k = static_cast<int>(codes[c][static_cast<std::size_t>(d)]);
                    wrong += 255 * (2 * k - 1) <= twice && twice < 255 * (2 * k + 1) ? 0 : 1;
                }
            }
        }
    CHECK(wrong == 0);
}

// pipeline/reference/chip-fragment.md 1.2: one rounding of the exact sum. Rounding each product separately does not
// reproduce 152 of 239 captures.
TEST_CASE("the sum is rounded once and not each product") {
    const Blend halves{true,
                       {BlendEquation::add, BlendFactor::constant_color, BlendFactor::constant_color},
                       {},
                       {0.5f, 0.5f, 0.5f, 0.5f},
                       0xf};
    CHECK(blended(halves, {1, 3, 5, 0}, {1, 3, 5, 0})[0] == 1);  // 256 / 255; rounded products would give 1 + 1
    CHECK(blended(halves, {1, 3, 5, 0}, {1, 3, 5, 0})[1] == 3);  // 768 / 255; rounded products would give 2 + 2
}

TEST_CASE("a sum beyond the range is clamped before it is rounded") {
    CHECK(blended(blend_mode::sum, {200, 255, 1, 255}, {100, 255, 2, 1}) == std::array{255, 255, 3, 255});
    const BlendTerm difference{BlendEquation::subtract, BlendFactor::one, BlendFactor::one};
    CHECK(blended({true, difference, difference, {}, 0xf}, {10, 200, 0, 7}, {20, 50, 255, 7}) ==
          std::array{0, 150, 0, 0});
    const BlendTerm reversed{BlendEquation::reverse_subtract, BlendFactor::one, BlendFactor::one};
    CHECK(blended({true, reversed, reversed, {}, 0xf}, {10, 200, 0, 7}, {20, 50, 255, 7}) == std::array{10, 0, 255, 0});
}

TEST_CASE("MIN and MAX ignore their factors") {
    const BlendTerm least{BlendEquation::min, BlendFactor::zero, BlendFactor::src_alpha};
    CHECK(blended({true, least, least, {}, 0xf}, {10, 200, 0, 7}, {20, 50, 255, 7}) == std::array{10, 50, 0, 7});
    const BlendTerm most{BlendEquation::max, BlendFactor::zero, BlendFactor::zero};
    CHECK(blended({true, most, most, {}, 0xf}, {10, 200, 0, 7}, {20, 50, 255, 7}) == std::array{20, 200, 255, 7});
}

TEST_CASE("SRC_ALPHA_SATURATE is the lesser of As and 1 - Ad for the colours and 1 for alpha") {
    const BlendTerm saturate{BlendEquation::add, BlendFactor::src_alpha_saturate, BlendFactor::zero};
    CHECK(blended({true, saturate, saturate, {}, 0xf}, {255, 255, 255, 100}, {0, 0, 0, 200}) ==
          std::array{55, 55, 55, 100});
    CHECK(blended({true, saturate, saturate, {}, 0xf}, {255, 255, 255, 100}, {0, 0, 0, 20}) ==
          std::array{100, 100, 100, 100});
}

TEST_CASE("UNDER and OVER with zeros leave every code unchanged in every rounding", "[slow]") {
    static Colors src;
    static Codes codes;
    int wrong = 0;
    DeviceProfile profile;
    for (const BlendRounding rounding : {BlendRounding::nearest, BlendRounding::truncate, BlendRounding::each_product})
        for (const Blend& state : {blend_mode::under, blend_mode::over})
            for (std::uint32_t stored = 0; stored < 256 * 256; ++stored) {
                profile.blend_rounding = rounding;
                for (std::size_t c = 0; c < 4; ++c) {
                    src[c][0] = 0.0f;
                    codes[c][0] = c == 3 ? stored >> 8 : stored & 0xff;
                }
                blend(state, ChannelType::unorm8, profile, 4, src, codes, 1);
                for (std::size_t c = 0; c < 4; ++c)
                    wrong += codes[c][0] == (c == 3 ? stored >> 8 : stored & 0xff) ? 0 : 1;
            }
    CHECK(wrong == 0);
}

TEST_CASE("under-blending on 8 bits multiplies the transmittance and adds the source weighted by it") {
    std::array<int, 4> stored{0, 0, 0, 255};
    stored = blended(blend_mode::under, {128, 0, 0, 128}, stored);
    CHECK(stored == std::array{128, 0, 0, 127});
    stored = blended(blend_mode::under, {0, 128, 0, 128}, stored);
    CHECK(stored == std::array{128, 64, 0, 63});  // 127 * 128 / 255 = 63.75 and 127 * 127 / 255 = 63.25
}
