// rasterizer/base/vector_arithmetic.h - binary64 vector arithmetic for cameras, bounds and shapes.
//
// Rule     Component by component, each operation rounded once. A sum of three products is (x + y) + z.
// Tests    tests/rasterizer/base/vector_test.cpp
#pragma once
#include "rasterizer/base/numerics.h"
#include "rasterizer/base/vector.h"

namespace strata {
inline namespace strict {

[[nodiscard]] constexpr Vec3d plus(const Vec3d& a, const Vec3d& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Vec3d minus(const Vec3d& a, const Vec3d& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Vec3d times(const Vec3d& a, double factor) noexcept {
    return {a.x * factor, a.y * factor, a.z * factor};
}
[[nodiscard]] constexpr Vec3d divided(const Vec3d& a, double divisor) noexcept {
    return {a.x / divisor, a.y / divisor, a.z / divisor};
}
[[nodiscard]] constexpr double dot_product(const Vec3d& a, const Vec3d& b) noexcept {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
[[nodiscard]] constexpr Vec3d cross_product(const Vec3d& a, const Vec3d& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace strict
}  // namespace strata
