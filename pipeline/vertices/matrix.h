// pipeline/vertices/matrix.h - the product of two matrices a b in binary64, with a fixed order of summation, and the
// cofactors and the determinant of an upper 3 x 3 (pipeline/reference/vertices.md 1.1, 5.2 and 6).
#pragma once
#include <array>

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

// By columns: the transform of normals, up to a positive factor and the sign of the determinant.
[[nodiscard]] inline std::array<double, 9> cofactors_of(const Matrix& m) noexcept {
    const auto a = [&](std::size_t row, std::size_t column) { return m[column][row]; };
    std::array<double, 9> n{};
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row) {
            const std::size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
            n[3 * column + row] = a(r1, c1) * a(r2, c2) - a(r1, c2) * a(r2, c1);
        }
    return n;
}

// Its sign tells whether an instance is mirrored, which exchanges facing.
[[nodiscard]] inline double linear_determinant(const Matrix& m) noexcept {
    const auto a = [&](std::size_t row, std::size_t column) { return m[column][row]; };
    return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) - a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
           a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}

}  // namespace strict
}  // namespace strata::pipeline
