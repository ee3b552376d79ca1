// peeling/programs/fixed_passes/moment_bound.h - estimates which share of a distribution over depth is nearer than a
// given depth, if only the power moments of the distribution are known. Used by the algorithm moments.
//
// Rule     Many distributions have the same 2 n moments. The one used is the canonical distribution that has mass at z:
//          n + 1 points z = x0, x1 ... xn. The share is its mass below z plus `overestimation` times its mass at z,
//          clamped to [0, 1]. Arithmetic is binary64, each operation rounded; a pivot of the factorization that is not
//          positive is replaced by 2^-40.
// Source   Muenstermann et al. 2018 and its supplement; Peters and Klein 2015, Algorithm 1. Assumed: the roots are
//          found by Newton's method and deflation, where the paper's shaders use closed forms with trigonometric
//          functions.
// Tests    tests/peeling/algorithms/moments_test.cpp
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "rasterizer/base/numerics.h"

namespace strata::peeling {

inline constexpr std::size_t most_moments = 8;
using Moments = std::array<double, most_moments + 1>;           // of powers 0, 1, 2 ...; that of power 0 is 1
using Coefficients = std::array<double, most_moments / 2 + 1>;  // of powers 0, 1, 2 ...

inline namespace strict {

// The coefficients c of the polynomial whose roots are the points x1 ... xn: the solution of H c = (1, z, z^2 ... z^n),
// where H is the Hankel matrix of the moments, by the factorization H = L D L^T.
[[nodiscard]] inline Coefficients kernel_polynomial(const Moments& b, std::size_t n, double z) noexcept {
    constexpr std::size_t most = most_moments / 2 + 1;
    std::array<std::array<double, most>, most> lower{};
    Coefficients pivot{}, c{};
    double power = 1;
    for (std::size_t i = 0; i <= n; ++i, power *= z) {
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = b[i + j];
            for (std::size_t k = 0; k < j; ++k) rest -= lower[i][k] * pivot[k] * lower[j][k];
            if (i == j)
                pivot[i] = rest > 0 ? rest : 0x1p-40;
            else
                lower[i][j] = rest / pivot[j];
        }
        c[i] = power;
        for (std::size_t k = 0; k < i; ++k) c[i] -= lower[i][k] * c[k];
    }
    for (std::size_t i = 0; i <= n; ++i) c[i] /= pivot[i];
    for (std::size_t i = n + 1; i-- > 0;)
        for (std::size_t k = i + 1; k <= n; ++k) c[i] -= lower[k][i] * c[k];
    return c;
}

// All roots of a polynomial of degree n, greatest first. Precondition: all roots are real. Newton's method decreases
// towards the greatest root from any greater number; it ends when a step does not decrease x any more. That root is
// then divided out.
[[nodiscard]] inline Coefficients real_roots(Coefficients c, std::size_t n) noexcept {
    Coefficients roots{};
    double x = 0;
    for (std::size_t i = 0; i < n; ++i) x = std::max(x, c[i] / c[n] < 0 ? -(c[i] / c[n]) : c[i] / c[n]);
    x += 1;  // Cauchy's bound
    for (std::size_t found = 0; n > 0; ++found, --n) {
        for (int step = 0; step < 400; ++step) {
            double value = c[n], slope = 0;
            for (std::size_t i = n; i-- > 0;) {
                slope = slope * x + value;
                value = value * x + c[i];
            }
            const double next = x - value / slope;
            if (!(next < x)) break;
            x = next;
        }
        roots[found] = x;
        for (std::size_t i = n - 1; i-- > 0;) c[i + 1] += c[i + 2] * x;  // the quotient by (x - root), in c[1] ...
        for (std::size_t i = 0; i < n; ++i) c[i] = c[i + 1];
    }
    return roots;
}

// The share of the distribution that is nearer than z. `b` are the first `count` moments (4, 6 or 8) of depths in [-1,
// 1]; `overestimation` is in [0, 1].
[[nodiscard]] inline double share_before(const Moments& b, std::size_t count, double z,
                                         double overestimation) noexcept {
    const std::size_t n = count / 2;
    const Coefficients roots = real_roots(kernel_polynomial(b, n, z), n);
    Coefficients x{z}, f{overestimation};
    for (std::size_t i = 1; i <= n; ++i) {
        x[i] = roots[i - 1];
        f[i] = x[i] < z ? 1 : 0;
    }
    for (std::size_t level = 1; level <= n;
         ++level)  // divided differences: Newton's form of the polynomial through (x, f)
        for (std::size_t i = n; i >= level; --i) f[i] = (f[i] - f[i - 1]) / (x[i] - x[i - level]);
    Coefficients p{f[n]};
    for (std::size_t i = n; i-- > 0;) {  // p = p (x - x_i) + f_i
        for (std::size_t k = n; k > 0; --k) p[k] = p[k - 1] - p[k] * x[i];
        p[0] = f[i] - p[0] * x[i];
    }
    double share = 0;
    for (std::size_t k = 0; k <= n; ++k) share += p[k] * b[k];
    return share > 0 ? std::min(share, 1.0) : 0.0;
}

}  // namespace strict
}  // namespace strata::peeling
