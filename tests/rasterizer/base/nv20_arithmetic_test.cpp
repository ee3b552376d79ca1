// Tests NV20's arithmetic against rationals (rational.h) truncated by the rules of rasterizer/reference/numbers.md 4,
// and against big integers for the Newton steps.
#include "rasterizer/base/nv20_arithmetic.h"

#include <catch2/catch.hpp>

#include "rasterizer/set_up/window.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr float largest_float = 0x1.fffffep127f;

// v truncated to 24 bits toward zero; below the normal range +0, above it the largest value.
[[nodiscard]] float model_cut(const Rational& v) {
    if (v == 0 || abs(v) < power(-126)) return 0.0f;
    const float f = abs(v) >= power(128) ? largest_float : nearest_float(abs(truncate_to_bits(v, 24)));
    return v < 0 ? -f : f;
}

[[nodiscard]] Rational model_value(float v) { return abs(Rational{v}) < power(-126) ? Rational{0} : Rational{v}; }

template <std::size_t n>
[[nodiscard]] float model_sum(const std::array<float, n>& addends) {
    int top = -1000;
    for (const float v : addends)
        if (model_value(v) != 0) top = std::max(top, floor_log2(abs(Rational{v})));
    Rational sum{0};
    for (const float v : addends)
        if (model_value(v) != 0) sum += truncate(Rational{v}, top + 2 - 23 - 7);
    return model_cut(sum);
}

// Any finite binary32 with an exponent within `spread` of 0, or of any exponent.
[[nodiscard]] float random_finite(Random& random, int spread) {
    const auto fraction = static_cast<std::uint32_t>(random()) & 0x807fffffu;
    const int exponent = spread == 0 ? random_int(random, 0, 254) : random_int(random, 127 - spread, 127 + spread);
    return std::bit_cast<float>(fraction | static_cast<std::uint32_t>(exponent) << 23);
}

[[nodiscard]] bool same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

}  // namespace

TEST_CASE("NV20's finite numbers are all except infinities and NaN of any payload") {
    for (const std::uint32_t sign : {0u, 0x80000000u}) {
        for (const std::uint32_t bits : {0u, 1u, 0x007fffffu, 0x00800000u, 0x3f800001u, 0x7f7fffffu})
            CHECK(nv20::is_finite(std::bit_cast<float>(sign | bits)));
        for (const std::uint32_t bits : {0x7f800000u, 0x7f800001u, 0x7fc00000u, 0x7fffffffu})
            CHECK_FALSE(nv20::is_finite(std::bit_cast<float>(sign | bits)));
    }
}

TEST_CASE("NV20 truncates products and flushes denormals and 0 times anything is +0") {
    Random random{920};
    std::uint64_t wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        const float a = random_finite(random, i % 2 == 0 ? 0 : 60), b = random_finite(random, i % 2 == 0 ? 0 : 60);
        wrong += same(nv20::multiply(a, b), model_cut(model_value(a) * model_value(b))) ? 0 : 1;
    }
    CHECK(wrong == 0);
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(same(nv20::multiply(0.0f, infinity), 0.0f));
    CHECK(same(nv20::multiply(-0.0f, std::numeric_limits<float>::quiet_NaN()), 0.0f));
    CHECK(same(nv20::multiply(-2.0f, infinity), -infinity));
    // The NaN of a product has sign +, whatever the operands' signs.
    for (const float other : {1.0f, -1.0f, infinity, -infinity, std::bit_cast<float>(0xffc00000u)})
        for (const std::uint32_t nan : {0x7fc00000u, 0xffc00000u, 0x7f800001u, 0xff800001u}) {
            CHECK(same(nv20::multiply(std::bit_cast<float>(nan), other), std::bit_cast<float>(0x7fc00000u)));
            CHECK(same(nv20::multiply(other, std::bit_cast<float>(nan)), std::bit_cast<float>(0x7fc00000u)));
        }
}

