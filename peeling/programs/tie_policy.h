// peeling/programs/tie_policy.h - which fragments of equal key are composited, and in which order. keys-and-counts.md
// 2.2.
#pragma once
#include <cstdint>
#include <string_view>

namespace strata::peeling {

enum class TiePolicy : std::uint8_t {
    none,             // no order at all
    first,            // all, the first submitted in front
    last,             // all, the last arrival in front
    unique,           // the first submitted only
    merged,           // one layer a key, a component-wise mixture
    first_then_last,  // FIRST in the front half of the keys, LAST in the back half (dual_independent)
};

[[nodiscard]] std::string_view name(TiePolicy policy) noexcept;

}  // namespace strata::peeling
