// scenes/double_double.h - an unevaluated sum of two binary64 numbers, about 106 bits, for elementary.cpp.
//
// Rule     hi is the sum rounded to nearest. two_sum and two_product are exact; add, mul and div err by a few 2^-104
//          relative (add: relative to the larger operand).
// Source   Dekker 1971 (product by halves, no fused multiply-add), Knuth TAOCP 4.2.2 (sum).
// Numbers  two_product needs |a|, |b| < 2^995 and no underflow: the callers stay far from both.
#pragma once
#include "rasterizer/numerics.h"

namespace strata::scenes {
inline namespace strict {

struct DoubleDouble {
    double hi = 0, lo = 0;
};

// a + b exactly, if |a| >= |b| or a is 0.
[[nodiscard]] constexpr DoubleDouble fast_two_sum(double a, double b) noexcept {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

[[nodiscard]] constexpr DoubleDouble two_sum(double a, double b) noexcept {
    const double sum = a + b;
    const double b_part = sum - a;
    const double a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}

// The upper 26 bits and the rest.
[[nodiscard]] constexpr DoubleDouble halves(double a) noexcept {
    const double shifted = 0x1.000002p+27 * a;  // 2^27 + 1
    const double upper = shifted - (shifted - a);
    return {upper, a - upper};
}

[[nodiscard]] constexpr DoubleDouble two_product(double a, double b) noexcept {
    const double product = a * b;
    const DoubleDouble x = halves(a), y = halves(b);
    const double error = ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo;
    return {product, error};
}

[[nodiscard]] constexpr DoubleDouble add(DoubleDouble a, DoubleDouble b) noexcept {
    const DoubleDouble high = two_sum(a.hi, b.hi), low = two_sum(a.lo, b.lo);
    const DoubleDouble sum = fast_two_sum(high.hi, high.lo + low.hi);
    return fast_two_sum(sum.hi, sum.lo + low.lo);
}

[[nodiscard]] constexpr DoubleDouble negated(DoubleDouble a) noexcept { return {-a.hi, -a.lo}; }

[[nodiscard]] constexpr DoubleDouble mul(DoubleDouble a, DoubleDouble b) noexcept {
    const DoubleDouble product = two_product(a.hi, b.hi);
    return fast_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

// The quotient's three leading digits, each the rounded quotient of what is left.
[[nodiscard]] constexpr DoubleDouble div(DoubleDouble a, DoubleDouble b) noexcept {
    const double first = a.hi / b.hi;
    const DoubleDouble rest = add(a, negated(mul(b, {first, 0})));
    const double second = rest.hi / b.hi;
    const DoubleDouble last = add(rest, negated(mul(b, {second, 0})));
    const DoubleDouble quotient = fast_two_sum(first, second);
    return fast_two_sum(quotient.hi, quotient.lo + last.hi / b.hi);
}

}  // namespace strict
}  // namespace strata::scenes
