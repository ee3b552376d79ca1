// Checks look_at and the perspective projection on known points (eye, centre, frustum corners), and orbit_view against
// the formula of scenes/reference/scenes.md 7.2 with 60 decimal digits (MPFR); also
// cameras of glTF files and conversion between clip conventions.
#include "scenes/camera.h"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "rasterizer/base/input_error.h"

namespace {

using strata::pipeline::Matrix;
using strata::pipeline::View;
using namespace strata::scenes;
using Wide = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<60>>;
using Point = std::array<double, 4>;

Point operator*(const Matrix& m, const Point& p) {
    Point result{};
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) result[r] += m[c][r] * p[c];
    return result;
}

void check_close(const Point& a, const Point& b, double tolerance = 1e-13) {
    for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(a[i] - b[i]) <= tolerance);
}

Bounds box(double x0, double y0, double z0, double x1, double y1, double z1) { return {{x0, y0, z0}, {x1, y1, z1}}; }

// The eye, computed from an orthonormal view matrix.
std::array<double, 3> eye_of(const View& view) {
    std::array<double, 3> eye{};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t r = 0; r < 3; ++r) eye[c] -= view.view[c][r] * view.view[3][r];
    return eye;
}

}  // namespace

TEST_CASE("look_at maps the eye to the origin and the centre to -z and up into the upper half plane") {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> unit{-1, 1};
    for (int i = 0; i < 200; ++i) {
        LookAt camera;
        for (auto* v : {&camera.eye, &camera.center, &camera.up})
            for (int k = 0; k < 3; ++k) (*v)[k] = unit(random);
        double distance = 0;
        for (int k = 0; k < 3; ++k) distance += std::pow(camera.center[k] - camera.eye[k], 2);
        const Matrix m = look_at(camera, 1).view;
        check_close(m * Point{camera.eye[0], camera.eye[1], camera.eye[2], 1}, {0, 0, 0, 1});
        check_close(m * Point{camera.center[0], camera.center[1], camera.center[2], 1},
                    {0, 0, -std::sqrt(distance), 1});
        const Point up = m * Point{camera.up[0], camera.up[1], camera.up[2], 0};
        CHECK(std::abs(up[0]) < 1e-13);
        CHECK(up[1] > 0);
    }
}

TEST_CASE("a perspective projection maps the corners of its frustum to the corners of clip space") {
    const double half = boost::math::constants::pi<double>() * 42 / 360, aspect = 16.0 / 9, n = 1.9, f = 4.2;
    const Matrix m = look_at({.fovy_degrees = 42, .near = n, .far = f}, aspect).projection;
    for (const double z : {n, f}) {
        const double y = z * std::tan(half), x = y * aspect;
        check_close(m * Point{x, y, -z, 1}, {z, z, z == n ? -z : z, z});
        check_close(m * Point{-x, -y, -z, 1}, {-z, -z, z == n ? -z : z, z});
    }
}

TEST_CASE("the eye and depth range and angle of an orbit are those of scenes.md 7.2 within 1e-13") {
    const Bounds bounds = box(-1, 0, 2, 5, 3, 4);
    const Wide radius = sqrt(Wide{49} / 4), degree = boost::math::constants::pi<Wide>() / 180;  // half sides 3, 1.5, 1
    for (const double azimuth : {30.0, -115.0, 400.0}) {
        for (const double elevation : {20.0, -75.0, 0.0}) {
            const View view = orbit_view(bounds, azimuth, elevation, 1.5);
            const Wide a = Wide{azimuth} * degree, e = Wide{elevation} * degree;
            const std::array<Wide, 3> eye{2 + Wide{2.5} * radius * cos(e) * sin(a),
                                          Wide{1.5} + Wide{2.5} * radius * sin(e),
                                          3 + Wide{2.5} * radius * cos(e) * cos(a)};
            for (std::size_t i = 0; i < 3; ++i) CHECK(abs(eye[i] - Wide{eye_of(view)[i]}) < 1e-13);
            const double n = 1.4 * 3.5, f = 3.6 * 3.5;
            CHECK(view.projection[2][2] == Approx(-(f + n) / (f - n)).epsilon(1e-15));
            CHECK(view.projection[3][2] == Approx(-2 * f * n / (f - n)).epsilon(1e-15));
            CHECK(view.projection[1][1] == Approx(1 + std::sqrt(2.0)).epsilon(1e-15));  // cot 22.5 degrees
            CHECK(view.projection[0][0] == Approx((1 + std::sqrt(2.0)) / 1.5).epsilon(1e-15));
        }
    }
}

