// Tests every instruction set of the processor against the scalar loops that define the stages, bit by bit. The scalar
// loops are tested against independent models by the tests of their headers.
#include <atomic>
#include <catch2/catch.hpp>

#include "pipeline/stages/alpha_test.h"
#include "pipeline/stages/blend_lanes.h"
#include "pipeline/stages/lane_words.h"
#include "pipeline/stages/stencil_lanes.h"
#include "rasterizer/base/parallel.h"
#include "rasterizer/base/simd.h"
#include "tests/pipeline/blend_model.h"
#include "tests/pipeline/stage_values.h"

using namespace strata;
using namespace strata::pipeline;
using Values = scalar::ColorLanes;

namespace {

// Runs `check` on every instruction set except the scalar one, and restores the setting.
template <class Check>
void for_each_set(Check&& check) {
    for (const Simd simd : available_simd()) {
        if (simd == Simd::scalar) continue;
        const SimdScope kernels{simd};
        INFO("instruction set " << static_cast<int>(simd));
        check();
    }
}

// Lengths around every vector length.
constexpr std::array<int, 20> counts{0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 253, 256};

int any_count(Random& random) { return counts[below(random, counts.size())]; }

constexpr std::size_t plane_pixels = 300;

// Distinct pixels: consecutive pixels, groups of consecutive pixels with gaps between them, the pixels up to the
// plane's last with a few missing, or random order.
CodeLanes any_pixels(Random& random) {
    CodeLanes pixel{};
    const std::uint32_t kind = below(random, 5), start = below(random, 45), run = 1 + below(random, 40);
    for (std::uint32_t p = 0, i = 0; kind == 4 && i < 256; ++p)
        if (below(random, plane_pixels - p) < 256 - i) pixel[i++] = p;
    if (kind == 4) return pixel;
    for (std::uint32_t i = 0; i < 256; ++i)
        pixel[i] = kind == 0   ? i + start
                   : kind == 1 ? i + (i >= run ? start : 0)
                   : kind == 2 ? (i * 7 + start) % plane_pixels
                               : (i ^ 1u) + start;
    if (kind == 0 && one_in(random, 2)) std::swap(pixel[below(random, 256)], pixel[below(random, 256)]);
    return pixel;
}

CodeLanes any_mask(Random& random) {
    const std::uint32_t density = below(random, 3);
    CodeLanes lanes{};
    for (auto& lane : lanes) lane = density == 0 || (density == 1 && one_in(random, 2)) ? ~0u : 0u;
    return lanes;
}

std::uint32_t any_word(Random& random) { return bits_of(any_float(random)); }

// One sample of a target: its planes, and the memory after each.
struct Memory {
    std::vector<Word> words = std::vector<Word>(4 * (plane_pixels + spare_words));
    Texels texels;

    // A 32-bit value has no bits besides its channels (r16f).
    Memory(Random& random, int channels, int bits) : texels{{}, channels, bits} {
        const Word owned = channels * bits < 32 ? 0xffffu : ~0u;
        for (Word& word : words) word = any_word(random) & owned;
    }
    [[nodiscard]] Texels at() {
        Texels result = texels;
        result.first = {words.data(), plane_pixels};
        return result;
    }
    // The padding elements are unused.
    [[nodiscard]] bool same_pixels(const Memory& other) const {
        for (std::size_t i = 0; i < words.size(); ++i)
            if (i % (plane_pixels + spare_words) < plane_pixels && words[i] != other.words[i]) return false;
        return true;
    }
};

template <class T>
bool same_lanes(const rasterizer::Lanes<T>& a, const rasterizer::Lanes<T>& b, int count) {
    return std::equal(a.begin(), a.begin() + count, b.begin(),
                      [](T x, T y) { return std::bit_cast<Word>(x) == std::bit_cast<Word>(y); });
}

constexpr std::array<std::array<int, 2>, 5> layouts{{{4, 8}, {4, 16}, {1, 16}, {4, 32}, {2, 32}}};

}  // namespace

TEST_CASE("gather and scatter move the same codes on every instruction set for any order of the pixels") {
    for_each_set([] {
        Random random{501};
        Tally tally;
        for (int round = 0; round < 2000; ++round) {
            const auto& layout = layouts[below(random, layouts.size())];
            const int channels = layout[0], bits = layout[1];
            Memory expected{random, channels, bits};
            Memory found = expected;
            const CodeLanes pixel = any_pixels(random), alive = any_mask(random);
            const int count = any_count(random);
            const PixelLanes at{pixel.data(), static_cast<std::size_t>(count)};
            scalar::ColorCodes wanted{}, got{};
            scalar::gather_codes(expected.at(), at, wanted.data());
            gather_codes(found.at(), at, got.data());
            bool same = true;
            for (std::size_t c = 0; c < 4; ++c) same &= same_lanes(wanted[c], got[c], count);
            for (auto& lanes : wanted)
                for (auto& code : lanes) code = any_word(random) & expected.texels.field(0).bits;
            const unsigned mask = one_in(random, 2) ? 0xfu : below(random, 16);
            scalar::scatter_codes(expected.at(), at, alive.data(), mask, wanted.data());
            scatter_codes(found.at(), at, alive.data(), mask, wanted.data());
            same &= expected.same_pixels(found);
            same &= scalar::count_lanes(alive.data(), at.count) == count_lanes(alive.data(), at.count);
            tally.expect(same,
                         [&] { return fmt::format("round {}: {} x {} bits, {} lanes", round, channels, bits, count); });
        }
        INFO("first wrong: " << tally.first());
        CHECK(tally.wrong() == 0);
    });
}

