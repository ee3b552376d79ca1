#include "tools/lab/hardware_check/drawing/names.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace strata::hardware_check {
namespace {

using pipeline::BlendEquation;
using pipeline::BlendFactor;
using pipeline::CompareFunc;

// A word of a file name and its meaning.
template <class T>
using Word = std::pair<std::string_view, T>;

// The word's meaning; empty if it is not in the list.
template <class T, std::size_t n>
std::optional<T> look_up(const std::array<Word<T>, n>& words, std::string_view word) {
    const auto found = std::find_if(words.begin(), words.end(), [&](const Word<T>& w) { return w.first == word; });
    return found == words.end() ? std::nullopt : std::optional{found->second};
}

// Suites spell a function out or abbreviate it.
constexpr std::array<Word<CompareFunc>, 17> compare_words{{{"Never", CompareFunc::never},
                                                           {"LessThan", CompareFunc::less},
                                                           {"Less", CompareFunc::less},
                                                           {"Equal", CompareFunc::equal},
                                                           {"LessThanOrEqual", CompareFunc::lequal},
                                                           {"GreaterThan", CompareFunc::greater},
                                                           {"Greater", CompareFunc::greater},
                                                           {"NotEqual", CompareFunc::notequal},
                                                           {"GreaterThanOrEqual", CompareFunc::gequal},
                                                           {"Always", CompareFunc::always},
                                                           {"N", CompareFunc::never},
                                                           {"LT", CompareFunc::less},
                                                           {"EQ", CompareFunc::equal},
                                                           {"LE", CompareFunc::lequal},
                                                           {"GT", CompareFunc::greater},
                                                           {"NE", CompareFunc::notequal},
                                                           {"GE", CompareFunc::gequal}}};

// The words of Blend_tests; c is the constant colour.
constexpr std::array<Word<BlendFactor>, 15> factor_words{{{"0", BlendFactor::zero},
                                                          {"1", BlendFactor::one},
                                                          {"srcRGB", BlendFactor::src_color},
                                                          {"1-srcRGB", BlendFactor::one_minus_src_color},
                                                          {"srcA", BlendFactor::src_alpha},
                                                          {"1-srcA", BlendFactor::one_minus_src_alpha},
                                                          {"dstA", BlendFactor::dst_alpha},
                                                          {"1-dstA", BlendFactor::one_minus_dst_alpha},
                                                          {"dstRGB", BlendFactor::dst_color},
                                                          {"1-dstRGB", BlendFactor::one_minus_dst_color},
                                                          {"srcAsat", BlendFactor::src_alpha_saturate},
                                                          {"cRGB", BlendFactor::constant_color},
                                                          {"1-cRGB", BlendFactor::one_minus_constant_color},
                                                          {"cA", BlendFactor::constant_alpha},
                                                          {"1-cA", BlendFactor::one_minus_constant_alpha}}};

constexpr std::array<Word<BlendEquation>, 7> equation_words{{{"ADD", BlendEquation::add},
                                                             {"SUB", BlendEquation::subtract},
                                                             {"REVSUB", BlendEquation::reverse_subtract},
                                                             {"MIN", BlendEquation::min},
                                                             {"MAX", BlendEquation::max},
                                                             {"SADD", BlendEquation::signed_add},
                                                             {"SREVSUB", BlendEquation::signed_reverse_subtract}}};

// The whole text must be a number: names end where a number ends.
template <class T, class... Format>
std::optional<T> parse_whole(std::string_view text, Format... format) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, format...);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::optional<float> to_number(std::string_view text) { return parse_whole<float>(text); }
std::optional<std::uint32_t> to_hexadecimal(std::string_view text) { return parse_whole<std::uint32_t>(text, 16); }

std::optional<CompareFunc> compare_func(std::string_view word) {
    if (word == "A") return CompareFunc::always;
    return look_up(compare_words, word);
}
std::optional<BlendFactor> blend_factor(std::string_view word) { return look_up(factor_words, word); }
std::optional<BlendEquation> blend_equation(std::string_view word) { return look_up(equation_words, word); }

}  // namespace strata::hardware_check
