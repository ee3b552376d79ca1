// pipeline/vertices/matrix.h - the product of two matrices a b in binary64, with a fixed order of summation
// (pipeline/reference/vertices.md 1.1).
#pragma once
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {
inline namespace strict {

[[nodiscard]] inline Matrix product(const Matrix& a, const Matrix& b) noexcept {
    Matrix m;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t r = 0; r < 4; ++r)
            m[c][r] = ((a[0][r] * b[c][0] + a[1][r] * b[c][1]) + a[2][r] * b[c][2]) + a[3][r] * b[c][3];
    return m;
}

}  // namespace strict
}  // namespace strata::pipeline
