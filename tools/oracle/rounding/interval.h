// tools/oracle/rounding/interval.h - interval arithmetic: the result contains every possible value of a number.
//
// Rule     The result of an operation contains every exact result of operands within the intervals. Ends are rounded
//          outward.
// Numbers  Binary64 rounds to nearest: the exact result is within a relative 2^-53 of the rounded one, or within
//          2^-1075 if that is subnormal. `below` and `above` move it by a relative 2^-52 and by 2^-1000, so they bound
//          the result of any single operation.
// Tests    tests/tools/oracle/rounding/interval_test.cpp: rational arithmetic
#pragma once
#include <algorithm>
#include <cmath>

#include "rasterizer/base/numerics.h"

namespace strata::oracle::verdict {
inline namespace strict {

[[nodiscard]] inline double below(double x) noexcept { return x - std::fabs(x) * 0x1p-52 - 0x1p-1000; }
[[nodiscard]] inline double above(double x) noexcept { return x + std::fabs(x) * 0x1p-52 + 0x1p-1000; }

struct Interval {
    double low = 0, high = 0;

    [[nodiscard]] static constexpr Interval of(double x) noexcept { return {x, x}; }
    [[nodiscard]] bool holds(double x) const noexcept { return low <= x && x <= high; }
    [[nodiscard]] double magnitude() const noexcept { return std::max(std::fabs(low), std::fabs(high)); }
    friend constexpr bool operator==(const Interval&, const Interval&) = default;
    [[nodiscard]] Interval widened(double by) const noexcept { return {below(low - by), above(high + by)}; }
};

[[nodiscard]] inline Interval operator+(Interval a, Interval b) noexcept {
    return {below(a.low + b.low), above(a.high + b.high)};
}
// The least interval that includes both.
[[nodiscard]] inline Interval hull(Interval a, Interval b) noexcept {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
// 1 - x.
[[nodiscard]] inline Interval rest_of(Interval x) noexcept { return {below(1 - x.high), above(1 - x.low)}; }

[[nodiscard]] inline Interval operator*(Interval a, Interval b) noexcept {
    if (a.low >= 0 && b.low >= 0) return {below(a.low * b.low), above(a.high * b.high)};
    const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {below(low), above(high)};
}

// a s + (1 - a) d, the blend of `s` over `d` with alpha `a` in [0, 1]. It is linear in each operand, so the ends of the
// result are at ends of the operands; it is narrower than the sum of two interval products.
[[nodiscard]] inline Interval mixed(Interval a, Interval s, Interval d) noexcept {
    const auto end = [](double share, double from, double onto) { return share * from + (1 - share) * onto; };
    const double low = std::min(end(a.low, s.low, d.low), end(a.high, s.low, d.low));
    const double high = std::max(end(a.low, s.high, d.high), end(a.high, s.high, d.high));
    // Four roundings of terms of at most that magnitude.
    const double error = (s.magnitude() + d.magnitude()) * 0x1p-51;
    return {below(low - error), above(high + error)};
}

}  // namespace strict
}  // namespace strata::oracle::verdict
