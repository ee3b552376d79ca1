// tools/oracle/fragments/eye_point.h - a point by a matrix, in binary64: where something lies for a decision, not for a
// bit of a picture.
#pragma once
#include <array>

#include "rasterizer/base/vector.h"

namespace strata::oracle {

using EyePoint = std::array<double, 3>;

[[nodiscard]] inline EyePoint transformed(const Matrix& m, const EyePoint& p) noexcept {
    EyePoint to{};
    for (int row = 0; row < 3; ++row)
        to[static_cast<std::size_t>(row)] = m[0][row] * p[0] + m[1][row] * p[1] + m[2][row] * p[2] + m[3][row];
    return to;
}

}  // namespace strata::oracle
