// Tests the hypotheses for operations: sRGB against the formula with libm's pow and against Mesa's least-squares fit,
// computed here; comparisons, codes and roundings against rationals of Boost.Multiprecision.
#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tools/probe/operations.h"

using namespace strata::probe;

namespace {

using Rational = boost::multiprecision::cpp_rational;

float float_of_word(std::uint32_t word) { return std::bit_cast<float>(word); }
Rational value_of(std::uint32_t word) { return Rational{float_of_word(word)}; }

struct Rule {
    Rule(const std::string& operation, const std::string& hypothesis) {
        for (const Operation& o : operations())
            if (o.name == operation) inputs = o.inputs;
        for (const Operation& o : operations())
            for (const Hypothesis& h : o.hypotheses)
                if (o.name == operation && h.name == hypothesis) answer = h.answer;
        REQUIRE(answer);
    }
    // The number of texels for which `is_right(inputs, result)` is false.
    template <class Test>
    [[nodiscard]] int wrong(Test is_right) const {
        return static_cast<int>(
            std::ranges::count_if(inputs, [&](const Texel& t) { return !is_right(t, answer(t)[0]); }));
    }
    std::vector<Texel> inputs{};
    std::function<Texel(const Texel&)> answer{};
};

double encoded(double linear) {
    return linear >= 0.0031308 ? 1.055 * std::pow(linear, 1 / 2.4) - 0.055 : 12.92 * linear;
}
double decoded(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }

// Least-squares line for code + 1/2 over the 2^20 binary32 values of an eighth of an octave, as a function of the index
// of their 256 parts.
std::uint32_t fitted_piece(std::uint32_t first) {
    double sum_1 = 0, sum_j = 0, sum_jj = 0, sum_v = 0, sum_jv = 0;
    for (std::uint32_t i = 0; i < 1u << 20; i += 32) {
        const double j = i >> 12, x = double{float_of_word(first + i)};
        const double value = 255.0 * (x >= 0.0031308 ? 1.055 * std::pow(x, 0.41666666) - 0.055 : 12.92 * x) + 0.5;
        sum_1 += 1;
        sum_j += j;
        sum_jj += j * j;
        sum_v += value;
        sum_jv += j * value;
    }
    const double scale = 1.0 / (sum_1 * sum_jj - sum_j * sum_j);
    const double start = scale * (sum_jj * sum_v - sum_j * sum_jv), slope = scale * (sum_1 * sum_jv - sum_j * sum_v);
    return static_cast<std::uint32_t>(start * 128 + 0.5) << 16 | static_cast<std::uint32_t>(slope * 65536 + 0.5);
}

// The code differs from 255 times the formula's value, clamped to [0, 1], by at most 1/2 + `most`.
bool is_near(const Texel& t, std::uint32_t code, double most) {
    return std::abs(code - 255.0 * std::clamp(encoded(double{float_of_word(t[0])}), 0.0, 1.0)) <= 0.5 + most;
}

}  // namespace

