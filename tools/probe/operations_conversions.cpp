// tools/probe/operations_conversions.cpp - floor, fract, min and max with NaN, and conversions out of range.
#include <bit>
#include <cmath>

#include "tools/probe/operations_parts.h"
#include "tools/probe/random_generator.h"

namespace strata::probe {

namespace {

using One = std::uint32_t (*)(std::uint32_t, std::uint32_t);

Hypothesis of(std::string name, One formula) {
    return {std::move(name), [formula](const Texel& given) { return Texel{formula(given[0], given[1]), 0, 0, 0}; }};
}

constexpr std::array<std::uint32_t, 16> corners_of_numbers{
    0,           0x80000000u, 0x7f800000u, 0xff800000u, 0x7fc00000u, 0xffc00000u, 0x3f800000u, 0xbf800000u,
    0x00800000u, 0xb0000000u, 0x4effffffu, 0x4f000000u, 0xcf000000u, 0xcf000001u, 0x4f7fffffu, 0x4f800000u};

// Zeros, infinities, NaNs, ones and the ends of integer ranges, each with each; then arbitrary finite numbers.
std::vector<Texel> odd_pairs() {
    std::vector<Texel> all;
    for (const std::uint32_t a : corners_of_numbers)
        for (const std::uint32_t b : corners_of_numbers) all.push_back({a, b, 0, 0});
    RandomGenerator random{771};
    for (int i = 0; i < 768; ++i) {
        const auto exponent = static_cast<std::uint32_t>(90 + random.below(70));
        const std::uint32_t a = (random.next() & 0x807fffffu) | exponent << 23;
        const std::uint32_t b = (random.next() & 0x807fffffu) | exponent << 23;
        all.push_back({a, b, 0, 0});
    }
    return all;
}

std::vector<Texel> words() {
    RandomGenerator random{772};
    std::vector<Texel> all;
    for (int i = 0; i < 1024; ++i) all.push_back({random.next() >> random.below(8), 0, 0, 0});
    return all;
}

std::uint32_t whole(std::uint32_t a, std::uint32_t) { return word_of(std::floor(float_of(a))); }
std::uint32_t whole_unsigned(std::uint32_t a, std::uint32_t) { return word_of(std::floor(float_of(a)) + 0.0f); }
std::uint32_t rest(std::uint32_t a, std::uint32_t) { return word_of(float_of(a) - std::floor(float_of(a))); }
std::uint32_t rest_below_one(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t plain = rest(a, b);
    return plain == 0x3f800000u ? 0x3f7fffffu : plain;
}

// A minimum that returns the number if the other operand is NaN.
std::uint32_t rest_never_nan(std::uint32_t a, std::uint32_t b) {
    return std::isnan(float_of(rest(a, b))) ? 0x3f7fffffu : rest_below_one(a, b);
}

// The definitions of GLSL, and the two other results that a failed comparison can give.
std::uint32_t least_defined(std::uint32_t a, std::uint32_t b) { return float_of(b) < float_of(a) ? b : a; }
std::uint32_t least_second(std::uint32_t a, std::uint32_t b) { return float_of(a) < float_of(b) ? a : b; }
std::uint32_t greatest_defined(std::uint32_t a, std::uint32_t b) { return float_of(a) < float_of(b) ? b : a; }
std::uint32_t greatest_second(std::uint32_t a, std::uint32_t b) { return float_of(b) < float_of(a) ? a : b; }
// `plain`, except that of a number and NaN the number is returned.
template <One plain>
std::uint32_t number_first(std::uint32_t a, std::uint32_t b) {
    return std::isnan(float_of(a)) ? b : std::isnan(float_of(b)) ? a : plain(a, b);
}

std::uint32_t int_saturated(std::uint32_t a, std::uint32_t) {
    const float f = float_of(a);
    if (std::isnan(f)) return 0;
    if (f >= 0x1p31f) return 0x7fffffffu;
    return f < -0x1p31f ? 0x80000000u : static_cast<std::uint32_t>(static_cast<std::int32_t>(f));
}
std::uint32_t int_indefinite(std::uint32_t a, std::uint32_t b) {
    return float_of(a) >= -0x1p31f && float_of(a) < 0x1p31f ? int_saturated(a, b) : 0x80000000u;
}
std::uint32_t uint_saturated(std::uint32_t a, std::uint32_t) {
    const float f = float_of(a);
    if (!(f > 0.0f)) return 0;
    return f >= 0x1p32f ? 0xffffffffu : static_cast<std::uint32_t>(f);
}
// Conversion to 64 bits, of which the low ones are used; values outside give 0.
std::uint32_t uint_low_bits(std::uint32_t a, std::uint32_t) {
    const float f = float_of(a);
    return f >= -0x1p63f && f < 0x1p63f ? static_cast<std::uint32_t>(static_cast<std::int64_t>(f)) : 0;
}
// AVX-512's conversion: all ones for values out of range.
std::uint32_t uint_all_ones(std::uint32_t a, std::uint32_t b) {
    return float_of(a) > -1.0f && float_of(a) < 0x1p32f ? uint_saturated(a, b) : 0xffffffffu;
}
// The code of compilers for a processor with only signed conversions: from 2^31 on it subtracts 2^31, and restores the
// bit by exclusive or.
std::uint32_t uint_by_halves(std::uint32_t a, std::uint32_t b) {
    return float_of(a) >= 0x1p31f ? int_indefinite(word_of(float_of(a) - 0x1p31f), b) ^ 0x80000000u
                                  : int_indefinite(a, b);
}

// The same with both halves combined by or: the upper one is used if the lower one is negative.
std::uint32_t uint_by_either_half(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t low = int_indefinite(a, b);
    return (low >> 31) != 0 ? low | int_indefinite(word_of(float_of(a) - 0x1p31f), b) : low;
}

// As uint_by_halves, with the upper half added modulo 2^32, and 0 for values with the sign bit set.
std::uint32_t uint_by_signless_halves(std::uint32_t a, std::uint32_t b) {
    return (a >> 31) != 0 ? 0 : uint_by_halves(a, b);
}

std::uint32_t float_even(std::uint32_t a, std::uint32_t) { return word_of(static_cast<float>(a)); }
std::uint32_t float_cut(std::uint32_t a, std::uint32_t) {
    const int width = std::bit_width(a);
    return word_of(static_cast<float>(width > 24 ? a >> (width - 24) << (width - 24) : a));
}
// The lower 31 bits are rounded; then the upper one is added, and the sum is rounded again.
std::uint32_t float_by_halves(std::uint32_t a, std::uint32_t) {
    return word_of(static_cast<float>(a & 0x7fffffffu) + ((a >> 31) != 0 ? 0x1p31f : 0.0f));
}
std::uint32_t float_signed(std::uint32_t a, std::uint32_t) {
    return word_of(static_cast<float>(static_cast<std::int32_t>(a)));
}

Operation operation(std::string name, std::string question, const std::string& expression, ResultKind result,
                    std::vector<Texel> inputs, std::vector<Hypothesis> hypotheses) {
    Operation o{.name = std::move(name), .question = std::move(question), .inputs = std::move(inputs)};
    o.result = result;
    o.corners = whole_picture();
    o.programs =
        one_pass("highp float a = F(given.x), b = F(given.y); result = uvec4(" + expression + ", 0u, 0u, 0u);");
    o.hypotheses = std::move(hypotheses);
    return o;
}

}  // namespace

void add_conversions(std::vector<Operation>& list) {
    const auto floats = ResultKind::floats, integers = ResultKind::words;
    list.push_back(operation("shader.floor", "what is floor(a), of -0 and of large numbers?", "U(floor(a))", floats,
                             odd_pairs(), {of("floor", whole), of("floor, never -0", whole_unsigned)}));
    list.push_back(operation("shader.fract", "can fract(a) be 1?", "U(fract(a))", floats, odd_pairs(),
                             {of("a - floor(a)", rest), of("a - floor(a), below 1", rest_below_one),
                              of("a - floor(a), below 1 even of NaN", rest_never_nan)}));
    list.push_back(operation("shader.min", "what is min(a, b) of NaN and zeros?", "U(min(a, b))", floats, odd_pairs(),
                             {of("b < a ? b : a", least_defined), of("a < b ? a : b", least_second),
                              of("a number before NaN, then b < a ? b : a", number_first<least_defined>),
                              of("a number before NaN, then a < b ? a : b", number_first<least_second>)}));
    list.push_back(operation("shader.max", "what is max(a, b) of NaN and zeros?", "U(max(a, b))", floats, odd_pairs(),
                             {of("a < b ? b : a", greatest_defined), of("b < a ? a : b", greatest_second),
                              of("a number before NaN, then a < b ? b : a", number_first<greatest_defined>),
                              of("a number before NaN, then b < a ? a : b", number_first<greatest_second>)}));
    list.push_back(operation("shader.to-int", "what is int(a) out of range?", "uint(int(a))", integers, odd_pairs(),
                             {of("the nearest end, 0 of NaN", int_saturated), of("-2^31", int_indefinite)}));
    list.push_back(operation("shader.to-uint", "what is uint(a) out of range?", "uint(a)", integers, odd_pairs(),
                             {of("the nearest end, 0 of NaN", uint_saturated), of("the low bits of 64", uint_low_bits),
                              of("2^32 - 1", uint_all_ones), of("two signed halves", uint_by_halves),
                              of("two signed halves, by or", uint_by_either_half),
                              of("two signed halves, 0 below 0", uint_by_signless_halves)}));
    list.push_back(operation("shader.from-uint", "how is float(integer) rounded?", "U(float(given.x))", floats, words(),
                             {of("nearest even", float_even), of("toward zero", float_cut),
                              of("31 bits, then 2^31 added", float_by_halves)}));
    list.push_back(operation("shader.from-int", "how is float(integer) rounded, below 0?", "U(float(int(given.x)))",
                             floats, words(), {of("nearest even", float_signed)}));
}

}  // namespace strata::probe