TEST_CASE("NV20 aligns every addend to the largest exponent plus two with seven low bits and adds once and truncates",
          "[slow]") {
    Random random{921};
    std::uint64_t wrong = 0, unlike_binary32 = 0;
    for (int i = 0; i < 4000; ++i) {
        const int spread = i % 4 == 0 ? 0 : 1 << (i % 4);
        const std::array v{random_finite(random, spread), random_finite(random, spread), random_finite(random, spread),
                           random_finite(random, spread)};
        const float sum = nv20::sum(v);
        wrong += same(sum, model_sum(v)) ? 0 : 1;
        unlike_binary32 += same(sum, ((v[0] + v[1]) + v[2]) + v[3]) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(unlike_binary32 > 1000);
    CHECK(same(nv20::sum(std::array{1.0f, 0x1p-28f}), 1.0f));
    CHECK(same(nv20::sum(std::array{1.0f, -0x1p-28f}), 0x1.fffffep-1f));  // truncated after the one addition
    CHECK(same(nv20::sum(std::array{1.0f, -0x1p-29f}), 1.0f));            // lost before the addition
    CHECK(same(nv20::sum(std::array{2.0f, -2.0f}), 0.0f));
    CHECK(std::isnan(
        nv20::sum(std::array{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()})));
}

TEST_CASE("NV20's reciprocal is a seed of its 6 leading bits and two Newton steps on integers") {
    Random random{922};
    std::uint64_t wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        const float d = random_finite(random, 100);
        const int e = floor_log2(abs(Rational{d}));
        const Integer m = floor(abs(Rational{d}) * power(23 - e));
        Integer code = Integer{1} << 23;
        int unit = -e - 23;
        if (m != code) {
            const Integer index = (m - (Integer{1} << 23)) >> 17;
            const Integer seed = floor(Rational{8192} / (Rational{index} + Rational{129, 2}) + Rational{1, 2});
            const Integer first = (((Integer{1} << 31) - seed * m) * seed) >> 24;
            code = (((Integer{1} << 37) - first * m) * first) >> 25;
            unit = -e - 24;
        }
        const Rational size = Rational{code} * power(unit);
        wrong += same(nv20::reciprocal(d), model_cut(d < 0 ? Rational{-size} : size)) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(same(nv20::reciprocal(0.0f), std::numeric_limits<float>::infinity()));
    CHECK(same(nv20::reciprocal(std::numeric_limits<float>::infinity()), 0.0f));
    CHECK(same(nv20::reciprocal(0x1p126f), 0x1p-126f));
    for (const float large : {0x1.000002p126f, 0x1p127f, -0x1.8p127f, std::numeric_limits<float>::max()})
        CHECK(same(nv20::reciprocal(large), 0.0f));  // the exact result is denormal
}

TEST_CASE("NV20's reciprocal is within 2^-22 of 1/d as its extension requires for every fifth mantissa") {
    double worst = 0;
    for (std::uint32_t fraction = 0; fraction < 0x800000u; fraction += 5) {
        const float d = std::bit_cast<float>(0x3f800000u | fraction);
        const double error = double{nv20::reciprocal(d)} * double{d} - 1.0;  // binary64 is precise enough for the bound
        worst = std::max(worst, error < 0 ? -error : error);
    }
    CHECK(worst < 0x1p-22);
    CHECK(worst > 0x1p-24);
}

TEST_CASE("NV20 multiplies by its reciprocal of w and adds the viewport's offset with each result truncated",
          "[slow]") {
    Random random{923};
    RasterState state;
    state.viewport = {0, 0, 640, 480};
    state.depth_format = DepthFormat::d24;
    const WindowTransform window{state, {.w_divide = WDivide::nv20, .window_z = WindowZ::buffer_units}};
    std::uint64_t wrong = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto part = [&] { return random_float(random, -2, 2); };
        const ClipVertex v{.x = part(), .y = part(), .z = part(), .w = random_float(random, 0.5f, 9)};
        const WindowVertex found = window.project(v);
        const float inverse_w = nv20::reciprocal(v.w);
        const auto mapped = [&](float scale, float c, float offset) {
            const float divided = model_cut(model_value(c) * model_value(inverse_w));
            return model_sum(std::array{model_cut(Rational{scale} * Rational{divided}), offset});
        };
        wrong += same(found.inverse_w, inverse_w) && same(found.x, mapped(320, v.x, 320)) &&
                         same(found.y, mapped(-240, v.y, 240)) && same(found.z, mapped(8388607.5f, v.z, 8388607.5f))
                     ? 0
                     : 1;
    }
    CHECK(wrong == 0);
}