TEST_CASE("the 104 line segments that encode sRGB are least-squares fits of the formula in all of their 256 parts") {
    constexpr std::uint32_t least = 0x39000000u;  // 2^-13
    const Rule rule("target.srgb-encode", "8 lines an octave");
    int wrong = 0;
    for (std::uint32_t k = 0; k < 104; ++k) {
        const std::uint32_t piece = fitted_piece(least + (k << 20));
        for (std::uint32_t j = 0; j < 256; ++j) {
            const std::uint32_t code = ((piece >> 16) * 512 + (piece & 0xffff) * j) / 65536;
            wrong += rule.answer({least + (k << 20) + (j << 12), 0, 0, 0})[0] != code ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    CHECK(rule.answer({0, 0, 0, 0})[0] == 0);
    CHECK(rule.answer({0x40000000u, 0, 0, 0})[0] == 255);
}

TEST_CASE("square and eighth roots encode sRGB within 0.17 codes of the formula and SwiftShader's power within 0.03") {
    CHECK(Rule("target.srgb-encode", "square and eighth roots").wrong([](const Texel& t, std::uint32_t code) {
        return is_near(t, code, 0.17);
    }) == 0);
    for (const char* const steps : {"each step rounded", "fused"}) {
        INFO(steps);
        CHECK(Rule("target.srgb-encode", std::string{"a power by quotients, "} + steps)
                  .wrong([](const Texel& t, std::uint32_t code) { return is_near(t, code, 0.03); }) == 0);
    }
}

TEST_CASE(
    "a decoded sRGB code is the formula's value to 8 decimal digits or in steps of 1/65280 or within half a code") {
    const std::string operation = "texture.srgb-decode";
    CHECK(Rule(operation, "the formula in 8 decimal digits").wrong([](const Texel& t, std::uint32_t word) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.7e", decoded(t[0] / 255.0));
        return float_of_word(word) == std::strtof(digits, nullptr);
    }) == 0);
    CHECK(Rule(operation, "the formula, rounded once").wrong([](const Texel& t, std::uint32_t word) {
        return float_of_word(word) == static_cast<float>(decoded(t[0] / 255.0));
    }) == 0);
    CHECK(Rule(operation, "the formula in steps of 1 / 65,280").wrong([](const Texel& t, std::uint32_t word) {
        const double steps = double{float_of_word(word)} * 65280.0;
        return std::abs(steps - std::round(steps)) < 0.01 && std::abs(steps - decoded(t[0] / 255.0) * 65280.0) < 0.51;
    }) == 0);
    for (const char* const cubic : {"a cubic, each step rounded", "a cubic, fused"})
        CHECK(Rule(operation, cubic).wrong([](const Texel& t, std::uint32_t word) {
            const double code = 255.0 * encoded(double{float_of_word(word)});
            return std::abs(code - t[0]) < 0.5;
        }) == 0);
}

TEST_CASE("a discard keeps values not below the threshold as exact numbers or as codes or without denormals") {
    const auto is_nan = [](const Texel& t) {
        return std::isnan(float_of_word(t[0])) || std::isnan(float_of_word(t[1]));
    };
    const auto is_infinite = [](const Texel& t) {
        return std::isinf(float_of_word(t[0])) || std::isinf(float_of_word(t[1]));
    };
    const auto code = [](const Rational& value) {
        const Rational clamped = value < 0 ? Rational{0} : value > 1 ? Rational{1} : value;
        const Rational shifted = clamped * 255 + Rational{1, 2};
        return Rational{numerator(shifted) / denominator(shifted)};
    };
    const auto flushed = [](const Rational& value) { return abs(value) < Rational{0x1p-126f} ? Rational{0} : value; };
    const auto check = [&](const std::string& hypothesis, bool keeps_nan, auto rounded) {
        INFO(hypothesis);
        CHECK(Rule("test.discard", hypothesis).wrong([&](const Texel& t, std::uint32_t kept) {
            if (is_infinite(t)) return true;
            if (is_nan(t) && hypothesis == "codes of 8 bits") return kept == (code(value_of(t[1])) == 0 ? 1u : 0u);
            if (is_nan(t)) return kept == (keeps_nan ? 1u : 0u);
            return kept == (rounded(value_of(t[0])) < rounded(value_of(t[1])) ? 0u : 1u);
        }) == 0);
    };
    const auto as_it_is = [](const Rational& value) { return value; };
    check("binary32", true, as_it_is);
    check("binary32, NaN is discarded", false, as_it_is);
    check("binary32, denormals are 0", true, flushed);
    check("binary32, denormals are 0, NaN is discarded", false, flushed);
    check("codes of 8 bits", true, code);
}

TEST_CASE(
    "a constant attribute is within two representable numbers after interpolation and exact if w is a power of two") {
    for (const char* const way : {"as it is", "a (1 / w), times the reciprocal of 1 / w", "a (1 / w) / (1 / w)",
                                  "(a / w) w", "(a / w) / (1 / w)"}) {
        INFO(way);
        const Rule rule("test.discard-attribute", way);
        CHECK(rule.wrong([](const Texel& t, std::uint32_t kept) {
            // distance from the threshold in representable numbers
            const auto below = static_cast<std::int64_t>(t[1]) - std::int64_t{t[0]};
            const bool is_power = (t[2] & 0x7fffffu) == 0;
            if (is_power || below > 1 || below < -1) return kept == (below > 0 ? 0u : 1u);
            return true;
        }) == 0);
    }
}

TEST_CASE("planes of a / w and 1 / w are those of three arbitrary corners with the third one first") {
    // Corners and the centre of a pixel relative to the third corner, in pixels; every step is rounded to binary32.
    const auto at_center = [](float a, float w) {
        const float x1 = -0.25f * w, y1 = -0.5f * w, x2 = 0.25f * w, y2 = -0.5f * w, inverse = 1.0f / w;
        const float part = 1.0f / (x1 * y2 - x2 * y1), own = part * inverse;
        const std::array<float, 3> x{(y1 * w - y2 * w) * own, y2 * part, -y1 * part};
        const std::array<float, 3> y{(x2 * w - x1 * w) * own, -x2 * part, x1 * part};
        const auto plane = [&](float v) {
            const float slope_x = v * x[0] + v * x[1] + v * x[2], slope_y = v * y[0] + v * y[1] + v * y[2];
            return v * inverse + -0.25f * slope_y + 0.0f * slope_x;
        };
        return plane(a) * (1.0f / plane(1.0f));
    };
    int apart = 0;
    CHECK(Rule("test.discard-attribute", "planes of a / w and 1 / w, times a reciprocal")
              .wrong([&](const Texel& t, std::uint32_t kept) {
                  const float arrived = at_center(float_of_word(t[0]), float_of_word(t[2]));
                  apart += arrived != float_of_word(t[0]) ? 1 : 0;
                  return kept == (arrived < float_of_word(t[1]) ? 0u : 1u);
              }) == 0);
    CHECK(apart > 100);
}

TEST_CASE("integers that are converted to float in halves are rounded twice and those below 2^31 once") {
    const auto nearest = [](const Rational& value) {  // of integers below 2^53
        return Rational{static_cast<float>(static_cast<double>(value))};
    };
    CHECK(Rule("shader.from-uint", "31 bits, then 2^31 added").wrong([&](const Texel& t, std::uint32_t word) {
        const Rational low = nearest(Rational{t[0] % 0x80000000u});
        return value_of(word) == (t[0] < 0x80000000u ? low : nearest(low + Rational{0x80000000u}));
    }) == 0);
}

TEST_CASE("halves by shifts are the nearest ones from 2^-14 to below 65520 and above there is no infinity") {
    const Rule shifts("shader.pack-half", "nearest even by shifts, infinity is not made"),
        plain("shader.pack-half", "nearest even");
    int within = 0, above = 0;
    for (const Texel& t : shifts.inputs) {
        const std::uint32_t found = shifts.answer(t)[0], expected = plain.answer(t)[0];
        for (std::size_t k = 0; k < 2; ++k) {
            const float size = std::fabs(float_of_word(t[k]));
            const std::uint32_t half = found >> (16 * k) & 0xffff;
            if (size >= 0x1p-14f && size < 65520.0f) {
                ++within;
                CHECK(half == (expected >> (16 * k) & 0xffff));
            } else if (size >= 131008.0f) {
                ++above;
                CHECK((half & 0x7fff) == 0x7fff);
            }
        }
    }
    CHECK(within > 500);
    CHECK(above > 10);
}

TEST_CASE("a packed code is at most half a code from the exact product") {
    for (const bool is_signed : {false, true}) {
        const Rational greatest{is_signed ? 32767 : 65535}, least{is_signed ? -1 : 0};
        const Rule rule(is_signed ? "shader.pack-snorm" : "shader.pack-unorm", "nearest of the exact product");
        CHECK(rule.wrong([&](const Texel& t, std::uint32_t word) {
            for (std::size_t k = 0; k < 2; ++k) {
                const auto half = static_cast<std::uint16_t>(word >> (16 * k));
                const Rational code{is_signed ? int{static_cast<std::int16_t>(half)} : int{half}};
                const Rational value = std::clamp(value_of(t[k]), least, Rational{1});
                if (abs(Rational{value * greatest - code}) > Rational{1, 2}) return false;
            }
            return true;
        }) == 0);
    }
}
