// rasterizer/base/exact_sum.h - exact sums of products of binary64 numbers, for the rare fragment that needs them.
//
// Rule     An expansion: non-overlapping terms, smallest first. Its sign is the sign of the last nonzero term.
// Source   Shewchuk 1997, "Adaptive precision floating-point arithmetic", 2.2-2.4.
// Numbers  Exact if no product overflows (|a b| < 2^996) and every product is a multiple of 2^-1074, that is, one
//          factor is an integer.
// Tests    tests/rasterizer/base/exact_sum_test.cpp
#pragma once
#include <array>
#include <cassert>
#include <cstdint>

#include "rasterizer/base/two_terms.h"

namespace strata::rasterizer {
inline namespace strict {

// An integer as one binary64 number if it fits, else as the sum of two.
[[nodiscard]] constexpr TwoTerms as_terms(std::int64_t value) noexcept {
    constexpr std::int64_t limit = std::int64_t{1} << 53;
    if (-limit <= value && value <= limit) return {static_cast<double>(value), 0.0};
    const std::int64_t low = value & 0xffffffff;
    return {static_cast<double>(value - low), static_cast<double>(low)};
}

// An exact sum. Terms increase in magnitude and do not overlap, so the last one decides the sign. The capacity is 40
// terms; three products of an integer and two binary64 numbers plus one more product need 32
// (rasterizer/reference/numbers.md 3.3).
class ExactSum {
  public:
    // Carries x through the terms from the smallest to the largest. The rounding error of each step is kept as a term.
    // Zero terms are dropped, because `sign` reads only the last term.
    constexpr void add(double x) noexcept {
        int kept = 0;
        for (int i = 0; i < count_; ++i) {
            const TwoTerms s = two_sum(x, term_[i]);
            if (s.low != 0.0) term_[kept++] = s.low;
            x = s.high;
        }
        if (x != 0.0) {
            assert(kept < capacity && "three products of four factors and one more are 32 terms");
            term_[kept++] = x;
        }
        count_ = kept;
    }
    constexpr void add_product(double a, double b) noexcept {
        if (a == 0.0 || b == 0.0) return;
        const TwoTerms p = two_product(a, b);
        add(p.low);
        add(p.high);
    }
    // Adds n a b. The product a b and n are pairs of terms, so the result is four exact products.
    constexpr void add_product(std::int64_t n, double a, double b) noexcept {
        const TwoTerms p = two_product(a, b), m = as_terms(n);
        add_product(m.low, p.low);
        add_product(m.high, p.low);
        add_product(m.low, p.high);
        add_product(m.high, p.high);
    }
    // The exact sign of the sum: -1, 0 or 1.
    [[nodiscard]] constexpr int sign() const noexcept {
        if (count_ == 0) return 0;
        return term_[count_ - 1] > 0.0 ? 1 : -1;
    }
    // The sum with a relative error of at most 2^-51, because the terms do not overlap.
    [[nodiscard]] constexpr double approximation() const noexcept {
        double sum = 0.0;
        for (int i = 0; i < count_; ++i) sum += term_[i];
        return sum;
    }

  private:
    static constexpr int capacity = 40;
    std::array<double, capacity> term_{};
    int count_ = 0;
};

}  // namespace strict
}  // namespace strata::rasterizer
