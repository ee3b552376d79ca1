// tools/probe/operation_numbers.h - words and binary32, and inputs drawn by seed, for the lists of operations.
#pragma once
#include <bit>
#include <cstdint>

#include "tools/probe/dice.h"
#include "tools/probe/operation.h"

namespace strata::probe {

[[nodiscard]] constexpr float as_float(std::uint32_t word) noexcept { return std::bit_cast<float>(word); }
[[nodiscard]] constexpr std::uint32_t as_word(float value) noexcept { return std::bit_cast<std::uint32_t>(value); }
[[nodiscard]] constexpr bool is_denormal(float v) noexcept { return v != 0.0f && (as_word(v) & 0x7f800000u) == 0; }
[[nodiscard]] constexpr float flushed(float v) noexcept {
    return is_denormal(v) ? as_float(as_word(v) & 0x80000000u) : v;
}
// A rule of one result.
template <class Rule>
[[nodiscard]] Hypothesis rule(const char* name, Rule&& result) {
    return {name, [result](const Words& a) { return Words{result(a), 0, 0, 0}; }};
}
// The same of a binary32.
template <class Rule>
[[nodiscard]] Hypothesis float_rule(const char* name, Rule&& result) {
    return rule(name, [result](const Words& a) { return as_word(result(a)); });
}

}  // namespace strata::probe
