// tools/lab/hardware_check/drawing/host_matrices.h - the matrices that the test suite's host (the Xbox CPU) computes,
// and the points that it un-projects from the window. Rule     Points are rows, multiplied by a matrix on the right.
// All arithmetic is in binary32, each sum from the left,
//          except determinants: they are computed in binary64, and rounded to binary32 where they are stored. An
//          inverse is the adjoint, whose entries are stored, times the stored reciprocal of the determinant.
// Source   rasterizer/reference/chip-geometry.md 6.1; the order of operations is that of the suite's public sources
//          (abaire/xbox_math3d, MIT), described in our words.
// Tests    tests/tools/lab/hardware_check/host_matrices_test.cpp
#pragma once
#include <array>

namespace strata::hardware_check {

struct CompositeMatrix;  // fixed_pipeline.h

using HostVector = std::array<float, 4>;
using HostMatrix = std::array<HostVector, 4>;  // [row][column]

[[nodiscard]] HostMatrix product(const HostMatrix& a, const HostMatrix& b);
[[nodiscard]] HostMatrix inverse(const HostMatrix& m);
[[nodiscard]] HostVector product(const HostVector& v, const HostMatrix& m);

// The view from `eye` to `at`, y up, looking along +z.
[[nodiscard]] HostMatrix look_at(const std::array<float, 3>& eye, const std::array<float, 3>& at);
// The product of the default camera's projection and the viewport of 640 x 480; `units` is the greatest value of the
// depth buffer.
[[nodiscard]] HostMatrix perspective_to_window(float units);
// The product of an orthographic projection of the window's size from `near` to `far` and a 16-bit viewport.
[[nodiscard]] HostMatrix orthographic_to_window(float near, float far);

// The matrix that the host sets in the chip, and the inverse with which it un-projects points.
struct HostCamera {
    HostMatrix composite, inverse;
};
[[nodiscard]] HostCamera camera_of(const HostMatrix& view, const HostMatrix& to_window);
// Eye at (0, 0, -7), looking at the origin.
[[nodiscard]] HostCamera default_camera(float units);

// The world point that projects to window x, y and has world z: interpolated between the un-projected points of depths
// 0 and 64000.
[[nodiscard]] HostVector unprojected(const HostCamera& camera, float x, float y, float world_z);
// The world point of window x, y, z.
[[nodiscard]] HostVector unprojected_point(const HostCamera& camera, const HostVector& window);

// The rows of the fixed-function pipeline's dot products, which are the columns of `m`.
[[nodiscard]] CompositeMatrix columns_of(const HostMatrix& m);

}  // namespace strata::hardware_check
