// scenes/numbers/vector.h - three binary64 coordinates: GLM's storage and component-wise operators; sums in an order of our own,
// because result bits depend on it (scenes.md 7.1).
#pragma once
#include <glm/vec3.hpp>

#include "rasterizer/base/numerics.h"

namespace strata::scenes {
inline namespace strict {

using Vector = glm::dvec3;

[[nodiscard]] inline double dot(const Vector& a, const Vector& b) noexcept {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

[[nodiscard]] inline Vector cross(const Vector& a, const Vector& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace strict
}  // namespace strata::scenes
