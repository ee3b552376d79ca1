// tools/lab/hardware_check/drawing/names.h - parses the words of the captures' file names.
#pragma once
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/device/state.h"

namespace strata::hardware_check {

// Removes `prefix`; returns false and leaves the name unchanged if it is absent.
inline bool take(std::string_view& name, std::string_view prefix) {
    if (!name.starts_with(prefix)) return false;
    name.remove_prefix(prefix.size());
    return true;
}
// Removes `suffix`; returns false and leaves the name unchanged if it is absent.
inline bool take_last(std::string_view& name, std::string_view suffix) {
    if (!name.ends_with(suffix)) return false;
    name.remove_suffix(suffix.size());
    return true;
}
// Removes and returns the text before `separator`, and removes the separator; the whole name if there is none.
inline std::string_view take_until(std::string_view& name, std::string_view separator) {
    const std::size_t end = name.find(separator);
    const std::string_view word = name.substr(0, end);
    name = end == std::string_view::npos ? std::string_view{} : name.substr(end + separator.size());
    return word;
}

// A decimal number; the whole text must be one. It may be infinite or NaN: callers check the range.
[[nodiscard]] std::optional<float> to_number(std::string_view text);
// Hexadecimal digits without 0x, at most 32 bits.
[[nodiscard]] std::optional<std::uint32_t> to_hexadecimal(std::string_view text);

// The meanings of words in names; empty for an unknown word.
[[nodiscard]] std::optional<pipeline::CompareFunc> compare_func(
    std::string_view word);  // Never, LessThan ...; N, LT ...
[[nodiscard]] std::optional<pipeline::BlendFactor> blend_factor(std::string_view word);  // 0, 1, srcRGB, 1-srcRGB ...
[[nodiscard]] std::optional<pipeline::BlendEquation> blend_equation(std::string_view word);  // ADD, SREVSUB ...

}  // namespace strata::hardware_check
