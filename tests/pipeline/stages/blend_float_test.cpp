// Tests blending on float targets against a model of one fragment in binary64, rounded to binary32 after each
// operation.
#include "pipeline/stages/blend_float.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/pipeline/blend_model.h"

using namespace strata::pipeline;

namespace {

// Binary32 arithmetic computed in binary64: a product of two binary32 is exact, and rounding a binary64 sum to binary32
// gives the correctly rounded sum (53 >= 2 * 24 + 2).
struct FloatModel {
    DenormalRule denormals;
    MinMaxNan nan_rule;

    [[nodiscard]] float flush(float x) const {
        const bool is_small = denormals == DenormalRule::flush && !(std::fabs(x) >= 0x1p-126f) && !std::isnan(x);
        return is_small ? std::copysign(0.0f, x) : x;
    }
    [[nodiscard]] float product(float a, float b) const { return flush(static_cast<float>(double{a} * double{b})); }
    [[nodiscard]] float sum(float a, float b) const { return flush(static_cast<float>(double{a} + double{b})); }
    [[nodiscard]] float extreme(float a, float b, bool wants_larger) const {
        const float nan = float_of(0x7fffffff);
        if (nan_rule == MinMaxNan::destination) {
            const float chosen = (wants_larger ? a > b : a < b) ? a : b;
            return std::isnan(chosen) ? nan : chosen;
        }
        if (std::isnan(a) || std::isnan(b)) {
            if (nan_rule == MinMaxNan::propagate || (std::isnan(a) && std::isnan(b))) return nan;
            return std::isnan(a) ? b : a;
        }
        if (a == b) return std::signbit(a) == wants_larger ? b : a;  // of two zeros, max takes +0 and min takes -0
        return (a > b) == wants_larger ? a : b;
    }
    [[nodiscard]] float blend(const BlendTerm& term, const Fragment<float>& f, std::size_t c) const {
        const auto complement = [&](float x) { return sum(1.0f, -x); };
        const auto lesser = [&](float a, float b) { return extreme(a, b, false); };
        if (term.equation == BlendEquation::min) return extreme(f.source[c], f.stored[c], false);
        if (term.equation == BlendEquation::max) return extreme(f.source[c], f.stored[c], true);
        const float source = product(f.source[c], model_factor(term.src, f, c, 1.0f, complement, lesser));
        const float stored = product(f.stored[c], model_factor(term.dst, f, c, 1.0f, complement, lesser));
        const bool subtracts = term.equation == BlendEquation::subtract,
                   reverses = term.equation == BlendEquation::reverse_subtract;
        const float result = sum(reverses ? -source : source, subtracts ? -stored : stored);
        return std::isnan(result) ? float_of(0x7fffffff) : result;
    }
};

[[nodiscard]] float value_of_half(std::uint32_t half, HalfRounding rounding) {
    const auto m = static_cast<int>(half & 0x3ff), e = static_cast<int>(half >> 10 & 0x1f);
    if (e == 31 && rounding != HalfRounding::no_infinity)
        return float_of((half & 0x8000) << 16 | 0x7f800000u | (half & 0x3ff) << 13);
    const double magnitude = e == 0 ? std::ldexp(m, -24) : std::ldexp(1024 + m, e - 25);
    return static_cast<float>((half & 0x8000) != 0 ? -magnitude : magnitude);
}

[[nodiscard]] bool is_stored(ChannelType type, HalfRounding rounding, float value, std::uint32_t code) {
    if (type == ChannelType::single) return bits_of(value) == code;
    if (rounding == HalfRounding::no_infinity) return model::is_half_without_infinity(bits_of(value), code);
    return rounding == HalfRounding::nearest_even ? model::is_nearest_half(bits_of(value), code)
                                                  : model::is_half_toward_zero(bits_of(value), code);
}

// One channel value blended on a one-channel binary32 target.
float blended(const Blend& state, float source, float stored, const DeviceProfile& profile = {}) {
    static Colors src;
    static Codes codes;
    for (auto& channel : src) channel[0] = source;
    codes[0][0] = bits_of(stored);
    blend(state, ChannelType::single, profile, 1, src, codes, 1);
    return float_of(codes[0][0]);
}

Blend both(const BlendTerm& term) { return {true, term, term, {}, 0xf}; }

constexpr BlendTerm max_term{BlendEquation::max, BlendFactor::one, BlendFactor::one};
constexpr BlendTerm min_term{BlendEquation::min, BlendFactor::one, BlendFactor::one};

}  // namespace

