// peeling/truth/real_triangle.cpp - coverage and interpolation of a triangle with binary64 corners (real_triangle.h).
#include "peeling/truth/real_triangle.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/base/exact_sum.h"
#include "rasterizer/coverage/edge.h"

namespace strata::peeling {

using rasterizer::Edge;
using rasterizer::Rect;

namespace {

// An edge function at a point, and its exact sign.
struct EdgeSide {
    double value;
    int sign;
};

[[nodiscard]] int sign_of(double v) noexcept { return int{v > 0} - int{v < 0}; }

// The determinant of (a, b, p) with all products expanded.
[[nodiscard]] int exact_sign(const RealCorner& a, const RealCorner& b, double x, double y) noexcept {
    rasterizer::ExactSum sum;
    sum.add_product(a.x, b.y);
    sum.add_product(-a.y, b.x);
    sum.add_product(b.x, y);
    sum.add_product(-b.y, x);
    sum.add_product(x, a.y);
    sum.add_product(-y, a.x);
    return sum.sign();
}

[[nodiscard]] EdgeSide side(const RealCorner& from, const RealCorner& to, double x, double y) noexcept {
    const bool is_turned = to.x < from.x || (to.x == from.x && to.y < from.y);
    const RealCorner &a = is_turned ? to : from, &b = is_turned ? from : to;
    const double right = (b.x - a.x) * (y - a.y), left = (b.y - a.y) * (x - a.x);
    const double value = right - left;
    const bool is_certain = std::fabs(value) > 0x1p-50 * (std::fabs(right) + std::fabs(left));
    const int sign = is_certain ? sign_of(value) : exact_sign(a, b, x, y);
    return is_turned ? EdgeSide{-value, -sign} : EdgeSide{value, sign};
}

}  // namespace

RealTriangle::RealTriangle(const std::array<RealCorner, 3>& corner, std::uint32_t primitive,
                           std::uint32_t material) noexcept
    : corner_{corner},
      primitive_{primitive},
      material_{material},
      winding_{side(corner[0], corner[1], corner[2].x, corner[2].y).sign} {}

// Corners may be far outside the range of int.
Rect RealTriangle::box(const Rect& within) const noexcept {
    const auto [left, right] = std::minmax({corner_[0].x, corner_[1].x, corner_[2].x});
    const auto [top, bottom] = std::minmax({corner_[0].y, corner_[1].y, corner_[2].y});
    const auto pixel = [](double v, int low, int high) {
        return static_cast<int>(std::floor(std::clamp(v, double(low), double(high))));
    };
    return {pixel(left - 1, within.x0, within.x1), pixel(top - 1, within.y0, within.y1),
            pixel(right + 1, within.x0, within.x1), pixel(bottom + 1, within.y0, within.y1)};
}

RealWeights RealTriangle::weights(int x, int y) const noexcept {
    RealWeights weights{{}, winding_ != 0};
    for (std::size_t i = 0; i < 3; ++i) {
        const RealCorner &from = corner_[(i + 1) % 3], &to = corner_[(i + 2) % 3];
        const EdgeSide here = side(from, to, x + 0.5, y + 0.5);
        weights.b[i] = here.value;
        const int inward = winding_ * here.sign;
        const bool owns = Edge::owns_ties(winding_ * sign_of(to.x - from.x), winding_ * sign_of(to.y - from.y),
                                          rasterizer::TieRule::top_left);
        weights.is_inside = weights.is_inside && (inward > 0 || (inward == 0 && owns));
    }
    const double area = (weights.b[0] + weights.b[1]) + weights.b[2];
    for (double& b : weights.b) b /= area;
    return weights;
}

double RealTriangle::depth(const RealWeights& weights) const noexcept {
    const auto& [b0, b1, b2] = weights.b;
    const double z0 = corner_[0].z;
    return z0 + (b1 * (corner_[1].z - z0) + b2 * (corner_[2].z - z0));
}

std::array<double, rasterizer::attribute_count> RealTriangle::values(const RealWeights& weights) const noexcept {
    std::array<double, 3> q{};
    for (std::size_t i = 0; i < 3; ++i) q[i] = weights.b[i] * corner_[i].inverse_w;
    const double whole = (q[0] + q[1]) + q[2];
    std::array<double, rasterizer::attribute_count> values{};
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double v0 = corner_[0].value[k];
        values[k] = v0 + (q[1] * (corner_[1].value[k] - v0) + q[2] * (corner_[2].value[k] - v0)) / whole;
    }
    return values;
}

}  // namespace strata::peeling
