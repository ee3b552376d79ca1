// tools/request/weight_words.h - reads the weight of a fragment as a formula.
//
// Rule     sum = product {(+|-) product};  product = factor {(*|/) factor};  factor = -factor, a decimal number, z,
//          distance, alpha, ( sum ), exp(a), min(a, b), max(a, b), pow(a, b) or clamp(a, least, most). Operators group
//          from the left. z is the window depth, 0 near and 1 far. Spaces are ignored; the text is kept without them.
//          pow with a whole number from 2 to 8 that is written as its second argument is a product.
// Source   peeling/reference/algorithms.md 18.3.
// Tests    tests/tools/request/weight_words_test.cpp
#pragma once
#include <optional>
#include <string_view>

#include "peeling/programs/weight_formula.h"

namespace strata::tools {

// Empty for any other text, and for a formula of too many steps (peeling/programs/weight_formula.h).
[[nodiscard]] std::optional<peeling::WeightFormula> to_weight_formula(std::string_view text);

}  // namespace strata::tools