TEST_CASE("float targets follow binary32 operation by operation for random states and special values", "[slow]") {
    Random random{1622};
    Tally tally;
    for (int round = 0; round < 10000; ++round) {
        const Blend state = any_blend(random);
        DeviceProfile profile;
        profile.denormals = any_of(random, DenormalRule::keep);
        profile.min_max_nan = any_of(random, MinMaxNan::destination);
        profile.half_rounding = any_of(random, HalfRounding::no_infinity);
        const ChannelType type = one_in(random, 2) ? ChannelType::half : ChannelType::single;
        const int channels = std::array{1, 2, 4}[below(random, 3)];
        const int count = one_in(random, 16) ? 256 : static_cast<int>(below(random, 20));
        Colors src;
        Codes codes, before;
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < 256; ++i) {
                src[c][i] = any_float(random);
                codes[c][i] = type == ChannelType::half ? below(random, 0x10000) : bits_of(any_float(random));
            }
        before = codes;
        blend(state, type, profile, channels, src, codes, count);
        const FloatModel machine{profile.denormals, profile.min_max_nan};
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            Fragment<float> f{};
            for (std::size_t c = 0; c < 4; ++c) {
                f.source[c] = machine.flush(src[c][i]);
                f.stored[c] =
                    machine.flush(type == ChannelType::half ? value_of_half(before[c][i], profile.half_rounding)
                                                            : float_of(before[c][i]));
                f.constant[c] = machine.flush(state.constant[c]);
            }
            if (channels < 4) f.stored[3] = 1.0f;
            for (std::size_t c = 0; c < 4; ++c) {
                const bool is_written = c < static_cast<std::size_t>(channels) && (state.write_mask >> c & 1) != 0;
                const float value = state.enabled ? machine.blend(c == 3 ? state.alpha : state.color, f, c) : src[c][i];
                const bool holds = is_written ? is_stored(type, profile.half_rounding, value, codes[c][i])
                                              : codes[c][i] == before[c][i];
                tally.expect(holds, [&] {
                    return fmt::format("{} channel {}: s {:08x} d {:08x} -> {:08x}, not {:08x}", words(state), c,
                                       bits_of(src[c][i]), before[c][i], codes[c][i], bits_of(value));
                });
            }
        }
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() >= 100000);
}

TEST_CASE("a stored NaN makes the result NaN even with weight 0 and it becomes 7fffffff") {
    const Blend forgets_stored = both({BlendEquation::add, BlendFactor::one, BlendFactor::zero});
    CHECK(bits_of(blended(forgets_stored, 1.0f, float_of(0xffc00001))) == 0x7fffffff);
    CHECK(bits_of(blended(forgets_stored, 1.0f, float_of(0x7f800000))) == 0x7fffffff);  // infinity times 0
    CHECK(bits_of(blended(blend_mode::replace, float_of(0xffc00001), 1.0f)) ==
          0xffc00001);  // without blending the bits are stored unchanged
}

TEST_CASE("a negative zero results only if both terms of the sum are negative") {
    const Blend adds = both({BlendEquation::add, BlendFactor::one, BlendFactor::one});
    CHECK(bits_of(blended(adds, -0.0f, -0.0f)) == 0x80000000);
    CHECK(bits_of(blended(adds, -0.0f, 0.0f)) == 0x00000000);
    CHECK(bits_of(blended(both({BlendEquation::add, BlendFactor::zero, BlendFactor::one}), -1.0f, -0.0f)) ==
          0x80000000);
}

TEST_CASE("MAX and MIN ignore a single NaN and return NaN for two and respect the sign of zero") {
    const float nan = float_of(0xffc12345);
    CHECK(blended(both(max_term), nan, -3.0f) == -3.0f);
    CHECK(blended(both(max_term), -3.0f, nan) == -3.0f);
    CHECK(bits_of(blended(both(min_term), nan, nan)) == 0x7fffffff);
    CHECK(bits_of(blended(both(max_term), -0.0f, 0.0f)) == 0x00000000);
    CHECK(bits_of(blended(both(max_term), 0.0f, -0.0f)) == 0x00000000);
    CHECK(bits_of(blended(both(min_term), 0.0f, -0.0f)) == 0x80000000);
    DeviceProfile propagating;
    propagating.min_max_nan = MinMaxNan::propagate;
    CHECK(bits_of(blended(both(max_term), nan, -3.0f, propagating)) == 0x7fffffff);
}

TEST_CASE("a device that flushes denormals stores a signed zero when it blends and their bits when it does not") {
    const float denormal = float_of(0x80000123);
    CHECK(bits_of(blended(both(max_term), denormal, -1.0f)) == 0x80000000);
    CHECK(bits_of(blended(blend_mode::replace, denormal, -1.0f)) == 0x80000123);
    DeviceProfile keeping;
    keeping.denormals = DenormalRule::keep;
    CHECK(bits_of(blended(both(max_term), denormal, -1.0f, keeping)) == 0x80000123);
}
