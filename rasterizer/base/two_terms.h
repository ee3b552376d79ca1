// rasterizer/base/two_terms.h - sums and products of two binary64 numbers as an unevaluated pair, without rounding.
//
// Source   Knuth, TAOCP volume 2, 4.2.2 (sum); Dekker 1971 (product by halves, no fused multiply-add).
// Numbers  Exact while nothing overflows (products: |a|, |b| < 2^995) and no product falls below 2^-1074.
// Tests    tests/rasterizer/base/exact_sum_test.cpp, tests/scenes/numbers/elementary_test.cpp
#pragma once
#include "rasterizer/base/numerics.h"

namespace strata::rasterizer {
inline namespace strict {

struct TwoTerms {
    double high = 0, low = 0;  // high + low is the exact result, high is it rounded to nearest
};

// a + b. Precondition: |a| >= |b| or a is 0.
[[nodiscard]] constexpr TwoTerms fast_two_sum(double a, double b) noexcept {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

// a + b for any order of magnitudes (rasterizer/reference/numbers.md 3.1).
[[nodiscard]] constexpr TwoTerms two_sum(double a, double b) noexcept {
    const double sum = a + b;
    const double b_seen = sum - a;
    const double a_seen = sum - b_seen;
    return {sum, (a - a_seen) + (b - b_seen)};
}

// a split into its upper 26 bits and the rest.
[[nodiscard]] constexpr TwoTerms split(double a) noexcept {
    const double c = 0x1.0000002p27 * a;  // 2^27 + 1
    const double high = c - (c - a);
    return {high, a - high};
}

// a b. The products of halves are exact and are summed in an order in which no step rounds (numbers.md 3.2).
[[nodiscard]] constexpr TwoTerms two_product(double a, double b) noexcept {
    const double product = a * b;
    const TwoTerms x = split(a), y = split(b);
    const double rest = ((x.high * y.high - product) + x.high * y.low) + x.low * y.high;
    return {product, rest + x.low * y.low};
}

}  // namespace strict
}  // namespace strata::rasterizer
