// scenes/numbers/elementary.cpp - reduction, then a series in about 106 bits, then one rounding to binary64.
#include "scenes/numbers/elementary.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "scenes/numbers/double_double.h"

namespace strata::scenes {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Reduced {
    int quadrant = 0;   // modulo 4
    DoubleDouble rest;  // radians, at most pi/4 in magnitude, except for rounding
};

// x - k pi/2. pi/2 in four parts (Cody and Waite): the first three have at most 33 bits and |k| < 2^20, so their
// products are exact; the omitted part is below 2^-132, and no binary64 number up to 10^6 is nearer than 2^-64 to a
// multiple of pi/2.
Reduced reduce(double x) noexcept {
    constexpr double part[4] = {0x1.921fb544p+0, 0x0.42d18469p-32, 0x0.898cc517p-64, 0x1.b839a252049c1p-104};
    const double k = std::floor(x * 0x1.45f306dc9c883p-1 + 0.5);
    DoubleDouble rest{x - k * part[0], 0};  // exact: both are multiples of one power of two, and they nearly cancel
    for (int i = 1; i < 4; ++i) rest = add(rest, {-(k * part[i]), 0});
    return {static_cast<int>(static_cast<std::int64_t>(k) & 3), rest};
}

// x^first / first! - x^(first+2) / (first+2)! + ..., term by term down to 2^-110 of the first.
DoubleDouble alternating_series(DoubleDouble x, int first) noexcept {
    const DoubleDouble square = mul(x, x);
    DoubleDouble term = first == 0 ? DoubleDouble{1, 0} : x;
    DoubleDouble sum = term;
    for (int n = first + 2; n <= first + 28; n += 2) {
        term = negated(div(mul(term, square), {static_cast<double>(n * (n - 1)), 0}));
        sum = add(sum, term);
    }
    return sum;
}

// The quadrant adds k pi/2 to the angle: odd ones exchange sine and cosine, the upper two change the sign.
DoubleDouble sine(Reduced angle) noexcept {
    const DoubleDouble series = alternating_series(angle.rest, angle.quadrant % 2 == 0 ? 1 : 0);
    return angle.quadrant < 2 ? series : negated(series);
}

DoubleDouble cosine(Reduced angle) noexcept { return sine({(angle.quadrant + 1) % 4, angle.rest}); }

bool in_range(double angle) noexcept { return angle >= -max_angle && angle <= max_angle; }

constexpr DoubleDouble ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

// 2^exponent, for |exponent| <= 1022.
double power_of_two(int exponent) noexcept {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// ln(x) = e ln 2 + 2 artanh((m - 1) / (m + 1)) with x = 2^e m, m between sqrt(1/2) and sqrt(2).
DoubleDouble logarithm(double x) noexcept {
    // A denormal has no implicit leading bit: scaled by 2^54 it is normal, and the exponent is reduced by 54.
    const bool denormal = x < 0x1p-1022;
    const auto bits = std::bit_cast<std::uint64_t>(denormal ? x * 0x1p54 : x);
    int exponent = static_cast<int>(bits >> 52) - 1023 - (denormal ? 54 : 0);
    double mantissa = std::bit_cast<double>((bits & 0xfffffffffffffu) | 0x3ff0000000000000u);
    if (mantissa > 0x1.6a09e667f3bcdp+0) {
        mantissa *= 0.5;
        ++exponent;
    }
    const DoubleDouble s = div({mantissa - 1.0, 0}, two_sum(mantissa, 1.0));  // the difference is exact
    const DoubleDouble square = mul(s, s);
    DoubleDouble power = s, sum = s;
    for (int n = 3; n <= 45; n += 2) {  // |s| <= 0.172, so s^44 < 2^-110
        power = mul(power, square);
        sum = add(sum, div(power, {static_cast<double>(n), 0}));
    }
    return add(mul(ln2, {static_cast<double>(exponent), 0}), {2 * sum.high, 2 * sum.low});
}

// e^x with x = k ln 2 + rest. Above 709.79 the result exceeds the largest binary64; below -745.2 it is less than half
// the smallest.
double exponential(DoubleDouble x) noexcept {
    if (x.high > 709.79) return infinity;
    if (x.high < -745.2) return 0;
    const double k = std::floor(x.high * 0x1.71547652b82fep+0 + 0.5);
    const DoubleDouble rest = add(x, negated(mul(ln2, {k, 0})));
    DoubleDouble term{1, 0}, sum{1, 0};
    for (int n = 1; n <= 25; ++n) {  // 0.35^26 / 26! < 2^-126
        term = div(mul(term, rest), {static_cast<double>(n), 0});
        sum = add(sum, term);
    }
    // Two factors, because 2^exponent may be outside the range of normal numbers when the result is not.
    const int exponent = static_cast<int>(k), half = exponent / 2;
    return sum.high * power_of_two(half) * power_of_two(exponent - half);
}

}  // namespace

double sin(double radians) noexcept {
    if (radians == 0) return radians;  // keeps the sign of zero
    return in_range(radians) ? sine(reduce(radians)).high : nan;
}

double cos(double radians) noexcept { return in_range(radians) ? cosine(reduce(radians)).high : nan; }

double tan(double radians) noexcept {
    if (radians == 0) return radians;
    if (!in_range(radians)) return nan;
    const Reduced angle = reduce(radians);
    return div(sine(angle), cosine(angle)).high;
}

double pow(double base, double exponent) noexcept {
    if (!(base >= 0 && base < infinity) || !(exponent > -infinity && exponent < infinity)) return nan;
    if (exponent == 0 || base == 1) return 1;
    if (base == 0) return exponent > 0 ? 0 : infinity;
    const DoubleDouble log = logarithm(base);
    if (exponent * log.high > 710) return infinity;  // checked before the exact product, which must not overflow
    if (exponent * log.high < -746) return 0;
    return exponential(mul(log, {exponent, 0}));
}

}  // namespace strata::scenes
