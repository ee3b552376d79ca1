// tools/probe/operations_arithmetic.cpp - sums, products, quotients and roots of binary32 in a shader.
#include <cmath>

#include "rasterizer/base/fused.h"
#include "tools/probe/operation_numbers.h"

namespace strata::probe {

namespace {

constexpr int drawn = 1024;

// Sign and 23 bits at random, an exponent from 2^low to 2^high.
float random_number(Dice& dice, int low, int high) {
    const std::uint32_t bits = dice.next();
    const auto exponent = static_cast<std::uint32_t>(127 + low + dice.below(high - low + 1));
    return as_float((bits & 0x807fffffu) | exponent << 23);
}
std::vector<Words> random_inputs(std::uint64_t seed, int low, int high, bool positive = false) {
    std::vector<Words> inputs;
    Dice dice{seed};
    for (int i = 0; i < drawn; ++i) {
        Words words{};
        for (std::uint32_t& word : words)
            word = as_word(random_number(dice, low, high)) & (positive ? 0x7fffffffu : ~0u);
        inputs.push_back(words);
    }
    return inputs;
}
// Every pair of these, and what the third and fourth word hold.
constexpr std::array<std::uint32_t, 14> special{0x00000000, 0x80000000, 0x00000001, 0x80000001, 0x007fffff,
                                                0x00800000, 0x80800000, 0x3f800000, 0xbf800000, 0x7f7fffff,
                                                0x7f800000, 0xff800000, 0x7fc00000, 0xffc00001};
std::vector<Words> special_pairs() {
    std::vector<Words> inputs;
    for (const std::uint32_t a : special)
        for (const std::uint32_t b : special) inputs.push_back({a, b, 0, 0});
    return inputs;
}
// Products that fall below 2^-126, and what they are made of.
std::vector<Words> small_factors(std::uint64_t seed) {
    std::vector<Words> inputs;
    Dice dice{seed};
    for (int i = 0; i < drawn; ++i) {
        const bool is_given = i % 2 == 0;  // one of the two is denormal; or only the result
        const float a = is_given ? as_float(dice.next() & 0x807fffffu) : random_number(dice, -70, -60);
        const float b = is_given ? random_number(dice, -2, 20) : random_number(dice, -70, -60);
        inputs.push_back({as_word(a), as_word(b), 0, 0});
    }
    return inputs;
}

// Sums that do: of two denormals, of one and a small number, of two small numbers whose difference is denormal.
std::vector<Words> small_addends(std::uint64_t seed) {
    std::vector<Words> inputs;
    Dice dice{seed};
    for (int i = 0; i < drawn; ++i) {
        const auto denormal = [&] { return as_float(dice.next() & 0x807fffffu); };
        const float small = random_number(dice, -126, -124);
        const float a = i % 3 == 0 ? denormal() : small;
        float b = i % 3 < 2 ? denormal() : 0.0f;
        if (i % 3 == 2) b = as_float((as_word(small) ^ 0x80000000u) + static_cast<std::uint32_t>(dice.below(4096)));
        inputs.push_back({as_word(a), as_word(b), 0, 0});
    }
    return inputs;
}

// What `result` gives where denormals are kept, where those that come out become zero, those that go in, and both.
template <class Result>
std::vector<Hypothesis> with_denormals(Result&& result) {
    const auto pair = [result](bool in, bool out) {
        return [result, in, out](const Words& words) {
            const float a = as_float(words[0]), b = as_float(words[1]);
            const float r = in ? result(flushed(a), flushed(b)) : result(a, b);
            return out ? flushed(r) : r;
        };
    };
    return {float_rule("denormals kept", pair(false, false)), float_rule("denormal results are 0", pair(false, true)),
            float_rule("denormal operands are 0", pair(true, false)),
            float_rule("denormal operands and results are 0", pair(true, true))};
}

Operation binary(const char* name, const char* asks, const char* expression, std::vector<Words> inputs,
                 std::vector<Hypothesis> hypotheses, bool in_units = true) {
    return {.name = name,
            .asks = asks,
            .body = std::string{"highp uvec4 operation(highp uvec4 a) {\n"
                                "    highp vec4 v = uintBitsToFloat(a);\n"
                                "    return uvec4(floatBitsToUint("} +
                    expression + "), 0u, 0u, 0u);\n}\n",
            .inputs = std::move(inputs),
            .in_units = in_units,
            .hypotheses = std::move(hypotheses)};
}

float lesser(float x, float y) { return x < y ? x : y; }
float number_beside(float x, float y) {
    if (std::isnan(x)) return y;
    return std::isnan(y) ? x : lesser(x, y);
}

std::vector<Hypothesis> of_minimum() {
    using Rule = float (*)(float, float);
    constexpr std::array<std::pair<const char*, Rule>, 5> rules{
        {{"y < x ? y : x", [](float x, float y) { return lesser(y, x); }},
         {"x < y ? x : y", lesser},
         {"the number beside a NaN, else x < y ? x : y", number_beside},
         {"the number beside a NaN, else y < x ? y : x", [](float x, float y) { return number_beside(y, x); }},
         {"the number beside a NaN, and -0 below +0", [](float x, float y) {
              if (x == 0.0f && y == 0.0f) return std::signbit(x) ? x : y;
              return number_beside(x, y);
          }}}};
    std::vector<Hypothesis> all;
    for (const bool flushes : {false, true})
        for (const auto& [name, rule] : rules)
            all.push_back(float_rule((std::string{name} + (flushes ? "; denormals are 0" : "")).c_str(),
                                     [rule = rule, flushes](const Words& w) {
                                         const float x = as_float(w[0]), y = as_float(w[1]);
                                         return flushes ? rule(flushed(x), flushed(y)) : rule(x, y);
                                     }));
    return all;
}

float sum_of(const Words& w) { return as_float(w[0]) * as_float(w[1]) + as_float(w[2]); }
float fused_of(const Words& w) {
    return rasterizer::fused_multiply_add(as_float(w[0]), as_float(w[1]), as_float(w[2]));
}
// Binary64 holds more than twice the bits, so that a second rounding changes neither quotient nor root.
float reciprocal_root(float v) { return static_cast<float>(1.0 / std::sqrt(double{v})); }

}  // namespace

void add_arithmetic(std::vector<Operation>& all) {
    all.push_back(binary("multiply-add", "whether a product and a sum are contracted", "v.x * v.y + v.z",
                         random_inputs(11, -6, 6),
                         {float_rule("rounded twice", sum_of), float_rule("fused, rounded once", fused_of)}));
    all.push_back(binary("multiply-small", "denormal operands and results of a product", "v.x * v.y", small_factors(12),
                         with_denormals([](float a, float b) { return a * b; }), false));
    all.push_back(binary("add-small", "denormal operands and results of a sum", "v.x + v.y", small_addends(13),
                         with_denormals([](float a, float b) { return a + b; }), false));
    all.push_back(binary("divide", "the rounding of a quotient", "v.x / v.y", random_inputs(14, -20, 20),
                         {float_rule("rounded once", [](const Words& w) { return as_float(w[0]) / as_float(w[1]); }),
                          float_rule("times the rounded reciprocal",
                                     [](const Words& w) { return as_float(w[0]) * (1.0f / as_float(w[1])); })}));
    all.push_back(binary("reciprocal", "the rounding of 1 / x", "1.0 / v.x", random_inputs(15, -20, 20),
                         {float_rule("rounded once", [](const Words& w) { return 1.0f / as_float(w[0]); })}));
    all.push_back(binary("square-root", "the rounding of a square root", "sqrt(v.x)", random_inputs(16, -20, 20, true),
                         {float_rule("rounded once", [](const Words& w) { return std::sqrt(as_float(w[0])); }),
                          float_rule("x times the rounded 1 / sqrt(x)",
                                     [](const Words& w) { return as_float(w[0]) * reciprocal_root(as_float(w[0])); }),
                          float_rule("1 over the rounded 1 / sqrt(x)",
                                     [](const Words& w) { return 1.0f / reciprocal_root(as_float(w[0])); })}));
    all.push_back(binary(
        "inverse-square-root", "the rounding of 1 / sqrt(x)", "inversesqrt(v.x)", random_inputs(17, -20, 20, true),
        {float_rule("rounded once", [](const Words& w) { return reciprocal_root(as_float(w[0])); }),
         float_rule("1 over the rounded root", [](const Words& w) { return 1.0f / std::sqrt(as_float(w[0])); })}));
    all.push_back(
        binary("minimum", "NaN and signed zeros in min(x, y)", "min(v.x, v.y)", special_pairs(), of_minimum(), false));
}

}  // namespace strata::probe