TEST_CASE("the depth test in a plane rejects and counts and writes the same on every instruction set", "[slow]") {
    for_each_set([] {
        Random random{502};
        Tally tally;
        for (int round = 0; round < 4000; ++round) {
            const DepthTest state{!one_in(random, 8), any_of(random, CompareFunc::always), one_in(random, 2)};
            const auto format = any_of(random, DepthFormat::d32f);
            Memory expected{random, 1, 32};
            CodeLanes code{};
            const CodeLanes pixel = any_pixels(random);
            for (std::size_t i = 0; i < 256; ++i)
                code[i] = one_in(random, 3) ? expected.words[pixel[i]] : any_word(random);
            Memory found = expected;
            CodeLanes wanted = any_mask(random);
            CodeLanes got = wanted;
            const int count = any_count(random);
            const PixelLanes at{pixel.data(), static_cast<std::size_t>(count)};
            const DepthResult a =
                scalar::test_depth(state, format, expected.at().first, at, code.data(), wanted.data());
            const DepthResult b = test_depth(state, format, found.at().first, at, code.data(), got.data());
            const bool same = a.arriving == b.arriving && a.passed == b.passed && expected.same_pixels(found) &&
                              same_lanes(wanted, got, count);
            tally.expect(same, [&] {
                return fmt::format("round {}: func {}, {} lanes", round, static_cast<int>(state.func), count);
            });
        }
        INFO("first wrong: " << tally.first());
        CHECK(tally.wrong() == 0);
    });
}

TEST_CASE("conversions give the same bits on every instruction set for all halves and special floats") {
    for_each_set([] {
        Random random{503};
        Tally tally;
        for (const ChannelType type : {ChannelType::unorm8, ChannelType::half, ChannelType::single})
            for (std::uint32_t first = 0; first < 65536; first += 256) {
                CodeLanes codes{}, wanted_codes{}, got_codes{};
                rasterizer::Lanes<float> wanted{}, got{};
                const int count = first == 0 ? 256 : any_count(random);
                for (std::uint32_t i = 0; i < 256; ++i)
                    codes[i] = type == ChannelType::unorm8 ? i
                               : type == ChannelType::half ? first + i
                                                           : any_word(random);
                scalar::decode(type, codes.data(), wanted.data(), static_cast<std::size_t>(count));
                decode(type, codes, got, count);
                bool same = same_lanes(wanted, got, count);
                for (const HalfRounding rounding :
                     {HalfRounding::nearest_even, HalfRounding::toward_zero, HalfRounding::no_infinity}) {
                    for (float& value : wanted) value = any_float(random);
                    for (std::size_t i = 0; i < hard_bits.size(); ++i) wanted[i] = float_of(hard_bits[i]);
                    scalar::encode(type, rounding, wanted.data(), wanted_codes.data(), static_cast<std::size_t>(count));
                    encode(type, rounding, wanted, got_codes, count);
                    same &= same_lanes(wanted_codes, got_codes, count);
                }
                tally.expect(same, [&] { return fmt::format("type {}, from {:04x}", static_cast<int>(type), first); });
            }
        INFO("first wrong: " << tally.first());
        CHECK(tally.wrong() == 0);
    });
}

