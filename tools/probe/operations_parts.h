// tools/probe/operations_parts.h - functions that the parts of the list of operations share.
#pragma once
#include <bit>

#include "tools/probe/operations.h"

namespace strata::probe {

[[nodiscard]] inline float float_of(std::uint32_t word) noexcept { return std::bit_cast<float>(word); }
[[nodiscard]] inline std::uint32_t word_of(float value) noexcept { return std::bit_cast<std::uint32_t>(value); }
[[nodiscard]] inline Texel one_word(std::uint32_t word) noexcept { return {word, 0, 0, 0}; }

}  // namespace strata::probe
