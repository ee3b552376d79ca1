#include "tools/lab/hardware_check/drawing/host_matrices.h"

#include <cmath>

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"

namespace strata::hardware_check {
namespace {

using Three = std::array<float, 3>;

// The matrix without one row and one column, for a cofactor.
using Minor = std::array<std::array<double, 3>, 3>;
Minor minor_of(const HostMatrix& m, std::size_t row, std::size_t column) {
    Minor rest{};
    for (std::size_t r = 0, i = 0; r < 4; ++r) {
        if (r == row) continue;
        for (std::size_t c = 0, j = 0; c < 4; ++c)
            if (c != column) rest[i][j++] = m[r][c];
        ++i;
    }
    return rest;
}
double determinant(const Minor& m) {
    const auto& [a, b, c] = m[0];
    const auto& [d, e, f] = m[1];
    const auto& [g, h, i] = m[2];
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
}

// Expanded by two-by-two determinants of the lower rows.
double determinant(const HostMatrix& matrix) {
    const auto number = [&](std::size_t r, std::size_t c) { return double{matrix[r][c]}; };
    const double a = number(0, 0), b = number(0, 1), c = number(0, 2), d = number(0, 3);
    const double e = number(1, 0), f = number(1, 1), g = number(1, 2), h = number(1, 3);
    const auto lower = [&](std::size_t i, std::size_t j) {
        return number(2, i) * number(3, j) - number(2, j) * number(3, i);
    };
    return a * (f * lower(2, 3) - g * lower(1, 3) + h * lower(1, 2)) -
           b * (e * lower(2, 3) - g * lower(0, 3) + h * lower(0, 2)) +
           c * (e * lower(1, 3) - f * lower(0, 3) + h * lower(0, 1)) -
           d * (e * lower(1, 2) - f * lower(0, 2) + g * lower(0, 1));
}

float dot(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Three normalized(const Three& v) {
    const float inverse_length = 1.0f / std::sqrt(dot(v, v));
    return {v[0] * inverse_length, v[1] * inverse_length, v[2] * inverse_length};
}
Three cross(const Three& a, const Three& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

HostMatrix viewport(float units) { return {{{320, 0, 0, 0}, {0, -240, 0, 0}, {0, 0, units, 0}, {320, 240, 0, 1}}}; }

// v times m, divided by its w.
HostVector divided(const HostVector& v, const HostMatrix& m) {
    HostVector p = product(v, m);
    for (std::size_t i = 0; i < 3; ++i) p[i] /= p[3];
    p[3] = 1.0f;
    return p;
}

}  // namespace

HostVector product(const HostVector& v, const HostMatrix& m) {
    HostVector result{};
    for (std::size_t c = 0; c < 4; ++c) result[c] = m[0][c] * v[0] + m[1][c] * v[1] + m[2][c] * v[2] + m[3][c] * v[3];
    return result;
}

HostMatrix product(const HostMatrix& a, const HostMatrix& b) {
    return {product(a[0], b), product(a[1], b), product(a[2], b), product(a[3], b)};
}

HostMatrix inverse(const HostMatrix& m) {
    const auto factor = static_cast<float>(1.0 / determinant(m));
    HostMatrix result{};
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) {
            const double sign = (r + c) % 2 == 0 ? 1.0 : -1.0;
            const auto cofactor = static_cast<float>(sign * determinant(minor_of(m, r, c)));
            result[c][r] = static_cast<float>(double{cofactor} * double{factor});
        }
    return result;
}

HostMatrix look_at(const std::array<float, 3>& eye, const std::array<float, 3>& at) {
    const Three z = normalized({at[0] - eye[0], at[1] - eye[1], at[2] - eye[2]});
    const Three x = normalized(cross({0, 1, 0}, z)), y = normalized(cross(z, x));
    HostMatrix view{};
    for (std::size_t i = 0; i < 3; ++i) view[i] = {x[i], y[i], z[i], 0};
    view[3] = {-dot(x, eye), -dot(y, eye), -dot(z, eye), 1};
    return view;
}

HostMatrix perspective_to_window(float units) {
    constexpr float near = 1, far = 200;
    const float depth_scale = far / (far - near);
    const HostMatrix projection{{{chip_cotangent_x, 0, 0, 0},
                                 {0, chip_cotangent, 0, 0},
                                 {0, 0, depth_scale, 1},
                                 {0, 0, -near * depth_scale, 0}}};
    return product(projection, viewport(units));
}

HostMatrix orthographic_to_window(float near, float far) {
    const float inverse_depth = 1.0f / (near - far);
    const HostMatrix projection{{{2.0f / 640.0f, 0, 0, 0},
                                 {0, 2.0f / 480.0f, 0, 0},
                                 {0, 0, -inverse_depth, 0},
                                 {0, 0, near * inverse_depth, 1}}};
    return product(projection, viewport(65535.0f));
}

HostCamera camera_of(const HostMatrix& view, const HostMatrix& to_window) {
    const HostMatrix composite = product(view, to_window);
    return {composite, inverse(composite)};
}

HostCamera default_camera(float units) {
    return camera_of(look_at({0, 0, -7}, {0, 0, 0}), perspective_to_window(units));
}

HostVector unprojected(const HostCamera& camera, float x, float y, float world_z) {
    const HostVector near = divided({x, y, 0, 1}, camera.inverse), far = divided({x, y, 64000, 1}, camera.inverse);
    const float t = (world_z - near[2]) / (far[2] - near[2]);
    const auto between = [&](std::size_t i) { return near[i] + (far[i] - near[i]) * t; };
    return {between(0), between(1), world_z, 1};
}

HostVector unprojected_point(const HostCamera& camera, const HostVector& window) {
    return divided(window, camera.inverse);
}

CompositeMatrix columns_of(const HostMatrix& m) {
    const auto column = [&](std::size_t c) { return HostVector{m[0][c], m[1][c], m[2][c], m[3][c]}; };
    return {column(0), column(1), column(2), column(3)};
}

}  // namespace strata::hardware_check
