// peeling/programs/tie_policy.h - the rule that says which fragments of equal key are composited, and in which order.
// peeling/reference/keys-and-counts.md 2.2.
#pragma once
#include <cstdint>
#include <string_view>

#include "rasterizer/base/enum_values.h"

namespace strata::peeling {

enum class TiePolicy : std::uint8_t {
    none,             // the algorithm has no order
    first,            // all, the first submitted in front
    last,             // all, the last submitted in front
    unique,           // only the first submitted
    merged,           // one layer per key, a component-wise mixture
    first_then_last,  // `first` in the front half of the keys, `last` in the back half (dual_independent)
};

[[nodiscard]] constexpr std::string_view name(TiePolicy policy) noexcept { return enum_name(policy); }

}  // namespace strata::peeling
