// tools/oracle/verdict/interval.h - all values that a number may have, and arithmetic that never loses one of them.
//
// Rule     An operation's result holds every exact result of operands out of the intervals. Ends are rounded outward.
// Numbers  Binary64 rounds to nearest: an exact result lies within 2^-53 of the rounded one, relative to it, or within
//          2^-1075 where that is subnormal. `below` and `above` step 2^-52 and 2^-1000 aside, so they are beyond it
//          after any one operation.
// Tests    tests/tools/oracle/verdict/interval_test.cpp: rationals decide
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
// Of 1 - x.
[[nodiscard]] inline Interval rest_of(Interval x) noexcept { return {below(1 - x.high), above(1 - x.low)}; }

[[nodiscard]] inline Interval operator*(Interval a, Interval b) noexcept {
    if (a.low >= 0 && b.low >= 0) return {below(a.low * b.low), above(a.high * b.high)};
    const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {below(low), above(high)};
}

// A share `a`, within [0, 1], of `s` and the rest of `d`: a s + (1 - a) d. It is linear in each of the three, so the
// ends of the result belong to ends of the operands; taken as one, it is narrower than the sum of two products.
[[nodiscard]] inline Interval mixed(Interval a, Interval s, Interval d) noexcept {
    const auto end = [](double share, double from, double onto) { return share * from + (1 - share) * onto; };
    const double low = std::min(end(a.low, s.low, d.low), end(a.high, s.low, d.low));
    const double high = std::max(end(a.low, s.high, d.high), end(a.high, s.high, d.high));
    const double error = (s.magnitude() + d.magnitude()) * 0x1p-51;  // four roundings of terms that are no greater
    return {below(low - error), above(high + error)};
}

}  // namespace strict
}  // namespace strata::oracle::verdict
