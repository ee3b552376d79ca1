// scenes/numbers/elementary.h - sin, cos, tan and pow with the same bits on every computer.
//
// Rule     Binary64 with a fixed order of + - * /; of the C library only floor is used, which is exact. The error is
//          below 0.501 units in the last place. Angles up to 10^6 radians; beyond that, and for NaN, the result is NaN.
// Source   scenes/reference/scenes.md 8: the C library's functions differ between processors. double_double.h names its
//          sources.
// Cost     About a microsecond per call: for cameras, procedural scenes and colour factors, never for fragments.
// Tests    tests/scenes/numbers/elementary_test.cpp against MPFR
#pragma once

namespace strata::scenes {

inline constexpr double pi = 0x1.921fb54442d18p+1;
inline constexpr double max_angle = 1e6;  // radians

[[nodiscard]] double sin(double radians) noexcept;
[[nodiscard]] double cos(double radians) noexcept;
[[nodiscard]] double tan(double radians) noexcept;

// base^exponent for base >= 0 and finite operands; else NaN. Infinity above the range; results below 2^-1022 are
// rounded a second time.
[[nodiscard]] double pow(double base, double exponent) noexcept;

// degrees * pi / 180, the product first.
[[nodiscard]] constexpr double radians(double degrees) noexcept { return degrees * pi / 180.0; }

}  // namespace strata::scenes
