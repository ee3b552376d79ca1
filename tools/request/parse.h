// tools/request/parse.h - converts text of the command line to numbers, independently of the locale. The whole
// text must be a number.
#pragma once
#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

// A whole decimal number within the range of T; empty for any other text, including a sign +, spaces, and -0.
template <std::integral T = int>
[[nodiscard]] std::optional<T> to_int(std::string_view text) {
    T value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if (value == 0 && text.starts_with('-')) return std::nullopt;
    return value;
}

// A whole number of at least 1.
[[nodiscard]] inline std::optional<int> to_positive(std::string_view text) {
    const auto value = to_int(text);
    return value && *value >= 1 ? value : std::nullopt;
}

// The value nearest to the decimal number; neither infinite nor NaN.
template <std::floating_point T>
[[nodiscard]] std::optional<T> to_number(std::string_view text) {
    T value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

// Seconds, from 0 to an hour.
[[nodiscard]] inline std::optional<double> to_seconds(std::string_view text) {
    const auto value = to_number<double>(text);
    return value && *value >= 0 && *value <= 3600 ? value : std::nullopt;
}

// Splits at the separator: "a,b," has three parts, the last of them empty.
[[nodiscard]] inline std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

// Exactly `count` numbers separated by commas.
template <std::floating_point T>
[[nodiscard]] std::optional<std::vector<T>> to_numbers(std::string_view text, std::size_t count) {
    std::vector<T> values;
    for (const std::string& part : split(text, ',')) {
        const auto value = to_number<T>(part);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    if (values.size() != count) return std::nullopt;
    return values;
}

}  // namespace strata::tools
