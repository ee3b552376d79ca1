// tools/hardware_check/host_matrices.h - the matrices of the test suite's host, and points that it sends back from the
// window.
//
// Rule     Points are rows, times a matrix on the right. The host's processor keeps 53 bits between operations and 24
//          in memory: an expression is computed in binary64 and rounded to binary32 where it is stored. An inverse is
//          the adjoint, whose entries are stored, times the stored reciprocal of the determinant.
// Source   chip-geometry.md 6.1; the order of operations is that of the suite's public sources (abaire/xbox_math3d,
//          MIT), told in our words.
// Tests    tests/tools/hardware_check/host_matrices_test.cpp
#pragma once
#include "tools/hardware_check/fixed_pipeline.h"

namespace strata::hardware_check {

using HostVector = std::array<float, 4>;
using HostMatrix = std::array<HostVector, 4>;  // [row][column]

[[nodiscard]] HostMatrix product(const HostMatrix& a, const HostMatrix& b);
[[nodiscard]] HostMatrix inverse(const HostMatrix& m);
[[nodiscard]] HostVector product(const HostVector& v, const HostMatrix& m);

// From `eye` to `at`, y up, looking along +z.
[[nodiscard]] HostMatrix look_at(const std::array<float, 3>& eye, const std::array<float, 3>& at);
// The default camera's projection and the viewport of 640 x 480 in one; `units` is the greatest value of the depth
// buffer.
[[nodiscard]] HostMatrix perspective_to_window(float units);
// An orthographic view of the window's own size from `near` to `far`, and a viewport of 16 bits.
[[nodiscard]] HostMatrix orthographic_to_window(float near, float far);

// What the host hands to the chip, and how it finds its points.
struct HostCamera {
    HostMatrix composite, inverse;
};
[[nodiscard]] HostCamera camera_of(const HostMatrix& view, const HostMatrix& to_window);
// Eye at (0, 0, -7), looking at the origin.
[[nodiscard]] HostCamera default_camera(float units);

// The world point that appears at window x, y and has world z: on the line between what the inverse makes of depths 0
// and 64000.
[[nodiscard]] HostVector unprojected(const HostCamera& camera, float x, float y, float world_z);
// The world point of window x, y, z.
[[nodiscard]] HostVector unprojected_point(const HostCamera& camera, const HostVector& window);

// The composite as the fixed pipeline reads it: a dot product a column.
[[nodiscard]] CompositeMatrix columns_of(const HostMatrix& m);

}  // namespace strata::hardware_check