TEST_CASE("orbit_view at elevation +-90 degrees differs by less than 1e-3 from the view at +-89.999 degrees") {
    for (const double sign : {1.0, -1.0}) {
        const View at = orbit_view(box(-1, -1, -1, 1, 1, 1), 25, sign * 90, 1);
        const View beside = orbit_view(box(-1, -1, -1, 1, 1, 1), 25, sign * 89.999, 1);
        for (std::size_t i = 0; i < 16; ++i) CHECK(std::abs(at.view[i / 4][i % 4] - beside.view[i / 4][i % 4]) < 1e-3);
    }
}

TEST_CASE("orbit_view is finite for an empty box and a single point and rejects bad angles") {
    for (const Bounds& bounds : {Bounds{}, box(1, 2, 3, 1, 2, 3)}) {
        for (const double entry : strata::entries_of(orbit_view(bounds, 30, 20, 1).view)) CHECK(std::isfinite(entry));
    }
    CHECK_THROWS_WITH(orbit_view({}, 0, 91, 1), "--orbit: elevation: expected degrees from -90 to 90, found 91");
    CHECK_THROWS_AS(orbit_view({}, NAN, 0, 1), strata::InputError);
}

TEST_CASE("a glTF camera uses the finite or infinite or orthographic projection of glTF 2.0 section 3.10.3") {
    const SceneCamera finite{.yfov = 0.7, .aspect = 2, .znear = 0.1, .zfar = 10};
    const Matrix m = camera_view(finite, 1).projection;
    CHECK(m[0][0] == Approx(1 / (2 * std::tan(0.35))).epsilon(1e-15));
    CHECK(m[1][1] == Approx(1 / std::tan(0.35)).epsilon(1e-15));
    CHECK(m[2][2] == Approx((10 + 0.1) / (0.1 - 10)).epsilon(1e-15));
    CHECK(m[3][2] == Approx(2 * 10 * 0.1 / (0.1 - 10)).epsilon(1e-15));
    CHECK(m[2][3] == -1);

    const SceneCamera infinite{.yfov = 0.7, .znear = 0.25};
    CHECK(camera_view(infinite, 1.5).projection[2][2] == -1);
    CHECK(camera_view(infinite, 1.5).projection[3][2] == -0.5);
    CHECK(camera_view(infinite, 1.5).projection[0][0] == Approx(1 / (1.5 * std::tan(0.35))).epsilon(1e-15));

    const SceneCamera flat{.perspective = false, .xmag = 2, .ymag = 4, .znear = 1, .zfar = 3};
    const Matrix o = camera_view(flat, 1).projection;
    check_close(o * Point{2, -4, -1, 1}, {1, -1, -1, 1});
    check_close(o * Point{-2, 4, -3, 1}, {-1, 1, 1, 1});
}

TEST_CASE(
    "converting a view to another clip convention keeps the view volume and maps near and far to its depth limits") {
    using strata::rasterizer::ClipDepth;
    using strata::rasterizer::DepthOrder;
    const double n = 1.9, f = 4.2;
    const View view = look_at({.near = n, .far = f}, 1.5);
    for (const ClipDepth from_clip : {ClipDepth::minus_one_to_one, ClipDepth::zero_to_one})
        for (const DepthOrder from_order : {DepthOrder::less, DepthOrder::greater})
            for (const ClipDepth clip : {ClipDepth::minus_one_to_one, ClipDepth::zero_to_one})
                for (const DepthOrder order : {DepthOrder::less, DepthOrder::greater}) {
                    const ClipConvention between{from_clip, from_order}, to{clip, order};
                    const View seen = with_clip_convention(with_clip_convention(view, {}, between), between, to);
                    const double least = clip == ClipDepth::zero_to_one ? 0 : -1;
                    for (const double z : {n, f}) {
                        const bool is_near = z == n;
                        const double expected = is_near == (order == DepthOrder::less) ? least : 1.0;
                        check_close(seen.projection * Point{0.3, -0.2, -z, 1},
                                    {view.projection[0][0] * 0.3, view.projection[1][1] * -0.2, expected * z, z});
                    }
                }
    CHECK(with_clip_convention(view, {}, {}).projection == view.projection);
}
