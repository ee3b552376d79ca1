// tests/pipeline/format_models.h - the format conversions as inequalities over integers, written from the
// specification, without division or rounding mode, and sharing no constant with the code.
#pragma once
#include <cstdint>

namespace strata::pipeline::model {

__extension__ typedef __int128 Wide;

// |x| = mantissa * 2^exponent for finite float bits.
struct Binary {
    std::int64_t mantissa;
    int exponent;
};
[[nodiscard]] inline Binary magnitude(std::uint32_t bits) {
    const auto e = static_cast<int>(bits >> 23 & 0xff);
    const std::int64_t fraction = bits & 0x7fffff;
    return e == 0 ? Binary{fraction, -149} : Binary{fraction + (1 << 23), e - 150};
}

// Sign of |x| - n 2^scale, for n in [0, 2^60).
[[nodiscard]] inline int order(Binary x, std::int64_t n, int scale) {
    const int shift = x.exponent - scale;
    if (shift > 60) return x.mantissa > 0 ? 1 : n > 0 ? -1 : 0;
    if (shift < -60) return n > 0 ? -1 : x.mantissa > 0 ? 1 : 0;
    const Wide left = shift >= 0 ? Wide{x.mantissa} << shift : Wide{x.mantissa};
    const Wide right = shift >= 0 ? Wide{n} : Wide{n} << -shift;
    return left < right ? -1 : left > right ? 1 : 0;
}

// True if k is the code of x: k - 1/2 <= 255 x < k + 1/2 after clamping; NaN is 0.
[[nodiscard]] inline bool is_unorm8(std::uint32_t bits, int k) {
    const std::uint32_t positive = bits & 0x7fffffff;
    if (positive > 0x7f800000 || (bits >> 31) != 0) return k == 0;
    if (positive >= 0x3f800000) return k == 255;
    const Binary x = magnitude(bits);
    const Binary scaled{x.mantissa * 255, x.exponent};
    return k >= 0 && k <= 255 && (k == 0 || order(scaled, 2 * k - 1, -1) >= 0) && order(scaled, 2 * k + 1, -1) < 0;
}

// The code of x, found by search.
[[nodiscard]] inline int unorm8(std::uint32_t bits) {
    for (int k = 0; k < 256; ++k)
        if (is_unorm8(bits, k)) return k;
    return -1;
}

// The magnitude of a finite half in units of 2^-24, at most 2047 * 2^29.
[[nodiscard]] inline std::int64_t half_units(std::uint32_t half) {
    const std::uint32_t e = half >> 10 & 0x1f, m = half & 0x3ff;
    return e == 0 ? m : std::int64_t{m + 1024} << (e - 1);
}

// True if `half` is x rounded to the nearest half, ties to even. Infinity counts as 2^16, the first value beyond the
// range.
[[nodiscard]] inline bool is_nearest_half(std::uint32_t bits, std::uint32_t half) {
    if (bits >> 31 != half >> 15) return false;
    const std::uint32_t x_bits = bits & 0x7fffffff, h = half & 0x7fff;
    if (x_bits > 0x7f800000) return h == (0x7e00 | ((x_bits >> 13) & 0x3ff));  // quiet NaN with the upper payload bits
    if (x_bits == 0x7f800000) return h == 0x7c00;
    if (h > 0x7c00) return false;
    const Binary x = magnitude(x_bits);
    const std::int64_t here = half_units(h);
    const bool is_even = (h & 1) == 0;
    if (h > 0) {
        const int low = order(x, half_units(h - 1) + here, -25);
        if (low < 0 || (low == 0 && !is_even)) return false;
    }
    if (h == 0x7c00) return true;  // infinity as 2^16, the next value in the sequence
    const int high = order(x, here + half_units(h + 1), -25);
    return high < 0 || (high == 0 && is_even);
}

// True if `half` is x rounded to a format in which exponent 31 is an ordinary exponent: values beyond 131040 and
// infinity become the largest code, NaN the negative one. Below 2^-14, digits of x below 2^-37 are dropped before
// rounding to the nearest multiple of 2^-24, ties to even.
[[nodiscard]] inline bool is_half_without_infinity(std::uint32_t bits, std::uint32_t half) {
    const std::uint32_t x_bits = bits & 0x7fffffff, h = half & 0x7fff;
    if (x_bits > 0x7f800000) return half == 0xffff;
    if (bits >> 31 != half >> 15) return false;
    if (x_bits == 0x7f800000) return h == 0x7fff;
    Binary x = magnitude(x_bits);
    if (order(x, 131040, 0) >= 0) return h == 0x7fff;
    if (order(x, 1, -14) < 0) {
        while (x.exponent < -37) x = {x.mantissa / 2, x.exponent + 1};
    }
    const bool is_even = (h & 1) == 0;
    const std::int64_t here = half_units(h);
    if (h > 0) {
        const int low = order(x, half_units(h - 1) + here, -25);
        if (low < 0 || (low == 0 && !is_even)) return false;
    }
    if (h == 0x7fff) return true;
    const int high = order(x, here + half_units(h + 1), -25);
    return high < 0 || (high == 0 && is_even);
}

// True if `half` is the half of largest magnitude not above that of x.
[[nodiscard]] inline bool is_half_toward_zero(std::uint32_t bits, std::uint32_t half) {
    if (bits >> 31 != half >> 15) return false;
    const std::uint32_t x_bits = bits & 0x7fffffff, h = half & 0x7fff;
    if (x_bits > 0x7f800000) return h == (0x7e00 | ((x_bits >> 13) & 0x3ff));
    if (x_bits == 0x7f800000) return h == 0x7c00;
    if (h > 0x7bff || order(magnitude(x_bits), half_units(h), -24) < 0) return false;
    return h == 0x7bff || order(magnitude(x_bits), half_units(h + 1), -24) < 0;
}

}  // namespace strata::pipeline::model
