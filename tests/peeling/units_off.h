// tests/peeling/units_off.h - the error of a binary32 number against a real value of 50 digits.
#pragma once
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

namespace strata::testing {

using Wide = boost::multiprecision::cpp_bin_float_50;

// In units of the last place of the real value; below the normal range, of the least normal number.
[[nodiscard]] inline double units_off(float found, const Wide& real) {
    const double unit = std::ldexp(1.0, std::max(std::ilogb(static_cast<double>(real)), -126) - 23);
    return std::abs(static_cast<double>((Wide{found} - real) / unit));
}

}  // namespace strata::testing
