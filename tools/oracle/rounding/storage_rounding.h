// tools/oracle/rounding/storage_rounding.h - how far a stored value may lie from its exact one, as numbers that are
// derived once from a hypothesis.
//
// Rule     kept() returns every value that may be stored for an exact result within an interval. A code is off by half
// a
//          step when rounded to nearest, by a step when truncated; a float by its relative error.
// Numbers  those of composite.h.
// Tests    tests/tools/oracle/rounding/composite_test.cpp
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tools/oracle/rounding/hypothesis.h"
#include "tools/oracle/rounding/interval.h"

namespace strata::oracle::verdict {

inline constexpr double single_error = 0x1p-22;  // relative to the terms of a blend (composite.h, Numbers)

// The rounding of a value that is stored, as numbers derived once from a hypothesis.
struct StorageRounding {
    bool has_codes = true;  // false: a float
    double scale = 255, inverse = 1.0 / 255;
    double minus = 0, plus = 0;  // codes: largest distance of the stored value below and above the exact result
    bool snaps = true;           // false: values between codes are possible
    double truncation_low = 0, truncation_high = 0;
    bool truncates = false;          // truncates to whole codes after adding cut_low or cut_high
    double relative = 0, least = 0;  // floats
    enum class Half : std::uint8_t { none, nearest, truncated };
    Half half = Half::none;  // for binary16: the value, after the errors above, is rounded to nearest or truncated.

    [[nodiscard, gnu::always_inline]] inline Interval kept(Interval exact, double magnitude) const noexcept {
        if (!has_codes && half != Half::none) {
            const auto rounded = [&](double v) {
                return half == Half::truncated ? truncated_half(v) : nearest_half(v);
            };
            const auto spacing = [&](double v) { return std::fabs(v) < 0x1p-14 ? least : 0; };  // of subnormals
            const Interval off = exact.widened(magnitude * relative);
            const double low = rounded(off.low), high = rounded(off.high);
            return {low - spacing(low), high + spacing(high)};
        }
        if (!has_codes) return exact.widened(magnitude * relative + least);
        double low = below(exact.low * scale), high = above(exact.high * scale);
        if (truncates) {
            low = floor_of(low + truncation_low);
            high = floor_of(high + truncation_high);
        } else {
            low -= minus;
            high += plus;
            if (snaps) {
                low = ceil_of(low);
                high = floor_of(high);
            }
        }
        return {std::min(std::max(low, 0.0), scale) * inverse, std::min(std::max(high, 0.0), scale) * inverse};
    }

    // Exact for |x| < 2^51: the sum is between 2^52 and 2^53, where binary64 has a spacing of 1.
    [[nodiscard]] static double nearest_whole(double x) noexcept { return (x + 0x1.8p52) - 0x1.8p52; }
    [[nodiscard]] static double floor_of(double x) noexcept {
        const double whole = nearest_whole(x);
        return whole - (whole > x ? 1.0 : 0.0);
    }
    // Rounds to 11 bits by Veltkamp's splitting; ties go either way.
    [[nodiscard]] static double nearest_half(double x) noexcept {
        const double far = (0x1p42 + 1) * x;
        return far - (far - x);
    }
    [[nodiscard]] static double truncated_half(double x) noexcept {
        const double near = nearest_half(x);
        return std::fabs(near) > std::fabs(x) ? nearest_half(near * (1 - 0x1p-11)) : near;
    }
    [[nodiscard]] static double ceil_of(double x) noexcept {
        const double whole = nearest_whole(x);
        return whole + (whole < x ? 1.0 : 0.0);
    }
};

// The rounding of an accumulator with only `bits` bits, with the rounding mode of the hypothesis.
[[nodiscard]] StorageRounding few_bits(std::uint8_t bits, Rounding rounding) noexcept;

// True if the operands of a blend are codes, so that its exact result is a whole number over scale^2.
[[nodiscard]] bool has_stored_source(SourceRounding source) noexcept;

// The rounding of a stored blend.
[[nodiscard]] StorageRounding keeper(Storage storage, Rounding rounding, bool operands_are_codes);

// The rounding of a shader's result when it is stored: once. If the result was divided by its alpha, stored, and
// multiplied by it again, colour and alpha are each off by up to half a code, and their product by up to one code.
[[nodiscard]] StorageRounding storing(const End& result, bool is_divided);

// The rounding of a colour that is converted to a code: ties go up, or in either direction.
[[nodiscard]] StorageRounding conversion(const End& end);

}  // namespace strata::oracle::verdict
