// tests/rasterizer/rational.h - exact rational arithmetic for the models, with roundings written from their
// definitions.
#pragma once
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>

#include "rasterizer/coverage/edge.h"

namespace strata::rasterizer {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

[[nodiscard]] inline Rational power(int exponent) {
    const Integer p = Integer{1} << (exponent < 0 ? -exponent : exponent);
    return exponent < 0 ? Rational{1, p} : Rational{p};
}

[[nodiscard]] inline Integer floor(const Rational& v) {
    const Integer n = numerator(v), d = denominator(v);
    Integer q = n / d;  // rounded toward zero
    if (q * d > n) --q;
    return q;
}

// floor(log2 v), v > 0.
[[nodiscard]] inline int floor_log2(const Rational& v) {
    const Integer n = numerator(v), d = denominator(v);
    const int guess = static_cast<int>(msb(n)) - static_cast<int>(msb(d));
    return v < power(guess) ? guess - 1 : guess;
}

// The multiple of 2^unit nearest to v that is no further from 0 than v.
[[nodiscard]] inline Rational truncate(const Rational& v, int unit) {
    const Rational scaled = abs(v) * power(-unit);
    const Rational result = Rational{floor(scaled)} * power(unit);
    return v < 0 ? Rational{-result} : result;
}

[[nodiscard]] inline Rational truncate_to_bits(const Rational& v, int bits) {
    return v == 0 ? v : truncate(v, floor_log2(abs(v)) - bits + 1);
}

// Nearest binary32, ties to even; subnormals included, overflow not.
[[nodiscard]] inline float nearest_float(const Rational& v) {
    if (v == 0) return 0.0f;
    const Rational size = abs(v);
    const int unit = std::max(floor_log2(size), -126) - 23;
    const Rational scaled = size * power(-unit);
    Integer code = floor(scaled);
    const Rational rest = scaled - Rational{code};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && (code & 1) != 0)) ++code;
    // code 2^unit, code <= 2^24: exact in binary64, and as a float by construction
    const auto exponent = static_cast<std::uint64_t>(unit + 1023) << 52;
    const double result = code.convert_to<double>() * std::bit_cast<double>(exponent);
    return static_cast<float>(v < 0 ? -result : result);
}

// A binary32 whose operations are computed in rationals and rounded once.
struct Rounded {
    float v = 0;
    friend Rounded operator+(Rounded a, Rounded b) { return {nearest_float(Rational{a.v} + Rational{b.v})}; }
    friend Rounded operator-(Rounded a, Rounded b) { return {nearest_float(Rational{a.v} - Rational{b.v})}; }
    friend Rounded operator*(Rounded a, Rounded b) { return {nearest_float(Rational{a.v} * Rational{b.v})}; }
    friend Rounded operator/(Rounded a, Rounded b) { return {nearest_float(Rational{a.v} / Rational{b.v})}; }
};

// Twice the signed area of (a, b, c) in square subpixels.
[[nodiscard]] inline Integer doubled_area(SubpixelPoint a, SubpixelPoint b, SubpixelPoint c) {
    const Integer abx = Integer{b.x} - a.x, aby = Integer{b.y} - a.y, acx = Integer{c.x} - a.x,
                  acy = Integer{c.y} - a.y;
    return abx * acy - aby * acx;
}

[[nodiscard]] inline SubpixelPoint model_centre(int x, int y, int subpixel_bits) {
    return {(2 * x + 1) * (1 << subpixel_bits) / 2, (2 * y + 1) * (1 << subpixel_bits) / 2};
}

// The barycentric weights of the centre of pixel (x, y).
[[nodiscard]] inline std::array<Rational, 3> barycentric(const std::array<SubpixelPoint, 3>& p, int x, int y,
                                                         int bits) {
    const SubpixelPoint c = model_centre(x, y, bits);
    const Rational area{doubled_area(p[0], p[1], p[2])};
    return {Rational{doubled_area(c, p[1], p[2])} / area, Rational{doubled_area(p[0], c, p[2])} / area,
            Rational{doubled_area(p[0], p[1], c)} / area};
}

template <class Number>
[[nodiscard]] Rational plane_value(const std::array<Rational, 3>& b, const std::array<Number, 3>& v) {
    return b[0] * Rational{v[0]} + b[1] * Rational{v[1]} + b[2] * Rational{v[2]};
}

}  // namespace strata::rasterizer