TEST_CASE("blending gives the same codes on every instruction set in every format and state") {
    for_each_set([] {
        Random random{504};
        Tally tally;
        for (int round = 0; round < 3000; ++round) {
            Blend state = any_blend(random);
            constexpr std::array named{blend_mode::over, blend_mode::under, blend_mode::sum, blend_mode::max};
            if (one_in(random, 2)) state = named[below(random, named.size())];
            DeviceProfile profile;
            profile.blend_rounding = any_of(random, BlendRounding::unrounded_source);
            profile.unorm_rounding = any_of(random, UnormRounding::product_even_wide);
            profile.half_rounding = any_of(random, HalfRounding::no_infinity);
            profile.min_max_nan = any_of(random, MinMaxNan::destination);
            profile.denormals = any_of(random, DenormalRule::keep);
            const auto type = any_of(random, ChannelType::single);
            const int channels = one_in(random, 4) ? static_cast<int>(below(random, 4)) + 1 : 4;
            const std::uint32_t bits = type == ChannelType::unorm8 ? 0xffu : type == ChannelType::half ? 0xffffu : ~0u;
            static Values src;
            static scalar::ColorCodes wanted, got;
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t i = 0; i < 256; ++i)
                    src[c][i] = any_float(random), wanted[c][i] = any_word(random) & bits;
            got = wanted;
            const int count = any_count(random);
            scalar::blend(state, type, profile, channels, src, wanted, static_cast<std::size_t>(count));
            blend(state, type, profile, channels, src, got, count);
            bool same = true;
            for (std::size_t c = 0; c < 4; ++c) same &= same_lanes(wanted[c], got[c], count);
            tally.expect(same, [&] {
                return fmt::format("type {}, {} channels, {} lanes: {}", static_cast<int>(type), channels, count,
                                   words(state));
            });
        }
        INFO("first wrong: " << tally.first());
        CHECK(tally.wrong() == 0);
    });
}

TEST_CASE("every half blends to the same result on every instruction set") {
    for_each_set([] {
        int wrong = 0;
        for (const Blend& state : {blend_mode::sum, blend_mode::max, blend_mode::under})
            for (std::uint32_t first = 0; first < 65536; first += 1024) {
                static Values src;
                static scalar::ColorCodes wanted, got;
                for (std::size_t c = 0; c < 4; ++c)
                    for (std::size_t i = 0; i < 256; ++i) {
                        src[c][i] = float_of(hard_bits[(i + c) % hard_bits.size()]);
                        wanted[c][i] = first + static_cast<std::uint32_t>(256 * c + i);
                    }
                got = wanted;
                scalar::blend(state, ChannelType::half, {}, 4, src, wanted, 256);
                blend(state, ChannelType::half, {}, 4, src, got, 256);
                wrong += wanted == got ? 0 : 1;
            }
        CHECK(wrong == 0);
    });
}

TEST_CASE("every float is stored as the same half by the best instruction set", "[exhaustive]") {
    constexpr std::size_t blocks = std::size_t{1} << 22;
    std::atomic<std::uint64_t> wrong{0};
    parallel_for(blocks, 0, [&](std::size_t block) {
        Values src;
        scalar::ColorCodes codes;
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < 256; ++i)
                src[c][i] = float_of(static_cast<std::uint32_t>(block * 1024 + 256 * c + i));
        blend(blend_mode::replace, ChannelType::half, {}, 4, src, codes, 256);
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < 256; ++i)
                wrong += codes[c][i] != to_half<HalfRounding::nearest_even>(src[c][i]) ? 1 : 0;
    });
    CHECK(wrong == 0);
}

TEST_CASE("alpha and stencil tests give the same result on every instruction set") {
    for_each_set([] {
        Random random{505};
        Tally tally;
        for (int round = 0; round < 1000; ++round) {
            const AlphaTest alpha{true, any_of(random, CompareFunc::always), any_float(random)};
            StencilTest stencil{!one_in(random, 8), one_in(random, 2), {}, {}};
            for (StencilFace* face : {&stencil.front, &stencil.back})
                *face = {any_of(random, CompareFunc::always),
                         any_byte(random),
                         any_byte(random),
                         any_byte(random),
                         any_of(random, StencilOp::decr_wrap),
                         any_of(random, StencilOp::decr_wrap),
                         any_of(random, StencilOp::decr_wrap)};
            rasterizer::Lanes<float> values{};
            rasterizer::Lanes<std::uint8_t> front{};
            CodeLanes stored{}, saturated{}, got_saturated{};
            for (std::size_t i = 0; i < 256; ++i)
                values[i] = any_float(random), front[i] = one_in(random, 2) ? 1 : 0, stored[i] = any_byte(random);
            const CodeLanes depth_pass = any_mask(random);
            CodeLanes wanted = any_mask(random), got_stored = stored;
            CodeLanes got = wanted;
            const bool eight_bit = one_in(random, 2);
            const int count = any_count(random);
            scalar::alpha_test(alpha, eight_bit, values.data(), wanted.data(), count);
            alpha_test(alpha, eight_bit, values.data(), got.data(), count);
            const int failed = scalar::stencil_test(
                stencil, {front.data(), depth_pass.data(), wanted.data(), stored.data(), saturated.data(), count});
            const int got_failed = stencil_test(
                stencil, {front.data(), depth_pass.data(), got.data(), got_stored.data(), got_saturated.data(), count});
            const bool same = failed == got_failed && same_lanes(wanted, got, count) &&
                              same_lanes(stored, got_stored, count) && same_lanes(saturated, got_saturated, count);
            tally.expect(same, [&] { return fmt::format("round {}, {} lanes", round, count); });
        }
        INFO("first wrong: " << tally.first());
        CHECK(tally.wrong() == 0);
    });
}
