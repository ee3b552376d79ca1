// rasterizer/base/exact_sum.h - sums of products of binary64 numbers without any rounding, for the rare fragment that
// needs it.
//
// Rule     An expansion: terms that do not overlap, smallest first; its sign is the sign of the last term that is not
//          zero.
// Source   Shewchuk 1997, "Adaptive precision floating-point arithmetic", 2.2-2.4.
// Numbers  Exact while no product overflows (|a b| < 2^996) and every product is a multiple of 2^-1074: one factor is
//          an integer.
// Tests    tests/rasterizer/base/exact_sum_test.cpp
#pragma once
#include <array>
#include <cassert>
#include <cstdint>

#include "rasterizer/base/two_terms.h"

namespace strata::rasterizer {
inline namespace strict {

// An integer as one binary64 number if it fits, else as two.
[[nodiscard]] constexpr TwoTerms as_terms(std::int64_t value) noexcept {
    constexpr std::int64_t limit = std::int64_t{1} << 53;
    if (-limit <= value && value <= limit) return {static_cast<double>(value), 0.0};
    const std::int64_t low = value & 0xffffffff;
    return {static_cast<double>(value - low), static_cast<double>(low)};
}

// A sum that keeps every bit. Terms rise in magnitude and do not overlap, so the
// last one decides the sign. 40 places are more than enough: three products of an
// integer and two binary64 numbers, and one product more, need 32 (numbers.md 3.3).
class ExactSum {
  public:
    // Carries x through the terms from the smallest to the largest. What a step rounds off stays behind as a term; a
    // term of value 0 is dropped, because `sign` looks at the last term alone.
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
    // Adds n a b. The product a b is a pair and n is a pair, so four exact products make up the whole.
    constexpr void add_product(std::int64_t n, double a, double b) noexcept {
        const TwoTerms p = two_product(a, b), m = as_terms(n);
        add_product(m.low, p.low);
        add_product(m.high, p.low);
        add_product(m.low, p.high);
        add_product(m.high, p.high);
    }
    // -1, 0 or 1: the exact sign of the sum.
    [[nodiscard]] constexpr int sign() const noexcept {
        if (count_ == 0) return 0;
        return term_[count_ - 1] > 0.0 ? 1 : -1;
    }
    // Relative error at most 2^-51: the terms do not overlap.
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
