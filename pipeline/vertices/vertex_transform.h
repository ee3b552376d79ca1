// pipeline/vertices/vertex_transform.h - a matrix times a position, by one of the vertex paths.
//
// Rule     Matrices are multiplied in binary64 and rounded once to binary32, m the whole. With x, y, z in binary32, row
//          r is, for each path:
//            separate: ((m0 x + m1 y) + m2 z) + m3, every operation rounded.
//            fused: fma(m2, z, fma(m1, y, m0 x)) + m3.
//            reassociated: e = inner * p, then outer * e; rows (m0 x + m1 y) + (m2 z + m3), the last factor is e.w in
//            the second.
//            double: like separate in binary64 with matrices that are not rounded; the result is rounded once.
//            toward_zero: like separate, with every product and sum truncated toward zero.
//            nv20: one sum of three products and m3 by rasterizer/base/nv20_arithmetic.h.
// Source   pipeline/reference/vertices.md 2 (separate); rasterizer/reference/numbers.md 4 (nv20); the others are
//          assumed: arithmetic that compilers and drivers use.
// Tests    tests/pipeline/vertices/vertex_transform_test.cpp
#pragma once
#include <array>

#include "pipeline/vertices/draw_list.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {

// A matrix for transforming many positions, rounded to binary32 by the constructor (except for `double`).
class VertexTransform {
  public:
    // `whole` is outer * inner, with the order of products chosen by the caller.
    VertexTransform(VertexPath path, const Matrix& whole, const Matrix& outer, const Matrix& inner);

    [[nodiscard]] std::array<float, 4> operator()(const Vec3& p) const {
        if (path_ != VertexPath::separate) return by_path(p);
        const auto& m = whole_;
        const auto row = [&](std::size_t r) { return ((m[r] * p[0] + m[4 + r] * p[1]) + m[8 + r] * p[2]) + m[12 + r]; };
        return {row(0), row(1), row(2), row(3)};
    }

    // For a homogeneous position, whatever the path: ((m0 x + m1 y) + m2 z) + m3 w.
    [[nodiscard]] std::array<float, 4> operator()(const Vec3& p, float w) const {
        const auto& m = whole_;
        const auto row = [&](std::size_t r) {
            return ((m[r] * p[0] + m[4 + r] * p[1]) + m[8 + r] * p[2]) + m[12 + r] * w;
        };
        return {row(0), row(1), row(2), row(3)};
    }

    // The matrix, column-major, if the path is VertexPath::separate; otherwise null.
    [[nodiscard]] const std::array<float, 16>* separate_matrix() const noexcept {
        return path_ == VertexPath::separate ? &whole_ : nullptr;
    }

  private:
    [[nodiscard]] std::array<float, 4> by_path(const Vec3& p) const;

    VertexPath path_;
    std::array<float, 16> whole_, outer_, inner_;
    Matrix exact_;
};

// Each entry rounded once; by columns, m[4 c + r].
[[nodiscard]] std::array<float, 16> to_binary32(const Matrix& m);

}  // namespace strata::pipeline
