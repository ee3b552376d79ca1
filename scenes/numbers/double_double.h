// scenes/numbers/double_double.h - an unevaluated sum of two binary64 numbers, about 106 bits, for elementary.cpp.
//
// Rule     high is the sum rounded to nearest; add, mul and div err by a few 2^-104 relative (add: relative to the
//          larger operand).
// Source   rasterizer/base/two_terms.h for the exact sums and products underneath.
#pragma once
#include "rasterizer/base/two_terms.h"

namespace strata::scenes {
inline namespace strict {

using DoubleDouble = rasterizer::TwoTerms;
using rasterizer::fast_two_sum;
using rasterizer::two_product;
using rasterizer::two_sum;

// Adds both parts exactly, then the rounding errors from the smallest up; the last step makes high the rounded sum.
[[nodiscard]] constexpr DoubleDouble add(DoubleDouble a, DoubleDouble b) noexcept {
    const DoubleDouble high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
    const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
    return fast_two_sum(sum.high, sum.low + low.low);
}

[[nodiscard]] constexpr DoubleDouble negated(DoubleDouble a) noexcept { return {-a.high, -a.low}; }

// The product of the low parts is omitted: it is smaller than the error that the rule allows.
[[nodiscard]] constexpr DoubleDouble mul(DoubleDouble a, DoubleDouble b) noexcept {
    const DoubleDouble product = two_product(a.high, b.high);
    return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

// Three quotients, each the rounded quotient of the remainder.
[[nodiscard]] constexpr DoubleDouble div(DoubleDouble a, DoubleDouble b) noexcept {
    const double first = a.high / b.high;
    const DoubleDouble rest = add(a, negated(mul(b, {first, 0})));
    const double second = rest.high / b.high;
    const DoubleDouble last = add(rest, negated(mul(b, {second, 0})));
    const DoubleDouble quotient = fast_two_sum(first, second);
    return fast_two_sum(quotient.high, quotient.low + last.high / b.high);
}

}  // namespace strict
}  // namespace strata::scenes
