// tests/pipeline/lighting/bounded.h - a real number with a bound of what a computation in binary32 may be away from it.
//
// Rule     Running error analysis: each operation passes on the errors of its operands and adds half a unit in the last
//          place of its result, 2^-24 of its size. Reals are binary64, whose own error is 2^-29 of that.
#pragma once
#include <algorithm>
#include <cmath>

namespace strata::testing {

struct Bounded {
    double value = 0, error = 0;
};

[[nodiscard]] inline Bounded rounded_after(double value, double error) {
    return {value, error + 0x1.001p-24 * (std::fabs(value) + error) + 0x1p-149};
}
// A number that is rounded once to binary32.
[[nodiscard]] inline Bounded once(double value) { return rounded_after(value, 0); }

[[nodiscard]] inline Bounded operator+(const Bounded& a, const Bounded& b) {
    return rounded_after(a.value + b.value, a.error + b.error);
}
[[nodiscard]] inline Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }
[[nodiscard]] inline Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }
[[nodiscard]] inline Bounded operator*(const Bounded& a, const Bounded& b) {
    return rounded_after(a.value * b.value,
                         std::fabs(a.value) * b.error + std::fabs(b.value) * a.error + a.error * b.error);
}
// The divisor is above its error.
[[nodiscard]] inline Bounded operator/(const Bounded& a, const Bounded& b) {
    const double quotient = a.value / b.value;
    return rounded_after(quotient, (a.error + std::fabs(quotient) * b.error) / (std::fabs(b.value) - b.error));
}
[[nodiscard]] inline Bounded root(const Bounded& a) {
    const double value = std::sqrt(a.value);
    return rounded_after(value, a.error / (std::sqrt(std::max(a.value - a.error, 0.0)) + value));
}
// Of a number of at least 0; grows with it.
[[nodiscard]] inline Bounded raised(const Bounded& a, double exponent) {
    const auto at = [&](double x) { return std::pow(std::max(x, 0.0), exponent); };
    const double value = at(a.value);
    return rounded_after(value, std::max(at(a.value + a.error) - value, value - at(a.value - a.error)));
}
[[nodiscard]] inline Bounded at_least(const Bounded& a, double least) { return {std::max(a.value, least), a.error}; }

// True if no number within the error is on the other side of the limit.
[[nodiscard]] inline bool is_clear_of(const Bounded& a, double limit) { return std::fabs(a.value - limit) > a.error; }

}  // namespace strata::testing
